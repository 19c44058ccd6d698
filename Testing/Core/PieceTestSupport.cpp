// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PieceTestSupport.h"

#include "MeshAudit.h"

#include <gtest/gtest.h>

namespace delaunayflip
{

namespace
{
std::int64_t SumFlips(const std::vector<std::int32_t>& counts)
{
  std::int64_t sum = 0;
  for (const std::int32_t count : counts)
  {
    sum += count;
  }
  return sum;
}

/// Flips what a run has made on one rank, with the edges that were fixed in it.
void ExpectNothingLeft(const TriangleMesh& mesh, const GroupResult& result, FlipOptions options,
  const std::vector<std::int64_t>& fixed)
{
  TriangleMesh after;
  after.Points = mesh.Points;
  after.Triangles = result.View();
  after.ConstraintEdges = fixed.data();
  after.NumberOfConstraintEdges = static_cast<std::int64_t>(fixed.size()) / 2;
  options.FeatureAngle = 180.0;
  const FlipResult again = Flip(after, options);
  const PiecesReport& report = result.Reports.front();
  EXPECT_EQ(0, again.Report.UnmatchedConstraints);
  EXPECT_EQ(0, again.Report.TotalFlips);
  EXPECT_EQ(again.Report.NonDelaunayAfter, report.NonDelaunayAfter);
  EXPECT_EQ(again.Report.BlockedByShape, report.BlockedByShape);
  EXPECT_EQ(again.Report.BlockedByEdge, report.BlockedByEdge);
}
}

FlipOptions MakeCanonical()
{
  FlipOptions options;
  options.TieRule = TieRuleKind::Canonical;
  options.Backend = BackendKind::Threads;
  options.NumberOfThreads = 1;
  return options;
}

FlipOptions MakeInPieces(int pieces)
{
  FlipOptions options = MakeCanonical();
  options.NumberOfPieces = pieces;
  return options;
}

FlipOptions MakeOnSurface(double featureAngle)
{
  FlipOptions options;
  options.Geometry = GeometryKind::Surface;
  options.FeatureAngle = featureAngle;
  options.Backend = BackendKind::Threads;
  options.NumberOfThreads = 1;
  return options;
}

std::vector<std::int64_t> ChooseEdges(const TriangleMesh& mesh)
{
  std::vector<std::int64_t> edges;
  for (std::int64_t t = 0; t < mesh.Triangles.Count; t += 3)
  {
    edges.push_back(mesh.Triangles.Get(t, 0));
    edges.push_back(mesh.Triangles.Get(t, 1));
  }
  return edges;
}

void ExpectSameCounts(const FlipReport& alone, const PiecesReport& together)
{
  EXPECT_EQ(alone.Points, together.Points);
  EXPECT_EQ(alone.Triangles, together.Triangles);
  EXPECT_EQ(alone.EulerCharacteristic, together.EulerCharacteristic);
  EXPECT_EQ(alone.Edges.Edges, together.Edges.Edges);
  EXPECT_EQ(alone.Edges.Boundary, together.Edges.Boundary);
  EXPECT_EQ(alone.Edges.NonManifold, together.Edges.NonManifold);
  EXPECT_EQ(alone.Edges.WronglyWound, together.Edges.WronglyWound);
  EXPECT_EQ(alone.Edges.Feature, together.Edges.Feature);
  EXPECT_EQ(alone.Edges.Constraint, together.Edges.Constraint);
  EXPECT_EQ(alone.Edges.Region, together.Edges.Region);
  EXPECT_EQ(alone.Edges.Fixed, together.Edges.Fixed);
  EXPECT_EQ(alone.UnmatchedConstraints, together.UnmatchedConstraints);
  EXPECT_EQ(alone.NonDelaunayBefore, together.NonDelaunayBefore);
  EXPECT_EQ(alone.MinimumAngleBefore, together.MinimumAngleBefore);
  EXPECT_EQ(alone.GeometryUsed, together.GeometryUsed);
  EXPECT_EQ(alone.GeometryReason, together.GeometryReason);
  EXPECT_EQ(alone.Tolerance, together.Tolerance);
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

GroupResult ExpectSameTriangles(const TriangleMesh& mesh, const Owners& owners, int ranks,
  const FlipOptions& options, bool withNumbers)
{
  const FlipResult alone = Flip(mesh, options);
  const GroupResult together = FlipDivided(mesh, Divide(mesh, owners, ranks), options, withNumbers);
  EXPECT_EQ(ToTriangleSet(alone.Triangles), ToTriangleSet(together.View()));
  ExpectSameOnAllRanks(together.Reports);
  const PiecesReport& report = together.Reports.front();
  ExpectSameCounts(alone.Report, report);
  ExpectConsistentStatistics(report);
  EXPECT_EQ(alone.Report.NonDelaunayAfter, report.NonDelaunayAfter);
  EXPECT_NEAR(alone.Report.MinimumAngleAfter, report.MinimumAngleAfter, 1e-9);
  EXPECT_EQ(StopReasonKind::Converged, report.StopReason);
  EXPECT_EQ(2 * report.TotalFlips, SumFlips(together.FlipCounts));
  return together;
}

GroupResult ExpectGoodTriangles(const TriangleMesh& mesh, const Owners& owners, int ranks,
  const FlipOptions& options, const std::vector<std::int64_t>& fixed)
{
  const FlipResult alone = Flip(mesh, options);
  const std::vector<OwnedPiece> pieces = Divide(mesh, owners, ranks);
  const GroupResult together = FlipDivided(mesh, pieces, options);
  ExpectSameOnAllRanks(together.Reports);
  const PiecesReport& report = together.Reports.front();
  ExpectSameCounts(alone.Report, report);
  EXPECT_EQ(StopReasonKind::Converged, report.StopReason);
  EXPECT_EQ(0, CountDuplicateEdgesGained(mesh.Triangles, together.View()));
  EXPECT_EQ(EulerCharacteristic(mesh.Triangles), EulerCharacteristic(together.View()));
  ExpectNothingLeft(mesh, together, options, fixed);
  EXPECT_EQ(
    ToTriangleSet(FlipDivided(mesh, pieces, options).View()), ToTriangleSet(together.View()));
  return together;
}

}
