// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "RoundFlips.h"
#include "PieceTestSupport.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

/// @file
/// The flips of a round, on meshes that one rank has alone.

namespace delaunayflip
{
namespace
{

/// A mesh as a round finds it.
class RoundMesh
{
public:
  /// @param shared points that other ranks may have, too.
  RoundMesh(OwnedMesh<double> mesh, const FlipOptions& options,
    const std::vector<std::int64_t>& shared = {})
    : Mesh(std::move(mesh)),
      Piece{ this->Mesh.View() },
      Survey(
        SurveyPieces(this->Piece, MatchPoints(this->Piece, *this->Alone), options, *this->Alone)),
      Rule(this->Survey, options),
      Triangles(this->Piece, MakeKeys(shared), 0, 0)
  {
    this->Triangles.ListAll();
    this->Triangles.BeginRounds(true);
  }

  TriangleSet GetSet() const
  {
    std::vector<std::int32_t> ids;
    for (const PieceTriangle& triangle : this->Triangles.Triangles)
    {
      ids.insert(ids.end(), triangle.Points, triangle.Points + 3);
    }
    return ToTriangleSet(ids);
  }

  std::int64_t CountFlips() const
  {
    std::int64_t flips = 0;
    for (const PieceTriangle& triangle : this->Triangles.Triangles)
    {
      flips += triangle.Flips;
    }
    return flips / 2; // each counts for two triangles
  }

private:
  PointKeys MakeKeys(const std::vector<std::int64_t>& shared) const
  {
    PointKeys keys = MatchPoints(this->Piece, *this->Alone);
    std::for_each(shared.begin(), shared.end(), [&](std::int64_t id) { keys.Shared[id] = 1; });
    return keys;
  }

