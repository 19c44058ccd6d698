// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PartTestSupport.h"

#include "MeshAudit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace delaunayflip
{

FlipOptions MakeCanonical(int pieces)
{
  FlipOptions options = OnBackend(BackendKind::Threads);
  options.TieRule = TieRuleKind::Canonical;
  options.NumberOfThreads = 1;
  options.NumberOfPieces = pieces;
  return options;
}

FlipOptions OnSurfaceOfRanks(double featureAngle)
{
  return WithThreads(1, OnBackend(BackendKind::Threads, OnSurface(featureAngle)));
}

Owners DivideAtRandom(const TriangleMesh& mesh, int ranks, std::uint32_t seed)
{
  std::mt19937 random(seed);
  Owners owners(mesh.Triangles.Count);
  std::generate(owners.begin(), owners.end(), [&]() { return DrawIndex(random, ranks); });
  return owners;
}

namespace
{

/// Puts the triangles of one rank into their slots of the whole mesh.
void Collect(const TriangleMesh& mesh, const std::vector<OwnPiece>& pieces, int rank,
  const FlippedPiece& flipped, PartsResult& result)
{
  const OwnPiece& own = pieces[rank];
  const auto given = static_cast<std::int64_t>(own.PointOf.size());
  const std::vector<PieceOrigin> origins = ListOrigins(flipped, rank);
  for (std::size_t i = 0; i < flipped.Triangles.size(); ++i)
  {
    const PieceOrigin origin = origins[i / 3];
    const std::int64_t slot = pieces[origin.Rank].SlotOf[origin.Id];
    std::int32_t& id = result.Triangles[3 * slot + i % 3];
    EXPECT_EQ(-1, id) << "triangle " << slot << " comes twice";
    const std::int64_t local = flipped.Triangles[i];
    std::int64_t point = 0;
    if (local < given)
    {
      point = own.PointOf[local];
    }
    else
    {
      const PieceOrigin received = flipped.ReceivedPoints[local - given];
      point = pieces[received.Rank].PointOf[received.Id];
      EXPECT_EQ(mesh.Points.Get(point, 0), flipped.ReceivedCoordinates[3 * (local - given)]);
    }
    id = static_cast<std::int32_t>(point);
    result.FlipCounts[slot] = flipped.FlipCounts[i / 3];
  }
}

}

PartsResult FlipDivided(const TriangleMesh& mesh, const std::vector<OwnPiece>& pieces,
  const FlipOptions& options, bool withNumbers)
{
  const int ranks = static_cast<int>(pieces.size());
  std::vector<PiecesReport> reports(ranks);
  FlippedPiece old; // Its memory is used again.
  old.Triangles.assign(30, 77);
  old.FlipCounts = { 77 };
  old.GoneTriangles = { 77 };
  old.ReceivedTriangles = old.ReceivedPoints = { { 77, 77 } };
  old.ReceivedCoordinates.assign(3, 77.0);
  std::vector<FlippedPiece> flipped(ranks, old);
  RunInThreads(ranks,
    [&](PieceGroup& group)
    {
      const int rank = group.GetRank();
      reports[rank] = FlipPiece(pieces[rank].View(withNumbers), options, group, flipped[rank]);
    });
  ExpectSameOnAllRanks(reports);
  PartsResult result;
  result.Triangles.assign(3 * mesh.Triangles.Count, -1);
  result.FlipCounts.assign(mesh.Triangles.Count, -1);
  result.Report = reports.back();
  for (int rank = 0; rank < ranks; ++rank)
  {
    Collect(mesh, pieces, rank, flipped[rank], result);
    result.Sizes.push_back(static_cast<std::int64_t>(flipped[rank].FlipCounts.size()));
  }
  EXPECT_EQ(0, std::count(result.Triangles.begin(), result.Triangles.end(), -1)) << "are lost";
  EXPECT_EQ(result.Report.TotalFlips + result.Report.ConstraintFlips, SumFlips(result.FlipCounts));
  return result;
}

PartsResult FlipHere(
  const TriangleMesh& mesh, int parts, FlipOptions options, const ProgressObserver& progress)
{
  options.NumberOfPieces = parts;
  PartsResult result;
  for (std::int64_t i = 0; i < 3 * mesh.Triangles.Count; ++i)
  {
    const std::int64_t id = mesh.Triangles.Get(i / 3, static_cast<int>(i % 3));
    result.Triangles.push_back(static_cast<std::int32_t>(id));
  }
  // The result may replace the input.
  result.Report = FlipInPieces(WithTriangles(mesh, result.Triangles), options,
    MutableTriangleArray(result.Triangles.data(), mesh.Triangles.Count), progress);
  return result;
}

void ExpectSameOnAllRanks(const std::vector<PiecesReport>& reports)
{
  for (const PiecesReport& report : reports)
  {
    ExpectSameStatistics(reports.front(), report);
    EXPECT_EQ(reports.front().Rounds, report.Rounds);
    EXPECT_EQ(reports.front().MovedTriangles, report.MovedTriangles);
    EXPECT_EQ(reports.front().SeamEdges, report.SeamEdges);
  }
}

void ExpectSameCounts(const FlipReport& alone, PiecesReport together)
{
  together.ConstraintFlips = alone.ConstraintFlips;
  together.Iterations = alone.Iterations;
  together.TotalFlips = alone.TotalFlips;
  together.TotalExcluded = alone.TotalExcluded;
  together.TotalBlocked = alone.TotalBlocked;
  together.NonDelaunayAfter = alone.NonDelaunayAfter;
  together.BlockedByShape = alone.BlockedByShape;
  together.BlockedByDeviation = alone.BlockedByDeviation;
  together.BlockedByEdge = alone.BlockedByEdge;
  together.MinimumAngleAfter = alone.MinimumAngleAfter;
  together.TrianglesBelow10After = alone.TrianglesBelow10After;
  together.TrianglesBelow20After = alone.TrianglesBelow20After;
  together.TrianglesBelow30After = alone.TrianglesBelow30After;
  together.StopReason = alone.StopReason;
  together.Defects = alone.Defects; // their ids are those of a rank
  if (alone.InsertedConstraints > 0) // by flips, in some order
  {
    together.NonDelaunayBefore = alone.NonDelaunayBefore;
    together.MinimumAngleBefore = alone.MinimumAngleBefore;
    together.TrianglesBelow10Before = alone.TrianglesBelow10Before;
    together.TrianglesBelow20Before = alone.TrianglesBelow20Before;
    together.TrianglesBelow30Before = alone.TrianglesBelow30Before;
  }
  ExpectSameStatistics(alone, together);
}

void ExpectAsAlone(
  const TriangleMesh& mesh, const FlipOptions& options, const PartsResult& together)
{
  const FlipResult alone = Flip(mesh, options);
  const PiecesReport& report = together.Report;
  EXPECT_EQ(ToTriangleSet(alone.Triangles), ToTriangleSet(together.Triangles));
  ExpectSameCounts(alone.Report, report);
  ExpectConsistentStatistics(report);
  EXPECT_EQ(alone.Report.NonDelaunayAfter, report.NonDelaunayAfter);
  EXPECT_NEAR(alone.Report.MinimumAngleAfter, report.MinimumAngleAfter, 1e-9);
  EXPECT_EQ(StopReasonKind::Converged, report.StopReason);
}

void ExpectNothingLeft(const TriangleMesh& mesh, FlipOptions options, const PartsResult& together)
{
  const std::vector<std::int64_t> fixed = FindFixedEdges(mesh, options);
  TriangleMesh after;
  after.Points = mesh.Points;
  after.Triangles = ViewTriangles(together.Triangles);
  options.FeatureAngle = 180.0;
  options.Geometry = together.Report.GeometryUsed; // flips may change what Auto chooses
  const FlipReport again = Flip(WithConstraints(after, fixed), options).Report;
  EXPECT_EQ(0, again.UnmatchedConstraints);
  EXPECT_EQ(0, again.TotalFlips);
  EXPECT_EQ(again.NonDelaunayAfter, together.Report.NonDelaunayAfter);
  EXPECT_EQ(again.BlockedByShape, together.Report.BlockedByShape);
  EXPECT_EQ(again.BlockedByDeviation, together.Report.BlockedByDeviation);
  EXPECT_EQ(again.BlockedByEdge, together.Report.BlockedByEdge);
  if (!std::isnan(again.MinimumAngleAfter))
  {
    EXPECT_NEAR(again.MinimumAngleAfter, together.Report.MinimumAngleAfter, 1e-9);
  }
  EXPECT_EQ(again.TrianglesBelow10After, together.Report.TrianglesBelow10After);
  EXPECT_EQ(again.TrianglesBelow20After, together.Report.TrianglesBelow20After);
  EXPECT_EQ(again.TrianglesBelow30After, together.Report.TrianglesBelow30After);
}

void ExpectGood(const TriangleMesh& mesh, const FlipOptions& options, const PartsResult& together)
{
  ExpectSameCounts(Flip(mesh, options).Report, together.Report);
  ExpectConsistentStatistics(together.Report);
  EXPECT_EQ(StopReasonKind::Converged, together.Report.StopReason);
  ExpectSameTopology(mesh.Triangles, together.Triangles, together.Report);
  ExpectNothingLeft(mesh, options, together);
}

}
