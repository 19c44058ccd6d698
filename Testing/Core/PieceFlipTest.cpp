// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "GeneratedMeshes.h"
#include "PieceTestSupport.h"
#include "Records.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

/// @file
/// Divided meshes become those that one rank makes.

namespace delaunayflip
{
namespace
{

TEST_P(RanksTest, RandomMeshCutBySpace)
{
  const OwnedMesh<float> mesh = MakeRandomBadMesh(6000 / Reduction, 5);
  ExpectSameTriangles(
    mesh.View(), DivideBySpace(mesh.View(), GetParam()), GetParam(), MakeCanonical());
}

TEST_P(RanksTest, RandomMeshScattered)
{
  const OwnedMesh<double> mesh = MakeRandomBadMeshDouble(1000 / Reduction, 6);
  ExpectSameTriangles(
    mesh.View(), DivideAtRandom(mesh.View(), GetParam(), 7), GetParam(), MakeCanonical());
}

TEST_P(RanksTest, PointsWithoutNumbers)
{
  const OwnedMesh<double> mesh = MakeRandomBadMeshDouble(2000 / Reduction, 8);
  ExpectSameTriangles(
    mesh.View(), DivideBySpace(mesh.View(), GetParam()), GetParam(), MakeCanonical(), false);
}

TEST_P(RanksTest, Ties)
{
  const OwnedMesh<double> mesh = MakeGridMesh(30, 20);
  ExpectSameTriangles(
    mesh.View(), DivideBySpace(mesh.View(), GetParam()), GetParam(), MakeCanonical());
}

TEST_P(RanksTest, TiltedPlane)
{
  const AffineMap map = { { { 1, 0, 0, 0 }, { 0, 1, 0, 0 }, { 2, -3, 0, 0 } } };
  const OwnedMesh<double> mesh = Transform(MakeRandomBadMeshDouble(2000 / Reduction, 9), map);
  FlipOptions options = MakeCanonical();
  options.Geometry = GeometryKind::Planar;
  ExpectSameTriangles(mesh.View(), DivideBySpace(mesh.View(), GetParam()), GetParam(), options);
}

TEST_P(RanksTest, WorstCase)
{
  const OwnedMesh<double> mesh = MakeWorstCaseMesh(40);
  ExpectSameTriangles(
    mesh.View(), DivideBySpace(mesh.View(), GetParam()), GetParam(), MakeCanonical());
}

TEST_P(RanksTest, ClockwiseTriangles)
{
  OwnedMesh<double> mesh = MakeRandomBadMeshDouble(500, 10);
  ReverseTriangles(mesh.Triangles);
  ExpectSameTriangles(
    mesh.View(), DivideBySpace(mesh.View(), GetParam()), GetParam(), MakeCanonical());
}

TEST_P(RanksTest, Sphere)
{
  const OwnedMesh<double> mesh = MakeBadSphere(60, 30, 11);
  const FlipOptions options = MakeOnSurface();
  ExpectGoodTriangles(mesh.View(), DivideBySpace(mesh.View(), GetParam()), GetParam(), options);
}

TEST_P(RanksTest, SphereScattered)
{
  const OwnedMesh<double> mesh = MakeBadSphere(24, 12, 12);
  const FlipOptions options = MakeOnSurface();
  ExpectGoodTriangles(
    mesh.View(), DivideAtRandom(mesh.View(), GetParam(), 13), GetParam(), options);
}

TEST_P(RanksTest, SurfaceOfPointsWithFewTriangles)
{
  OwnedMesh<double> mesh = MakeRandomBadMeshDouble(400, 19);
  for (std::size_t i = 0; i < mesh.Points.size(); i += 3)
  {
    mesh.Points[i + 2] = 0.3 * std::sin(9 * mesh.Points[i]) * std::cos(7 * mesh.Points[i + 1]);
  }
  const FlipOptions options = MakeOnSurface();
  ExpectGoodTriangles(mesh.View(), DivideBySpace(mesh.View(), GetParam()), GetParam(), options);
}

TEST_P(RanksTest, MoebiusStrip)
{
  const OwnedMesh<double> mesh = MakeMoebiusStrip(60, 6, 14);
  const FlipOptions options = MakeOnSurface();
  ExpectGoodTriangles(mesh.View(), DivideBySpace(mesh.View(), GetParam()), GetParam(), options);
}

TEST_P(RanksTest, RepeatedTriangles)
{
  const OwnedMesh<double> mesh = RepeatTriangles(MakeBadSphere(30, 15, 15));
  const FlipOptions options = MakeOnSurface();
  ExpectGoodTriangles(
    mesh.View(), DivideAtRandom(mesh.View(), GetParam(), 16), GetParam(), options);
}

TEST_P(RanksTest, RepeatedTrianglesInAPlane)
{
  const OwnedMesh<double> mesh = RepeatTriangles(MakeRandomBadMeshDouble(400, 17));
  FlipOptions options = MakeCanonical();
  options.TieRule = TieRuleKind::Keep;
  ExpectGoodTriangles(
    mesh.View(), DivideAtRandom(mesh.View(), GetParam(), 18), GetParam(), options);
}

/// Each sheet on ranks of its own, so that points inside of it have triangles all around them
/// there.
TEST_P(RanksTest, TwoSheetsOverTheSamePoints)
{
  OwnedMesh<double> mesh = MakeRandomBadMeshDouble(80, 5);
  const std::int64_t first = mesh.NumberOfTriangles();
  FlipOptions few = MakeCanonical();
  few.MaximumIterations = 2;
  const std::vector<std::int32_t> other = Flip(mesh.View(), few).Triangles;
  mesh.Triangles.insert(mesh.Triangles.end(), other.begin(), other.end());
  Owners owners = this->Cut(mesh.View());
  for (std::int64_t t = 0; t < mesh.NumberOfTriangles(); ++t)
  {
    const int half = (GetParam() + 1) / 2;
    owners[t] = t < first ? owners[t] % half : GetParam() - 1 - owners[t] % half;
  }
  ExpectGoodTriangles(mesh.View(), owners, GetParam(), MakeCanonical());
}

/// Seen from above. Both ranks of a seam must still find the same halves of its edges.
TEST_P(RanksTest, RanksMayDisagreeAboutHeights)
{
  const OwnedMesh<double> mesh = MakeRandomBadMeshDouble(500, 17);
  std::vector<OwnedPiece> pieces = Divide(mesh.View(), this->Cut(mesh.View()), GetParam());
  for (std::size_t rank = 0; rank < pieces.size(); ++rank)
  {
    for (std::size_t i = 0; i < pieces[rank].PointOf.size(); ++i)
    {
      const auto height = ScatterBits(pieces[rank].PointOf[i] + 1000 * rank) % 1000;
      pieces[rank].Doubles[3 * i + 2] = static_cast<double>(height);
    }
  }
  FlipOptions options = MakeCanonical();
  options.Geometry = GeometryKind::PlanarXY;
  const std::vector<PiecesReport> reports = FlipDivided(mesh.View(), pieces, options).Reports;
  EXPECT_EQ(StopReasonKind::Converged, reports.front().StopReason);
  EXPECT_EQ(Flip(mesh.View(), options).Report.NonDelaunayBefore, reports.front().NonDelaunayBefore);
  EXPECT_EQ(0, reports.front().NonDelaunayAfter);
}

/// Those after other iterations are not known.
TEST_P(RanksTest, SmallestAngleBeforeAndAfter)
{
  for (const OwnedMesh<double>& mesh :
    { MakeRandomBadMeshDouble(500, 17), MakeBadSphere(20, 10, 3) })
  {
    FlipOptions options = MakeCanonical();
    options.TieRule = TieRuleKind::Keep;
    options.TrackQuality = true;
    const PiecesReport report =
      FlipDivided(mesh.View(), Divide(mesh.View(), this->Cut(mesh.View()), GetParam()), options)
        .Reports.front();
    EXPECT_EQ(Flip(mesh.View(), options).Report.MinimumAngleBefore, report.MinimumAngleBefore);
    EXPECT_LE(report.MinimumAngleBefore, report.MinimumAngleAfter);
    ASSERT_LT(1u, report.Iterations.size());
    for (const IterationRecord& row : report.Iterations)
    {
      const bool isLast = &row == &report.Iterations.back();
      EXPECT_EQ(!isLast, std::isnan(row.MinimumAngle)) << row.Iteration;
    }
    EXPECT_EQ(report.MinimumAngleAfter, report.Iterations.back().MinimumAngle);
  }
}

/// What ranks do at the same time is one iteration.
TEST_P(RanksTest, IterationsAreLimitedOverAllRounds)
{
  for (const bool isPlanar : { true, false })
  {
    const OwnedMesh<double> mesh =
      isPlanar ? MakeRandomBadMeshDouble(300, 17) : MakeBadSphere(20, 10, 3);
    const std::vector<OwnedPiece> pieces =
      Divide(mesh.View(), this->Scatter(mesh.View()), GetParam());
    FlipOptions options = isPlanar ? MakeCanonical() : MakeOnSurface();
    const auto all = static_cast<std::int64_t>(
      FlipDivided(mesh.View(), pieces, options).Reports.front().Iterations.size());
    for (const std::int64_t most :
      { std::int64_t(0), std::int64_t(1), std::int64_t(2), all - 1, all })
    {
      options.MaximumIterations = most;
      const std::vector<PiecesReport> reports = FlipDivided(mesh.View(), pieces, options).Reports;
      ExpectSameOnAllRanks(reports);
      EXPECT_EQ(most, static_cast<std::int64_t>(reports.front().Iterations.size()));
      EXPECT_EQ(most < all ? StopReasonKind::IterationLimit : StopReasonKind::Converged,
        reports.front().StopReason)
        << most << " of " << all;
    }
  }
}

/// The error that all ranks give if the last one has other options.
std::string FindDifference(
  int ranks, const FlipOptions& options, const FlipOptions& different, bool areSettings = false)
{
  const OwnedMesh<double> mesh = MakeRandomBadMeshDouble(50, 17);
  const std::vector<OwnedPiece> pieces =
    Divide(mesh.View(), DivideBySpace(mesh.View(), ranks), ranks);
  std::vector<std::string> errors(ranks);
  RunInThreads(ranks,
    [&](PieceGroup& group)
    {
      const int rank = group.GetRank();
      const bool isLast = rank + 1 == ranks;
      FlippedPiece flipped;
      try
      {
        RequireSameOptions(
          FlipOptions(), group, { { "Name", areSettings && isLast ? "b" : "a" }, { "Other", "" } });
        FlipPiece(pieces[rank].View(true), isLast ? different : options, group, flipped);
      }
      catch (const InvalidOptions& error)
      {
        errors[rank] = error.what();
      }
    });
  EXPECT_EQ(ranks, std::count(errors.begin(), errors.end(), errors.front()));
  return errors.front();
}

TEST_P(RanksTest, OptionsThatDifferAreAnError)
{
  if (GetParam() == 1)
  {
    return;
  }
  const std::string end = std::to_string(GetParam() - 1) + "; set it to the same on all ranks";
  const FlipOptions options = MakeCanonical();
  const auto expect = [&](const FlipOptions& different, const std::string& text)
  { EXPECT_EQ("rank 0: " + text + end, FindDifference(GetParam(), options, different)); };
  FlipOptions different = options;
  different.Geometry = GeometryKind::Surface;
  different.Tolerance = 0.5; // the first difference counts
  expect(different, "Geometry is 'auto' on rank 0, but 'surface' on rank ");
  different.Geometry = options.Geometry;
  expect(different, "Tolerance is '-1' on rank 0, but '0.5' on rank ");
  different = options;
  different.Criterion = CriterionKind::OppositeAngles;
  expect(different, "Criterion is 'in-circle' on rank 0, but 'opposite-angles' on rank ");
  different = options;
  different.TieRule = TieRuleKind::Keep;
  expect(different, "TieRule is 'canonical' on rank 0, but 'keep' on rank ");
  different = options;
  different.FeatureAngle = 0.1;
  expect(different, "FeatureAngle is '30' on rank 0, but '0.1' on rank ");
  different = options;
  different.MaximumIterations = 7;
  expect(different, "MaximumIterations is '-1' on rank 0, but '7' on rank ");
  different = options;
  different.TrackQuality = true;
  expect(different, "TrackQuality is 'off' on rank 0, but 'on' on rank ");
  EXPECT_EQ("Name is 'a' on rank 0, but 'b' on rank " + end,
    FindDifference(GetParam(), options, options, true));
}

TEST_P(RanksTest, HardwareMayDiffer)
{
  FlipOptions different = MakeCanonical();
  different.NumberOfThreads = 2;
  different.NumberOfPieces = 3;
  different.Backend = BackendKind::Threads;
  EXPECT_EQ("", FindDifference(GetParam(), MakeCanonical(), different));
}

INSTANTIATE_TEST_SUITE_P(Pieces, RanksTest, testing::Values(1, 2, 3, 4, 7, 16), NameRanks);

}
}
