// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SubMesh.h"

#include "FlipError.h"
#include "InputChecks.h"
#include "PartSurvey.h"

#include <array>

namespace delaunayflip
{

PointSet::PointSet(std::int64_t points, const ThreadBackend& backend)
  : Words(backend.MakeArray<std::uint32_t>((points + WordBits - 1) / WordBits))
{
  std::uint32_t* words = this->Words.Data();
  backend.ForEach(
    static_cast<std::int64_t>(this->Words.Size()), [=](std::int64_t i) { words[i] = 0; });
}

void PointSet::Number(const ThreadBackend& backend)
{
  const auto size = static_cast<std::int64_t>(this->Words.Size());
  this->Firsts = backend.MakeArray<std::uint32_t>(size);
  std::uint32_t* firsts = this->Firsts.Data();
  const std::uint32_t* words = this->Words.Data();
  const auto count = [=](std::int64_t i) { return __builtin_popcount(words[i]); };
  const ThreadNumbering numbering = backend.Count(size, count);
  if (numbering.Total > std::numeric_limits<std::int32_t>::max())
  {
    throw MeshTooLarge("a piece has more than 2^31 points: divide the mesh into more pieces");
  }
  backend.ForEachNumbered(numbering, size, count,
    [=](std::int64_t i, std::int64_t first) { firsts[i] = static_cast<std::uint32_t>(first); });
  this->Size = numbering.Total;
}

//------------------------------------------------------------------------------
SubMesh::SubMesh(
  const TriangleMesh& mesh, std::vector<std::int64_t> slots, const ThreadBackend& backend)
  : Whole(mesh),
    Engine(backend),
    PointIds(mesh.Points.Count, backend),
    Slots(std::move(slots))
{
  const TriangleArray& triangles = mesh.Triangles;
  const std::int64_t count = this->GetNumberOfTriangles();
  ForEachCorner(count, this->Engine,
    [&](std::int64_t i, int slot) { this->PointIds.Add(triangles.Get(this->Slots[i], slot)); });
  this->PointIds.Number(this->Engine);
  CheckMeshSize(count, this->PointIds.GetSize());
  this->Ids = this->Engine.MakeArray<std::int32_t>(3 * count);
  ForEachCorner(count, this->Engine,
    [&](std::int64_t i, int slot)
    { this->Ids[3 * i + slot] = this->PointIds.GetNumber(triangles.Get(this->Slots[i], slot)); });
  const std::int64_t size = this->PointIds.GetSize();
  this->PointOf = this->Engine.MakeArray<std::int64_t>(size);
  this->PointIds.ForEach(
    this->Engine, [&](std::int64_t point, std::int64_t number) { this->PointOf[number] = point; });
  this->Take(mesh.Points.Floats, this->PointOf.Data(), size, 3, this->Floats);
  this->Take(mesh.Points.Doubles, this->PointOf.Data(), size, 3, this->Doubles);
  this->Take(mesh.Regions, this->Slots.data(), count, 1, this->Regions);
  this->Take(mesh.FrozenTriangles, this->Slots.data(), count, 1, this->Frozen);
}

/// Copies tuples of the mesh.
/// @param from may be null: then nothing is copied.
/// @param ids the numbers of `count` tuples.
template <typename T>
void SubMesh::Take(
  const T* from, const std::int64_t* ids, std::int64_t count, int components, Array<T>& to) const
{
  if (!from)
  {
    return;
  }
  to = this->Engine.MakeArray<T>(components * count);
  this->Engine.ForEach(count,
    [&](std::int64_t i)
    { std::copy_n(from + components * ids[i], components, to.Data() + components * i); });
}

void SubMesh::FixEdges(const std::vector<std::int64_t>& ends)
{
  for (std::size_t i = 0; i < ends.size(); i += 2)
  {
    const std::int64_t a = ends[i];
    const std::int64_t b = ends[i + 1];
    if (this->PointIds.Has(a) && this->PointIds.Has(b))
    {
      this->Edges.push_back(this->PointIds.GetNumber(a));
      this->Edges.push_back(this->PointIds.GetNumber(b));
    }
  }
}

TriangleMesh SubMesh::View(bool withLabels) const
{
  const auto points = static_cast<std::int64_t>(this->PointOf.Size());
  TriangleMesh mesh;
  mesh.Points = PointArray(this->Doubles.Data(), points);
  if (this->Whole.Points.Floats)
  {
    mesh.Points = PointArray(this->Floats.Data(), points);
  }
  mesh.Triangles = TriangleArray(this->Ids.Data(), this->GetNumberOfTriangles());
  mesh.ConstraintEdges = this->Edges.data();
  mesh.NumberOfConstraintEdges = SizeOf(this->Edges) / 2;
  mesh.Whole = this->Whole.Whole;
  mesh.Whole.SharedPoints = this->Shared.Data(); // null if there is none, as below
  if (withLabels)
  {
    mesh.Regions = this->Regions.Data();
    mesh.FrozenTriangles = this->Frozen.Data();
  }
  return mesh;
}

//------------------------------------------------------------------------------
namespace
{
/// The cuts of FindParts.
class PartCuts
{
public:
  PartCuts(const TriangleMesh& mesh, const std::vector<int>& axes, int parts)
    : Axes(axes)
  {
    constexpr std::int64_t LargestSample = 1 << 20;
    const std::int64_t triangles = mesh.Triangles.Count;
    const bool isSample = triangles > LargestSample;
    std::vector<Center> centers(std::min(triangles, LargestSample));
    for (std::size_t i = 0; i < centers.size(); ++i)
    {
      // A sample is scattered, because neighbours in the array may be neighbours in space.
      const std::uint64_t t = isSample ? ScatterBits(i) % triangles : i;
      centers[i] = GetCenter(mesh, static_cast<std::int64_t>(t));
    }
    this->First = this->Divide(centers.data(), centers.data() + centers.size(), 0, parts);
  }

