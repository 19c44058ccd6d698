// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ConstraintOracle.h"
#include "GivenConstraints.h"
#include "PieceConstraints.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <vector>

/// @file
/// Triangles that were lent to another rank, which inserts constraints, come back.

namespace delaunayflip
{
namespace
{

/// Lines across the unit square, each in a strip of its own.
ConstrainedMesh DrawLines(std::int64_t points, int lines)
{
  ConstrainedMesh drawn;
  drawn.Mesh = MakeRandomBadMeshDouble(points, 31);
  const std::vector<double>& x = drawn.Mesh.Points;
  for (int line = 0; line < lines; ++line)
  {
    std::vector<std::int64_t> strip;
    for (std::int64_t i = 0; i < drawn.Mesh.NumberOfPoints(); ++i)
    {
      const double y = lines * x[3 * i + 1];
      if (line + 0.1 < y && y < line + 0.9)
      {
        strip.push_back(i);
      }
    }
    const auto ends = std::minmax_element(strip.begin(), strip.end(),
      [&](std::int64_t a, std::int64_t b) { return x[3 * a] < x[3 * b]; });
    drawn.Add(*ends.first, *ends.second);
  }
  return drawn;
}

/// What a division is after constraints were inserted, and before flips make anything Delaunay.
struct Inserted
{
  std::vector<FlippedPiece> Pieces;
  std::vector<PiecesReport> Reports;
};

/// @param stopAt the share of the run at which the last rank stops all: after the insertions, so
/// that no round moves triangles.
Inserted Insert(const std::vector<OwnedPiece>& pieces, double stopAt = 0.26)
{
  Inserted made{ std::vector<FlippedPiece>(pieces.size()),
    std::vector<PiecesReport>(pieces.size()) };
  FlipOptions options = MakeCanonical();
  options.MaximumIterations = 0;
  RunInThreads(static_cast<int>(pieces.size()),
    [&](PieceGroup& group)
    {
      const int rank = group.GetRank();
      const bool isLast = rank + 1 == group.GetSize();
      made.Reports[rank] = FlipPiece(pieces[rank].View(true), options, group, made.Pieces[rank],
        [=](double share) { return !isLast || share < stopAt; });
    });
  return made;
}

/// Expects that every rank has the triangles that it gave, in their order.
void ExpectOwnTriangles(const std::vector<OwnedPiece>& pieces, const Inserted& made)
{
  ExpectSameOnAllRanks(made.Reports);
  EXPECT_EQ(StopReasonKind::Aborted, made.Reports.front().StopReason);
  for (std::size_t rank = 0; rank < pieces.size(); ++rank)
  {
    const std::vector<PieceOrigin> origins = ListOrigins(made.Pieces[rank], static_cast<int>(rank));
    ASSERT_EQ(pieces[rank].SlotOf.size(), origins.size());
    for (std::size_t t = 0; t < origins.size(); ++t)
    {
      ASSERT_EQ(static_cast<std::int32_t>(rank), origins[t].Rank);
      ASSERT_EQ(static_cast<std::int64_t>(t), origins[t].Id);
    }
  }
}

/// The triangles of all pieces, in their slots of the whole mesh.
std::vector<std::int32_t> Join(
  const TriangleMesh& mesh, const std::vector<OwnedPiece>& pieces, const Inserted& made)
{
  std::vector<std::int32_t> ids(3 * mesh.Triangles.Count);
  for (std::size_t rank = 0; rank < pieces.size(); ++rank)
  {
    const FlippedPiece& flipped = made.Pieces[rank];
    const std::vector<std::int64_t>& own = pieces[rank].PointOf;
    for (std::size_t i = 0; i < flipped.Triangles.size(); ++i)
    {
      std::size_t point = flipped.Triangles[i];
      std::size_t owner = rank;
      if (point >= own.size())
      {
        const PieceOrigin& from = flipped.ReceivedPoints[point - own.size()];
        point = from.Id;
        owner = from.Rank;
      }
      ids[3 * pieces[rank].SlotOf[i / 3] + i % 3] =
        static_cast<std::int32_t>(pieces[owner].PointOf[point]);
    }
  }
  return ids;
}

/// Twice the area of every region.
std::map<std::int32_t, double> SumRegions(const TriangleMesh& mesh)
{
  std::map<std::int32_t, double> sums;
  for (std::int64_t t = 0; t < mesh.Triangles.Count; ++t)
  {
    double x[3][2];
    for (int i = 0; i < 6; ++i)
    {
      x[i / 2][i % 2] = mesh.Points.Get(mesh.Triangles.Get(t, i / 2), i % 2);
    }
    sums[mesh.Regions[t]] +=
      (x[1][0] - x[0][0]) * (x[2][1] - x[0][1]) - (x[2][0] - x[0][0]) * (x[1][1] - x[0][1]);
  }
  return sums;
}

/// A point with triangles of a rank, after the insertions.
struct RankPoint
{
  std::int64_t Key;
  bool IsShared;
};

/// @returns those of every rank, each once.
std::vector<std::vector<RankPoint>> FindPoints(const std::vector<OwnedPiece>& pieces)
{
  std::vector<std::vector<RankPoint>> points(pieces.size());
  RunInThreads(static_cast<int>(pieces.size()),
    [&](PieceGroup& group)
    {
      const int rank = group.GetRank();
      const MeshPiece piece = pieces[rank].View(true);
      const FlipOptions options = MakeCanonical();
      const ProgressObserver none;
      const PointKeys keys = MatchPoints(piece, group);
      const PieceSurvey survey = SurveyPieces(piece, keys, options, group);
      PieceMesh mesh(piece, keys, rank, 0);
      const PieceConstraints constraints({ piece, options, survey, group, none }, mesh);
      std::map<std::int64_t, bool> known;
      for (const PieceTriangle& triangle : mesh.Triangles)
      {
        for (const std::int32_t point : triangle.Points)
        {
          known[mesh.GetKey(point)] = mesh.IsShared(point);
        }
      }
      for (const auto& [key, isShared] : known)
      {
        points[rank].push_back({ key, isShared });
      }
    });
  return points;
}

class PieceReturnTest : public RanksTest
{
protected:
  std::vector<OwnedPiece> CutIt(const TriangleMesh& mesh) const
  {
    return GiveFar(mesh, Divide(mesh, this->Cut(mesh), GetParam()));
  }
};

TEST_P(PieceReturnTest, LongConstraintsHardlyAddSeamEdges)
{
  const ConstrainedMesh drawn = DrawLines(12000, 9);
  TriangleMesh mesh = drawn.View();
  const PiecesReport with = ExpectAsAlone(mesh, this->CutIt(mesh)).Reports.front();
  EXPECT_EQ(9, with.InsertedConstraints);
  mesh.NumberOfConstraintEdges = 0;
  const PiecesReport without =
    FlipDivided(mesh, this->CutIt(mesh), MakeCanonical()).Reports.front();
  EXPECT_LT(6 * with.SeamEdges, 7 * without.SeamEdges);
  EXPECT_LT(6 * with.MovedTriangles, 7 * without.MovedTriangles);
}

TEST_P(PieceReturnTest, PointsAreSharedWhereTrianglesOfSeveralRanksMeet)
{
  const ConstrainedMesh drawn = DrawLines(12000, 9);
  std::map<std::int64_t, int> ranks; // with triangles at a point
  std::map<std::int64_t, int> shares; // of these, those that take it for a shared one
  for (const std::vector<RankPoint>& list : FindPoints(this->CutIt(drawn.View())))
  {
    for (const RankPoint& point : list)
    {
      ++ranks[point.Key];
      shares[point.Key] += point.IsShared ? 1 : 0;
    }
  }
  std::int64_t needless = 0;
  for (const auto& [key, count] : ranks)
  {
    EXPECT_TRUE(count == 1 || shares[key] == count) << key;
    needless += count == 1 ? shares[key] : 0;
  }
  EXPECT_LT(needless, 1000); // of 12,000; thousands are lent
}

TEST_P(PieceReturnTest, EveryRankHasItsTriangles)
{
  for (std::uint32_t seed = 0; seed < 4; ++seed)
  {
    SCOPED_TRACE(seed);
    ConstrainedMesh drawn = DropCrossing(DrawCase(200, 1000, 40, seed));
    if (seed % 2 != 0) // flips need a guard
    {
      drawn.Mesh.Triangles.insert(drawn.Mesh.Triangles.end(), { 5, 5, 6 });
    }
    const TriangleMesh mesh = drawn.View();
    Owners owners = this->Cut(mesh);
    std::replace(owners.begin(), owners.end(), GetParam() / 2, 0); // that rank has none
    const std::vector<OwnedPiece> pieces = GiveFar(mesh, Divide(mesh, owners, GetParam()));
    const Inserted made = Insert(pieces);
    EXPECT_LT(0, made.Reports.front().InsertedConstraints);
    ExpectOwnTriangles(pieces, made);
    const std::vector<std::int32_t> ids = Join(mesh, pieces, made);
    ExpectEdges(ids, PredictInsertion(mesh).Pieces);
    EXPECT_EQ(SumAreas(mesh), SumAreas(WithTriangles(mesh, ids)));
  }
}

TEST_P(PieceReturnTest, WithTheirRegionsAndFrozenOnesUnchanged)
{
  for (std::uint32_t seed = 0; seed < 4; ++seed)
  {
    SCOPED_TRACE(seed);
    const ConstrainedMesh drawn = DropCrossing(DrawCase(200, 1000, 40, seed));
    TriangleMesh mesh = drawn.View();
    std::vector<std::int32_t> regions;
    std::vector<unsigned char> frozen;
    for (std::int64_t t = 0; t < mesh.Triangles.Count; ++t)
    {
      const double x = mesh.Points.Get(mesh.Triangles.Get(t, 0), 0);
      regions.push_back(x > 500.0 ? -7 : 3);
      frozen.push_back(t % 50 == 0 ? 1 : 0);
    }
    mesh.Regions = regions.data();
    mesh.FrozenTriangles = frozen.data();
    const std::vector<OwnedPiece> pieces = this->CutIt(mesh);
    const Inserted made = Insert(pieces);
    ExpectOwnTriangles(pieces, made);
    const std::vector<std::int32_t> ids = Join(mesh, pieces, made);
    EXPECT_NE(drawn.Mesh.Triangles, ids);
    EXPECT_EQ(SumRegions(mesh), SumRegions(WithTriangles(mesh, ids)));
    for (std::int64_t i = 0; i < 3 * mesh.Triangles.Count; ++i)
    {
      EXPECT_TRUE(frozen[i / 3] == 0 || ids[i] == drawn.Mesh.Triangles[i]) << i / 3;
    }
  }
}

TEST_P(PieceReturnTest, AlsoIfARankStopsAll)
{
  const ConstrainedMesh drawn = DropCrossing(DrawCase(200, 1000, 60, 5));
  const TriangleMesh mesh = drawn.View();
  const std::vector<OwnedPiece> pieces = this->CutIt(mesh);
  for (const double share : { 0.0, 0.19, 0.21, 0.24 })
  {
    SCOPED_TRACE(share);
    const Inserted made = Insert(pieces, share);
    ExpectOwnTriangles(pieces, made);
    EXPECT_EQ(SumAreas(mesh), SumAreas(WithTriangles(mesh, Join(mesh, pieces, made))));
  }
}

INSTANTIATE_TEST_SUITE_P(Pieces, PieceReturnTest, testing::Values(2, 4, 7, 16), NameRanks);

}
}
