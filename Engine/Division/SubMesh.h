// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_SUBMESH_H
#define DELAUNAYFLIP_SUBMESH_H

#include "Array.h"
#include "PointSet.h"
#include "ThreadBackend.h"
#include "TriangleMesh.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace delaunayflip
{

/// The numbers from 0 to size - 1 for which isIn(number) is true, ascending.
template <typename IsIn>
Array<std::int64_t> ListNumbers(std::int64_t size, const IsIn& isIn, const ThreadBackend& backend)
{
  constexpr std::int64_t Grain = 1 << 16;
  std::vector<std::vector<std::int64_t>> parts((size + Grain - 1) / Grain);
  std::vector<std::int64_t> firsts(parts.size() + 1);
  backend.ForRange(
    size,
    [&](std::int64_t begin, std::int64_t end)
    {
      std::vector<std::int64_t>& part = parts[begin / Grain];
      for (std::int64_t i = begin; i < end; ++i)
      {
        if (isIn(i))
        {
          part.push_back(i);
        }
      }
    },
    Grain);
  for (std::size_t i = 0; i < parts.size(); ++i)
  {
    firsts[i + 1] = firsts[i] + static_cast<std::int64_t>(parts[i].size());
  }
  Array<std::int64_t> numbers = backend.MakeArray<std::int64_t>(firsts.back());
  backend.ForTasks(static_cast<std::int64_t>(parts.size()),
    [&](std::int64_t i)
    { std::copy(parts[i].begin(), parts[i].end(), numbers.Data() + firsts[i]); });
  return numbers;
}

/// Some triangles of a mesh as a mesh of its own, with its own numbers of points. Triangles and
/// points keep their order.
class SubMesh
{
public:
  /// @param mesh must live as long.
  /// @param slots the triangles, ascending.
  SubMesh(const TriangleMesh& mesh, Array<std::int64_t> slots, const ThreadBackend& backend);

  std::int64_t GetNumberOfTriangles() const
  {
    return static_cast<std::int64_t>(this->Slots.Size());
  }
  /// The place of a triangle in the mesh.
  std::int64_t GetSlot(std::int64_t triangle) const { return this->Slots[triangle]; }
  /// The id in the mesh of a corner of a triangle.
  std::int64_t GetPoint(std::int64_t triangle, int slot) const
  {
    return this->PointOf[this->Ids[3 * triangle + slot]];
  }
  /// The id in the mesh of a point.
  std::int64_t GetPointId(std::int64_t number) const { return this->PointOf[number]; }

  /// Fixes edges whose two ends are both in the sub-mesh, and ignores the others.
  /// @param ends of the edges: two point ids of the mesh for each.
  void FixEdges(const std::vector<std::int64_t>& ends);

  /// Forbids flips that would join two of the points for which `has`(point of the mesh) is true
  /// (WholeMesh::SharedPoints). There is no need to where no flip can make an edge that exists.
  template <typename Has>
  void GuardPoints(const Has& has)
  {
    this->Shared = this->Engine.template MakeArray<unsigned char>(this->PointOf.Size());
    this->PointIds.ForEach(this->Engine,
      [&](std::int64_t point, std::int32_t number) { this->Shared[number] = has(point) ? 1 : 0; });
  }

  /// Views of the arrays of this object, with the regions and frozen flags of the triangles.
  TriangleMesh View() const;
  /// The same without regions and frozen flags.
  TriangleMesh ViewWithoutLabels() const;

  /// The point ids of the triangles, to be changed by flips.
  MutableTriangleArray GetTriangles()
  {
    return MutableTriangleArray(this->Ids.Data(), this->GetNumberOfTriangles());
  }
  /// Writes the triangles into their slots of the mesh.
  void Store(const MutableTriangleArray& triangles) const;

private:
  void CopyPoints();
  void CopyLabels();

  const TriangleMesh& Whole;
  const ThreadBackend& Engine;
  PointSet PointIds;
  Array<std::int64_t> Slots;
  Array<std::int64_t> PointOf;
  Array<std::int32_t> Ids;
  Array<float> Floats; ///< Coordinates, in the precision of the mesh; Doubles is then empty.
  Array<double> Doubles;
  Array<std::int32_t> Regions;
  Array<unsigned char> Frozen;
  Array<unsigned char> Shared;
  std::vector<std::int64_t> Edges;
};

}

#endif
