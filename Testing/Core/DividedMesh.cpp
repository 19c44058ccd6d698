// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "DividedMesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace delaunayflip
{

namespace
{
/// Three times the centre of a triangle.
double GetCenter(const TriangleMesh& mesh, std::int64_t triangle, int axis)
{
  double sum = 0.0;
  for (int slot = 0; slot < 3; ++slot)
  {
    sum += mesh.Points.Get(mesh.Triangles.Get(triangle, slot), axis);
  }
  return sum;
}

struct Range
{
  std::int64_t* Begin;
  std::int64_t* End;
};

int FindLongestAxis(const TriangleMesh& mesh, const Range& range)
{
  double extents[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto isLess = [&](std::int64_t a, std::int64_t b)
    { return GetCenter(mesh, a, axis) < GetCenter(mesh, b, axis); };
    const auto ends = std::minmax_element(range.Begin, range.End, isLess);
    extents[axis] = GetCenter(mesh, *ends.second, axis) - GetCenter(mesh, *ends.first, axis);
  }
  return static_cast<int>(std::max_element(extents, extents + 3) - extents);
}

/// Cuts until each part has one rank.
void Cut(const TriangleMesh& mesh, const Range& range, int first, int ranks, Owners& owners)
{
  if (ranks == 1 || range.Begin == range.End)
  {
    std::for_each(range.Begin, range.End, [&](std::int64_t t) { owners[t] = first; });
    return;
  }
  const int axis = FindLongestAxis(mesh, range);
  std::stable_sort(range.Begin, range.End,
    [&](std::int64_t a, std::int64_t b)
    { return GetCenter(mesh, a, axis) < GetCenter(mesh, b, axis); });
  std::int64_t* middle = range.Begin + (range.End - range.Begin) * (ranks / 2) / ranks;
  Cut(mesh, { range.Begin, middle }, first, ranks / 2, owners);
  Cut(mesh, { middle, range.End }, first + ranks / 2, ranks - ranks / 2, owners);
}

class Divider
{
public:
  explicit Divider(const TriangleMesh& mesh)
    : Mesh(mesh)
  {
  }

  OwnedPiece Make(const Owners& owners, int rank)
  {
    this->Local.assign(this->Mesh.Points.Count, -1);
    this->Piece = OwnedPiece();
    for (std::int64_t t = 0; t < this->Mesh.Triangles.Count; ++t)
    {
      if (owners[t] == rank)
      {
        this->AddTriangle(t);
      }
    }
    this->AddConstraints();
    return this->Piece;
  }

private:
  void AddTriangle(std::int64_t t)
  {
    for (int slot = 0; slot < 3; ++slot)
    {
      this->Piece.Triangles.push_back(this->AddPoint(this->Mesh.Triangles.Get(t, slot)));
    }
    this->Piece.SlotOf.push_back(t);
    if (this->Mesh.Regions)
    {
      this->Piece.Regions.push_back(this->Mesh.Regions[t]);
    }
    if (this->Mesh.FrozenTriangles)
    {
      this->Piece.Frozen.push_back(this->Mesh.FrozenTriangles[t]);
    }
  }

  std::int64_t AddPoint(std::int64_t point)
  {
    std::int64_t& local = this->Local[point];
    if (local < 0)
    {
      local = static_cast<std::int64_t>(this->Piece.PointOf.size());
      this->Piece.PointOf.push_back(point);
      for (int axis = 0; axis < 3; ++axis)
      {
        const double x = this->Mesh.Points.Get(point, axis);
        this->Mesh.Points.Floats ? this->Piece.Floats.push_back(static_cast<float>(x))
                                 : this->Piece.Doubles.push_back(x);
      }
    }
    return local;
  }

  void AddConstraints()
  {
    for (std::int64_t i = 0; i < this->Mesh.NumberOfConstraintEdges; ++i)
    {
      const std::int64_t a = this->Local[this->Mesh.ConstraintEdges[2 * i]];
      const std::int64_t b = this->Local[this->Mesh.ConstraintEdges[2 * i + 1]];
      if (a >= 0 && b >= 0)
      {
        this->Piece.Constraints.insert(this->Piece.Constraints.end(), { a, b });
        if (this->Mesh.ConstraintsToInsert)
        {
          this->Piece.ToInsert.push_back(this->Mesh.ConstraintsToInsert[i]);
        }
      }
    }
  }

  const TriangleMesh& Mesh;
  std::vector<std::int64_t> Local;
  OwnedPiece Piece;
};

/// Puts the triangles of one rank into their slots of the whole mesh.
void Collect(const TriangleMesh& mesh, const std::vector<OwnedPiece>& pieces, int rank,
  const FlippedPiece& flipped, GroupResult& result)
{
  const OwnedPiece& own = pieces[rank];
  const auto given = static_cast<std::int64_t>(own.PointOf.size());
  const std::vector<PieceOrigin> origins = ListOrigins(flipped, rank);
  for (std::size_t i = 0; i < flipped.Triangles.size(); ++i)
  {
    const PieceOrigin origin = origins[i / 3];
    const std::int64_t slot = pieces[origin.Rank].SlotOf[origin.Id];
    std::int64_t& id = result.Triangles[3 * slot + i % 3];
    EXPECT_EQ(-1, id) << "triangle " << slot << " comes twice";
    const std::int64_t local = flipped.Triangles[i];
    id = local;
    if (local < given)
    {
      id = own.PointOf[local];
    }
    else
    {
      const PieceOrigin point = flipped.ReceivedPoints[local - given];
      id = pieces[point.Rank].PointOf[point.Id];
      EXPECT_EQ(mesh.Points.Get(id, 0), flipped.ReceivedCoordinates[3 * (local - given)]);
    }
    result.FlipCounts[slot] = flipped.FlipCounts[i / 3];
  }
}
}

Owners DivideBySpace(const TriangleMesh& mesh, int ranks)
{
  std::vector<std::int64_t> triangles(mesh.Triangles.Count);
  std::iota(triangles.begin(), triangles.end(), 0);
  Owners owners(mesh.Triangles.Count);
  Cut(mesh, { triangles.data(), triangles.data() + triangles.size() }, 0, ranks, owners);
  return owners;
}

Owners DivideAtRandom(const TriangleMesh& mesh, int ranks, std::uint32_t seed)
{
  std::mt19937 random(seed);
  Owners owners(mesh.Triangles.Count);
  for (int& owner : owners)
  {
    owner = DrawIndex(random, ranks);
  }
  return owners;
}

MeshPiece OwnedPiece::View(bool withNumbers) const
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
  mesh.ConstraintsToInsert = this->ToInsert.empty() ? nullptr : this->ToInsert.data();
  mesh.Regions = this->Regions.empty() ? nullptr : this->Regions.data();
  mesh.FrozenTriangles = this->Frozen.empty() ? nullptr : this->Frozen.data();
  piece.PointNumbers = withNumbers ? this->PointOf.data() : nullptr;
  return piece;
}

