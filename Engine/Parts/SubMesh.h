// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_SUBMESH_H
#define DELAUNAYFLIP_SUBMESH_H

#include "Array.h"
#include "Atomics.h"
#include "Records.h"
#include "ThreadBackend.h"
#include "TriangleMesh.h"

#include <cstdint>
#include <vector>

namespace delaunayflip
{

/// Some points of a mesh: a bit for each point.
class PointSet
{
public:
  /// Empty.
  /// @param points of the mesh.
  PointSet(std::int64_t points, const ThreadBackend& backend);

  /// Several threads may add at once.
  void Add(std::int64_t point)
  {
    std::uint32_t* word = this->Words.Data() + point / WordBits;
    const std::uint32_t bit = GetBit(point);
    if ((AtomicLoad(word) & bit) == 0) // most have been added already
    {
      AtomicSet(word, bit);
    }
  }

  bool Has(std::int64_t point) const
  {
    return (this->Words.Data()[point / WordBits] & GetBit(point)) != 0;
  }

  /// Whether a point of a triangle is in the set.
  bool Touches(const TriangleArray& triangles, std::int64_t t) const
  {
    return this->Has(triangles.Get(t, 0)) || this->Has(triangles.Get(t, 1)) ||
      this->Has(triangles.Get(t, 2));
  }

  /// Numbers the points that have been added, in the order of their ids.
  /// @throws MeshTooLarge if a number would not fit into 32 bits.
  void Number(const ThreadBackend& backend);

  // After Number:
  std::int64_t GetSize() const { return this->Size; }
  /// The number of a point of the set.
  std::int32_t GetNumber(std::int64_t point) const
  {
    const std::uint32_t before = this->Words.Data()[point / WordBits] & (GetBit(point) - 1);
    return static_cast<std::int32_t>(
      this->Firsts.Data()[point / WordBits] + __builtin_popcount(before));
  }

  /// Calls visit(point, number) for all points of the set, in several threads.
  template <typename Visit>
  void ForEach(const ThreadBackend& backend, const Visit& visit) const
  {
    backend.ForEach(static_cast<std::int64_t>(this->Words.Size()),
      [&](std::int64_t word)
      {
        std::int32_t number = static_cast<std::int32_t>(this->Firsts.Data()[word]);
        for (std::uint32_t bits = this->Words.Data()[word]; bits != 0; bits &= bits - 1)
        {
          visit(word * WordBits + __builtin_ctz(bits), number++);
        }
      });
  }

private:
  static constexpr std::int64_t WordBits = 32;
  static std::uint32_t GetBit(std::int64_t point) { return std::uint32_t(1) << (point % WordBits); }

  Array<std::uint32_t> Words;
  Array<std::uint32_t> Firsts; ///< By word: the number of its first point.
  std::int64_t Size = 0;
};

/// The numbers from 0 to size - 1 for which isIn(number) is true, ascending.
template <typename IsIn>
std::vector<std::int64_t> ListNumbers(
  std::int64_t size, const IsIn& isIn, const ThreadBackend& backend)
{
  const auto count = [&](std::int64_t i) { return isIn(i) ? 1 : 0; };
  const ThreadNumbering numbering = backend.Count(size, count);
  std::vector<std::int64_t> numbers(numbering.Total);
  const auto list = [&](std::int64_t i, std::int64_t number)
  {
    if (isIn(i))
    {
      numbers[number] = i;
    }
  };
  backend.ForEachNumbered(numbering, size, count, list);
  return numbers;
}

/// Calls work(triangle, slot) for the corners of `count` triangles, in several threads.
template <typename Work>
void ForEachCorner(std::int64_t count, const ThreadBackend& backend, const Work& work)
{
  backend.ForEach(count,
    [&](std::int64_t t)
    {
      work(t, 0);
      work(t, 1);
      work(t, 2);
    });
}

/// Some triangles of a mesh as a mesh of its own, with its own numbers of points. Triangles and
/// points keep their order.
class SubMesh
{
public:
  /// @param mesh must live as long.
  /// @param slots the triangles, ascending.
  SubMesh(const TriangleMesh& mesh, std::vector<std::int64_t> slots, const ThreadBackend& backend);

  std::int64_t GetNumberOfTriangles() const { return SizeOf(this->Slots); }
  /// The place of a triangle in the mesh.
  std::int64_t GetSlot(std::int64_t triangle) const { return this->Slots[triangle]; }
  /// The id in the mesh of a corner of a triangle.
  std::int64_t GetPoint(std::int64_t triangle, int slot) const
  {
    return this->PointOf[this->Ids[3 * triangle + slot]];
  }
  /// The id in the mesh of a point.
  std::int64_t GetPointId(std::int64_t number) const { return this->PointOf[number]; }

  /// Fixes edges that have both ends in the sub-mesh, and ignores the others.
  /// @param ends of the edges: two point ids of the mesh for each.
  void FixEdges(const std::vector<std::int64_t>& ends);

  /// Forbids flips that would join two of the points for which `has`(point of the mesh) is true
  /// (WholeMesh::SharedPoints). There is no need to where no flip can make an edge that exists.
  template <typename Has>
  void GuardPoints(const Has& has)
  {
    this->Shared = this->Engine.template MakeArray<unsigned char>(this->PointOf.Size());
    this->PointIds.ForEach(this->Engine,
      [&](std::int64_t point, std::int32_t number) { this->Shared[number] = has(point); });
  }

  /// Views of the arrays of this object.
  /// @param withLabels with the regions and frozen flags of the triangles.
  TriangleMesh View(bool withLabels = true) const;

  /// The point ids of the triangles, to be changed by flips.
  MutableTriangleArray GetTriangles()
  {
    return MutableTriangleArray(this->Ids.Data(), this->GetNumberOfTriangles());
  }
  /// Writes the triangles into their slots of the mesh.
  void Store(const MutableTriangleArray& triangles) const
  {
    ForEachCorner(this->GetNumberOfTriangles(), this->Engine,
      [&](std::int64_t t, int slot)
      { triangles.Set(this->Slots[t], slot, this->GetPoint(t, slot)); });
  }

private:
  template <typename T>
  void Take(
    const T* from, const std::int64_t* ids, std::int64_t count, int components, Array<T>& to) const;

  const TriangleMesh& Whole;
  const ThreadBackend& Engine;
  PointSet PointIds;
  std::vector<std::int64_t> Slots;
  Array<std::int64_t> PointOf;
  Array<std::int32_t> Ids;
  Array<float> Floats; ///< Coordinates, in the precision of the mesh; Doubles is then empty.
  Array<double> Doubles;
  Array<std::int32_t> Regions;
  Array<unsigned char> Frozen;
  Array<unsigned char> Shared;
  std::vector<std::int64_t> Edges;
};

inline TriangleArray AsConst(const MutableTriangleArray& triangles)
{
  return triangles.Ids32 ? TriangleArray(triangles.Ids32, triangles.Count)
                         : TriangleArray(triangles.Ids64, triangles.Count);
}

void CopyTriangles(
  const TriangleArray& from, const MutableTriangleArray& to, const ThreadBackend& threads);

/// Divides a mesh into parts with about the same number of triangles by recursive bisection. Each
/// cut is perpendicular to the axis along which what is cut is longest.
///
/// The cuts of a large mesh are computed from a sample of its triangles. Which triangles are in the
/// sample depends only on their number.
/// @param axes the coordinate axes to cut across, ascending.
/// @returns the part of each triangle, 0 to parts - 1.
Array<unsigned char> FindParts(
  const TriangleMesh& mesh, const std::vector<int>& axes, int parts, const ThreadBackend& threads);

}

#endif
