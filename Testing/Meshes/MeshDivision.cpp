// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "MeshDivision.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace delaunayflip
{
namespace
{

/// Three times the centre of a triangle; NaN counts as 0.
double GetCenter(const TriangleMesh& mesh, std::int64_t triangle, int axis)
{
  double sum = 0.0;
  for (int slot = 0; slot < 3; ++slot)
  {
    sum += mesh.Points.Get(mesh.Triangles.Get(triangle, slot), axis);
  }
  return std::isnan(sum) ? 0.0 : sum;
}

using Triangles = std::vector<std::int64_t>;

/// Cuts triangles until each part has one rank, from `first` on.
void Cut(const TriangleMesh& mesh, Triangles triangles, int first, int ranks, Owners& owners)
{
  const auto compareAlong = [&mesh](int axis)
  {
    return [&mesh, axis](std::int64_t a, std::int64_t b)
    {
      const double left = GetCenter(mesh, a, axis), right = GetCenter(mesh, b, axis);
      return left < right || (left == right && a < b);
    };
  };
  if (ranks == 1 || triangles.empty())
  {
    std::for_each(triangles.begin(), triangles.end(), [&](std::int64_t t) { owners[t] = first; });
    return;
  }
  double extents[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto [low, high] =
      std::minmax_element(triangles.begin(), triangles.end(), compareAlong(axis));
    extents[axis] = GetCenter(mesh, *high, axis) - GetCenter(mesh, *low, axis);
  }
  const auto longest = static_cast<int>(std::max_element(extents, extents + 3) - extents);
  const auto middle =
    triangles.begin() + static_cast<std::ptrdiff_t>(triangles.size()) / ranks * (ranks / 2);
  std::nth_element(triangles.begin(), middle, triangles.end(), compareAlong(longest));
  Cut(mesh, { triangles.begin(), middle }, first, ranks / 2, owners);
  Cut(mesh, { middle, triangles.end() }, first + ranks / 2, ranks - ranks / 2, owners);
}

/// @param localOf the id of every point in the piece, or -1.
std::int32_t AddPoint(
  const TriangleMesh& mesh, std::int64_t point, std::vector<std::int32_t>& localOf, OwnPiece& piece)
{
  std::int32_t& local = localOf[point];
  if (local < 0)
  {
    local = static_cast<std::int32_t>(piece.PointOf.size());
    piece.PointOf.push_back(point);
    for (int axis = 0; axis < 3; ++axis)
    {
      const double x = mesh.Points.Get(point, axis);
      mesh.Points.Floats ? piece.Floats.push_back(static_cast<float>(x))
                         : piece.Doubles.push_back(x);
    }
  }
  return local;
}

OwnPiece MakePiece(const TriangleMesh& mesh, Triangles triangles)
{
  std::vector<std::int32_t> localOf(mesh.Points.Count, -1);
  OwnPiece piece;
  for (const std::int64_t t : triangles)
  {
    for (int slot = 0; slot < 3; ++slot)
    {
      piece.Triangles.push_back(AddPoint(mesh, mesh.Triangles.Get(t, slot), localOf, piece));
    }
    if (mesh.Regions)
    {
      piece.Regions.push_back(mesh.Regions[t]);
    }
    if (mesh.FrozenTriangles)
    {
      piece.Frozen.push_back(mesh.FrozenTriangles[t]);
    }
  }
  piece.SlotOf = std::move(triangles);
  for (std::int64_t i = 0; i < mesh.NumberOfConstraintEdges; ++i)
  {
    const std::int64_t a = localOf[mesh.ConstraintEdges[2 * i]];
    const std::int64_t b = localOf[mesh.ConstraintEdges[2 * i + 1]];
    if (a >= 0 && b >= 0)
    {
      piece.Constraints.insert(piece.Constraints.end(), { a, b });
      if (mesh.ConstraintsToInsert)
      {
        piece.ToInsert.push_back(mesh.ConstraintsToInsert[i]);
      }
    }
  }
  return piece;
}

template <typename T>
const T* ViewOrNull(const std::vector<T>& values)
{
  return values.empty() ? nullptr : values.data();
}

}

MeshPiece OwnPiece::View(bool withNumbers) const
{
  MeshPiece piece;
  const auto points = static_cast<std::int64_t>(this->PointOf.size());
  TriangleMesh& mesh = piece.Mesh;
  mesh.Points = this->Doubles.empty() ? PointArray(this->Floats.data(), points)
                                      : PointArray(this->Doubles.data(), points);
  mesh.Triangles =
    TriangleArray(this->Triangles.data(), static_cast<std::int64_t>(this->SlotOf.size()));
  mesh.ConstraintEdges = this->Constraints.data();
  mesh.NumberOfConstraintEdges = static_cast<std::int64_t>(this->Constraints.size()) / 2;
  mesh.ConstraintsToInsert = ViewOrNull(this->ToInsert);
  mesh.Regions = ViewOrNull(this->Regions);
  mesh.FrozenTriangles = ViewOrNull(this->Frozen);
  piece.PointNumbers = withNumbers ? this->PointOf.data() : nullptr;
  return piece;
}

Owners DivideBySpace(const TriangleMesh& mesh, int ranks)
{
  Triangles all(mesh.Triangles.Count);
  std::iota(all.begin(), all.end(), 0);
  Owners owners(all.size());
  Cut(mesh, std::move(all), 0, ranks, owners);
  return owners;
}

std::vector<OwnPiece> DivideMesh(const TriangleMesh& mesh, const Owners& owners, int ranks)
{
  std::vector<Triangles> triangles(ranks);
  for (std::int64_t t = 0; t < mesh.Triangles.Count; ++t)
  {
    triangles[owners[t]].push_back(t);
  }
  std::vector<OwnPiece> pieces;
  for (Triangles& own : triangles)
  {
    pieces.push_back(MakePiece(mesh, std::move(own)));
  }
  return pieces;
}

std::vector<OwnPiece> DivideMesh(const TriangleMesh& mesh, int ranks)
{
  return DivideMesh(mesh, DivideBySpace(mesh, ranks), ranks);
}

}