  /// The part, 0 to parts - 1, in which the centre of a triangle lies.
  int FindPart(const TriangleMesh& mesh, std::int64_t triangle) const
  {
    const Center center = GetCenter(mesh, triangle);
    int side = this->First;
    while (side >= 0)
    {
      const Cut& cut = this->Cuts[side];
      side = cut.Sides[center[cut.Axis] < cut.Value ? 0 : 1];
    }
    return ~side;
  }

private:
  using Center = std::array<double, 3>;

  /// Centres with a coordinate below the value belong to the first of the two sides. A side is the
  /// index of another cut or, if negative, the part ~side.
  struct Cut
  {
    int Axis;
    double Value;
    int Sides[2];
  };

  /// Three times the centre of a triangle; NaN counts as 0.
  static Center GetCenter(const TriangleMesh& mesh, std::int64_t triangle)
  {
    Center center{ 0.0, 0.0, 0.0 };
    for (int axis = 0; axis < 3; ++axis)
    {
      for (int slot = 0; slot < 3; ++slot)
      {
        center[axis] += mesh.Points.Get(mesh.Triangles.Get(triangle, slot), axis);
      }
      if (std::isnan(center[axis]))
      {
        center[axis] = 0.0;
      }
    }
    return center;
  }

  /// @returns the side that a range of the sample belongs to.
  int Divide(Center* begin, Center* end, int firstPart, int parts)
  {
    if (parts == 1 || begin == end)
    {
      return ~firstPart;
    }
    const int axis = FindLongestAxis(
      begin, end, this->Axes, [](const Center& center, int a) { return center[a]; });
    Center* middle = begin + (end - begin) / parts * (parts / 2);
    std::nth_element(
      begin, middle, end, [=](const Center& a, const Center& b) { return a[axis] < b[axis]; });
    const double value = (*middle)[axis];
    // Equal centres stay together.
    middle = std::partition(begin, end, [=](const Center& one) { return one[axis] < value; });
    const auto cut = static_cast<int>(this->Cuts.size());
    this->Cuts.push_back({ axis, value, {} });
    const int first = this->Divide(begin, middle, firstPart, parts / 2);
    const int second = this->Divide(middle, end, firstPart + parts / 2, parts - parts / 2);
    this->Cuts[cut].Sides[0] = first;
    this->Cuts[cut].Sides[1] = second;
    return cut;
  }

  std::vector<int> Axes;
  std::vector<Cut> Cuts;
  int First; ///< The side that is the whole mesh.
};
}

void CopyTriangles(
  const TriangleArray& from, const MutableTriangleArray& to, const ThreadBackend& threads)
{
  if (from.Data() != to.Data())
  {
    ForEachCorner(
      from.Count, threads, [&](std::int64_t t, int slot) { to.Set(t, slot, from.Get(t, slot)); });
  }
}

Array<unsigned char> FindParts(
  const TriangleMesh& mesh, const std::vector<int>& axes, int parts, const ThreadBackend& threads)
{
  const PartCuts cuts(mesh, axes, parts);
  Array<unsigned char> partOf = threads.MakeArray<unsigned char>(mesh.Triangles.Count);
  threads.ForEach(mesh.Triangles.Count,
    [&](std::int64_t t) { partOf[t] = static_cast<unsigned char>(cuts.FindPart(mesh, t)); });
  return partOf;
}

}