std::vector<OwnedPiece> Divide(const TriangleMesh& mesh, const Owners& owners, int ranks)
{
  Divider divider(mesh);
  std::vector<OwnedPiece> pieces;
  for (int rank = 0; rank < ranks; ++rank)
  {
    pieces.push_back(divider.Make(owners, rank));
  }
  return pieces;
}

GroupResult FlipDivided(const TriangleMesh& mesh, const std::vector<OwnedPiece>& pieces,
  const FlipOptions& options, bool withNumbers)
{
  const int ranks = static_cast<int>(pieces.size());
  GroupResult result;
  result.Triangles.assign(3 * mesh.Triangles.Count, -1);
  result.FlipCounts.assign(mesh.Triangles.Count, -1);
  result.Reports.resize(ranks);
  std::vector<FlippedPiece> flipped(ranks);
  RunInThreads(ranks,
    [&](PieceGroup& group)
    {
      const int rank = group.GetRank();
      result.Reports[rank] =
        FlipPiece(pieces[rank].View(withNumbers), options, group, flipped[rank]);
    });
  for (int rank = 0; rank < ranks; ++rank)
  {
    Collect(mesh, pieces, rank, flipped[rank], result);
    result.Sizes.push_back(static_cast<std::int64_t>(flipped[rank].FlipCounts.size()));
  }
  EXPECT_EQ(0, std::count(result.Triangles.begin(), result.Triangles.end(), -1)) << "are lost";
  return result;
}

}