  std::unique_ptr<PieceGroup> Alone = MakeSingleGroup();
  OwnedMesh<double> Mesh;
  MeshPiece Piece;
  PieceSurvey Survey;

public:
  QuadJudge Rule;
  PieceMesh Triangles;
};

/// Iterates to the end and checks the rows. @returns their sum.
IterationRecord RunAll(RoundFlips& flips, std::int64_t triangles)
{
  IterationRecord sum;
  while (!flips.AreDone())
  {
    const bool hasBad = flips.HasBad();
    const IterationRecord row = flips.Iterate();
    EXPECT_EQ(hasBad, row.Flipped > 0);
    EXPECT_EQ(row.NonDelaunay, row.Flipped + row.Blocked);
    EXPECT_LE(row.NonDelaunay, row.Tested);
    EXPECT_LE(2 * row.Flipped, triangles);
    sum.Tested += row.Tested;
    sum.Flipped += row.Flipped;
    sum.Blocked += row.Blocked;
  }
  return sum;
}

TEST(RoundFlips, MakeTheTrianglesOfASession)
{
  const OwnedMesh<double> mesh = MakeRandomBadMeshDouble(300, 5);
  RoundMesh round(mesh, MakeCanonical());
  RoundFlips flips(round.Triangles, round.Rule, false);
  for (std::int64_t t = 0; t < mesh.NumberOfTriangles(); ++t)
  {
    flips.Add(t);
    flips.Add(t); // once is enough
  }
  EXPECT_EQ(static_cast<std::size_t>(mesh.NumberOfTriangles()), flips.GetNext().size());
  const IterationRecord sum = RunAll(flips, mesh.NumberOfTriangles());
  EXPECT_EQ(ToTriangleSet(Flip(mesh.View(), MakeCanonical()).Triangles), round.GetSet());
  EXPECT_LT(0, sum.Flipped);
  EXPECT_EQ(0, sum.Blocked);
  EXPECT_EQ(round.CountFlips(), sum.Flipped);
}

/// Whether the quad around an edge is strictly convex in the plane.
bool IsConvex(const PieceMesh& mesh, const PieceCorner& one, const PieceCorner& other)
{
  const PieceTriangle& triangle = mesh.Triangles[one.Triangle];
  double a[3], b[3], p[3], q[3];
  mesh.GetPosition(triangle.Points[one.Slot], a);
  mesh.GetPosition(mesh.Triangles[other.Triangle].Points[other.Slot], b);
  mesh.GetPosition(triangle.GetStart(one.Slot), p);
  mesh.GetPosition(triangle.GetEnd(one.Slot), q);
  const auto side = [&](const double(&x)[3])
  { return (b[0] - a[0]) * (x[1] - a[1]) - (b[1] - a[1]) * (x[0] - a[0]); };
  return side(p) * side(q) < 0.0;
}

/// Flips some edges of a Delaunay mesh that may flip, no two of them in one triangle.
/// @returns the triangles that have changed.
std::vector<std::int64_t> Spoil(RoundMesh& round)
{
  std::vector<std::int64_t> changed;
  PieceMesh& mesh = round.Triangles;
  for (std::int64_t t = 20; t < 300; t += 60)
  {
    const PieceCorner one{ t, 0 };
    const PieceCorner other = mesh.FindOpenMate(one);
    if (other.Triangle >= 0 && mesh.Triangles[t].Flips == 0 &&
      mesh.Triangles[other.Triangle].Flips == 0 && IsConvex(mesh, one, other))
    {
      mesh.Flip(one, other);
      changed.insert(changed.end(), { t, other.Triangle });
    }
  }
  return changed;
}

TEST(RoundFlips, ReachOnlyAsFarAsFlipsDo)
{
  OwnedMesh<double> mesh = MakeRandomBadMeshDouble(300, 6);
  mesh.Triangles = Flip(mesh.View(), MakeCanonical()).Triangles;
  RoundMesh round(mesh, MakeCanonical());
  const TriangleSet delaunay = round.GetSet();
  const std::vector<std::int64_t> changed = Spoil(round);
  ASSERT_LT(2u, changed.size());
  ASSERT_NE(delaunay, round.GetSet());
  RoundFlips flips(round.Triangles, round.Rule, false);
  for (std::size_t i = 0; i < changed.size(); i += 2)
  {
    flips.Add(changed[i]);
  }
  const IterationRecord sum = RunAll(flips, mesh.NumberOfTriangles());
  EXPECT_EQ(delaunay, round.GetSet());
  EXPECT_LT(sum.Tested, 20 * static_cast<std::int64_t>(changed.size()));
}

/// Two quads on a surface, at a right angle: the edge 1-2 is bad, and its flip would make the edge
/// 0-3, which the other quad has and which is bad, too.
OwnedMesh<double> MakeWaitingEdge()
{
  OwnedMesh<double> mesh;
  mesh.Points = { 0, 1, 0, -3, 0, 0, 3, 0, 0, 0, -1, 0, 0, 0, 0.3, 0, 0, -0.3 };
  mesh.Triangles = { 0, 1, 2, 3, 2, 1, 4, 0, 3, 5, 3, 0 };
  return mesh;
}

TEST(RoundFlips, EdgesWaitUntilTheirPlaceIsFree)
{
  RoundMesh round(MakeWaitingEdge(), MakeOnSurface());
  RoundFlips flips(round.Triangles, round.Rule, true);
  flips.Add(0);
  EXPECT_FALSE(flips.HasBad());
  const IterationRecord waiting = RunAll(flips, 4);
  EXPECT_EQ(0, waiting.Flipped);
  EXPECT_EQ(1, waiting.Blocked);
  flips.Add(2); // frees the place of the edge that waits
  EXPECT_EQ(2, RunAll(flips, 4).Flipped);
  EXPECT_EQ(
    ToTriangleSet(std::vector<std::int32_t>{ 0, 1, 3, 3, 2, 0, 4, 0, 5, 5, 3, 4 }), round.GetSet());
}

TEST(RoundFlips, FreedEdgesAreJudgedAgain)
{
  RoundMesh round(MakeWaitingEdge(), MakeOnSurface());
  RoundFlips flips(round.Triangles, round.Rule, true);
  flips.AddFreed(1, 2); // no edge waits for this one
  EXPECT_TRUE(flips.AreDone());
  flips.AddFreed(3, 0);
  EXPECT_EQ(std::vector<std::int64_t>{ 1 }, flips.GetNext());
}

TEST(RoundFlips, DoNotMakeEdgesThatOtherRanksMayHave)
{
  OwnedMesh<double> mesh = MakeWaitingEdge();
  mesh.Triangles.resize(6); // the first quad
  RoundMesh shared(mesh, MakeOnSurface(), { 0, 3 });
  RoundFlips guarded(shared.Triangles, shared.Rule, true);
  guarded.Add(0);
  EXPECT_EQ(1, RunAll(guarded, 2).Blocked);
  RoundFlips unguarded(shared.Triangles, shared.Rule, false);
  unguarded.Add(0);
  EXPECT_EQ(1, RunAll(unguarded, 2).Flipped);
}

}
}
