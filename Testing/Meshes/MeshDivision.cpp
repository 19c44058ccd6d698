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

/// Some triangles of a mesh, which may be put into another order.
struct TriangleRange
{
  std::int64_t* Begin;
  std::int64_t* End;
};

class SpaceDivider
{
  /// Three times the centre of a triangle; NaN counts as 0.
  double GetCenter(std::int64_t triangle, int axis) const
  {
    double sum = 0.0;
    for (int slot = 0; slot < 3; ++slot)
    {
      sum += this->Mesh.Points.Get(this->Mesh.Triangles.Get(triangle, slot), axis);
    }
    return std::isnan(sum) ? 0.0 : sum;
  }

  auto CompareAlong(int axis) const
  {
    return [this, axis](std::int64_t a, std::int64_t b)
    {
      const double left = this->GetCenter(a, axis), right = this->GetCenter(b, axis);
      return left < right || (left == right && a < b);
    };
  }

public:
  explicit SpaceDivider(const TriangleMesh& mesh)
    : RankOf(mesh.Triangles.Count),
      Mesh(mesh)
  {
  }

  /// Cuts a range until each part has one rank.
  void Cut(const TriangleRange& range, int first, int ranks)
  {
    if (ranks == 1 || range.Begin == range.End)
    {
      std::for_each(range.Begin, range.End, [&](std::int64_t t) { this->RankOf[t] = first; });
      return;
    }
    double extents[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      const auto ends = std::minmax_element(range.Begin, range.End, this->CompareAlong(axis));
      extents[axis] = this->GetCenter(*ends.second, axis) - this->GetCenter(*ends.first, axis);
    }
    const auto longest = static_cast<int>(std::max_element(extents, extents + 3) - extents);
    std::int64_t* middle = range.Begin + (range.End - range.Begin) / ranks * (ranks / 2);
    std::nth_element(range.Begin, middle, range.End, this->CompareAlong(longest));
    this->Cut({ range.Begin, middle }, first, ranks / 2);
    this->Cut({ middle, range.End }, first + ranks / 2, ranks - ranks / 2);
  }

  Owners RankOf;

private:
  const TriangleMesh& Mesh;
};

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

OwnPiece MakePiece(const TriangleMesh& mesh, std::vector<std::int64_t> triangles)
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
  std::vector<std::int64_t> order(mesh.Triangles.Count);
  std::iota(order.begin(), order.end(), 0);
  SpaceDivider divider(mesh);
  divider.Cut({ order.data(), order.data() + order.size() }, 0, ranks);
  return divider.RankOf;
}

std::vector<OwnPiece> DivideMesh(const TriangleMesh& mesh, const Owners& owners, int ranks)
{
  std::vector<std::vector<std::int64_t>> triangles(ranks);
  for (std::int64_t t = 0; t < mesh.Triangles.Count; ++t)
  {
    triangles[owners[t]].push_back(t);
  }
  std::vector<OwnPiece> pieces;
  for (std::vector<std::int64_t>& own : triangles)
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
