// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "DelaunayFlip.h"
#include "GeneratedMeshes.h"
#include "InputChecks.h"
#include "MeshAudit.h"
#include "PieceTestSupport.h"
#include "RandomMess.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

/// @file
/// FlipInPieces: meshes of one process that are flipped in pieces.

namespace delaunayflip
{
namespace
{

struct PiecesResult
{
  std::vector<std::int32_t> Triangles;
  PiecesReport Report;
};

std::vector<std::int32_t> CopyTriangles(const TriangleMesh& mesh)
{
  std::vector<std::int32_t> triangles;
  for (std::int64_t i = 0; i < 3 * mesh.Triangles.Count; ++i)
  {
    triangles.push_back(
      static_cast<std::int32_t>(mesh.Triangles.Get(i / 3, static_cast<int>(i % 3))));
  }
  return triangles;
}

/// In the array of the mesh.
PiecesResult FlipHere(
  const TriangleMesh& mesh, int pieces, FlipOptions options, const ProgressObserver& progress = {})
{
  options.NumberOfPieces = pieces;
  PiecesResult result{ CopyTriangles(mesh), {} };
  const TriangleMesh given = WithTriangles(mesh, result.Triangles);
  result.Report = FlipInPieces(
    given, options, MutableTriangleArray(result.Triangles.data(), mesh.Triangles.Count), progress);
  return result;
}

/// The parameter is the number of pieces.
class FlipInPiecesTest : public testing::TestWithParam<int>
{
protected:
  /// For meshes whose result is unique.
  PiecesResult ExpectSameAsAlone(const TriangleMesh& mesh, const FlipOptions& options) const
  {
    const FlipResult alone = Flip(mesh, options);
    PiecesResult result = FlipHere(mesh, GetParam(), options);
    EXPECT_EQ(ToTriangleSet(alone.Triangles), ToTriangleSet(result.Triangles));
    ExpectSameCounts(alone.Report, result.Report);
    ExpectConsistentStatistics(result.Report);
    EXPECT_EQ(alone.Report.NonDelaunayAfter, result.Report.NonDelaunayAfter);
    EXPECT_NEAR(alone.Report.MinimumAngleAfter, result.Report.MinimumAngleAfter, 1e-9);
    EXPECT_EQ(StopReasonKind::Converged, result.Report.StopReason);
    return result;
  }

  /// Expects that no edge is left that may flip, with the edges fixed that are fixed in the input.
  void ExpectNothingLeft(
    const TriangleMesh& mesh, FlipOptions options, const PiecesResult& result) const
  {
    const std::vector<std::int64_t> fixed = FindFixedEdges(mesh, options);
    TriangleMesh after;
    after.Points = mesh.Points;
    after.Triangles = ViewTriangles(result.Triangles);
    after.ConstraintEdges = fixed.data();
    after.NumberOfConstraintEdges = static_cast<std::int64_t>(fixed.size()) / 2;
    options.FeatureAngle = 180.0;
    options.Geometry = result.Report.GeometryUsed; // flips may change what Auto chooses
    const FlipReport again = Flip(after, options).Report;
    EXPECT_EQ(0, again.UnmatchedConstraints);
    EXPECT_EQ(0, again.TotalFlips);
    EXPECT_EQ(again.NonDelaunayAfter, result.Report.NonDelaunayAfter);
    EXPECT_EQ(again.BlockedByShape, result.Report.BlockedByShape);
    EXPECT_EQ(again.BlockedByEdge, result.Report.BlockedByEdge);
  }

  /// For other meshes: nothing is broken, no edge is left that may flip, and a second run gives the
  /// same triangles.
  PiecesResult ExpectGood(const TriangleMesh& mesh, const FlipOptions& options) const
  {
    const FlipResult alone = Flip(mesh, options);
    PiecesResult result = FlipHere(mesh, GetParam(), options);
    ExpectSameCounts(alone.Report, result.Report);
    ExpectConsistentStatistics(result.Report);
    const TriangleArray after = ViewTriangles(result.Triangles);
    EXPECT_EQ(StopReasonKind::Converged, result.Report.StopReason);
    EXPECT_EQ(0, CountDuplicateEdgesGained(mesh.Triangles, after));
    EXPECT_EQ(EulerCharacteristic(mesh.Triangles), EulerCharacteristic(after));
    this->ExpectNothingLeft(mesh, options, result);
    EXPECT_EQ(result.Triangles, FlipHere(mesh, GetParam(), options).Triangles);
    return result;
  }
};

TEST_P(FlipInPiecesTest, RandomMesh)
{
  const OwnedMesh<float> mesh = MakeRandomBadMesh(6000 / Reduction, 41);
  const PiecesResult result = this->ExpectSameAsAlone(mesh.View(), MakeCanonical());
  EXPECT_EQ(GetParam() > 1, result.Report.Rounds > 1);
  EXPECT_EQ(GetParam() > 1, result.Report.SeamEdges > 0);
}

TEST_P(FlipInPiecesTest, Ties)
{
  this->ExpectSameAsAlone(MakeGridMesh(30, 20).View(), MakeCanonical());
}

TEST_P(FlipInPiecesTest, WorstCase)
{
  this->ExpectSameAsAlone(MakeWorstCaseMesh(40).View(), MakeCanonical());
}

TEST_P(FlipInPiecesTest, TiltedPlaneAndClockwiseTriangles)
{
  const AffineMap map = { { { 1, 0, 0, 0 }, { 0, 1, 0, 0 }, { 2, -3, 0, 0 } } };
  OwnedMesh<double> mesh = Transform(MakeRandomBadMeshDouble(2000 / Reduction, 42), map);
  ReverseTriangles(mesh.Triangles);
  this->ExpectSameAsAlone(mesh.View(), MakeCanonical());
}

/// Higher than wide, and so cut along x and y only.
TEST_P(FlipInPiecesTest, Terrain)
{
  OwnedMesh<double> mesh = MakeRandomBadMeshDouble(1000, 43);
  for (std::size_t i = 0; i < mesh.Points.size(); i += 3)
  {
    mesh.Points[i + 2] = 100.0 * std::sin(9 * mesh.Points[i]) * std::cos(7 * mesh.Points[i + 1]);
  }
  const PiecesResult result = this->ExpectSameAsAlone(mesh.View(), MakeCanonical());
  EXPECT_EQ(GeometryKind::PlanarXY, result.Report.GeometryUsed);
}

TEST_P(FlipInPiecesTest, SurfaceWithFeatures)
{
  const OwnedMesh<double> mesh = MakeBadSphere(40, 20, 44);
  const PiecesResult result = this->ExpectGood(mesh.View(), MakeOnSurface(20.0));
  EXPECT_LT(0, result.Report.Edges.Feature);
  this->ExpectGood(mesh.View(), MakeOnSurface());
}

/// So few triangles that most points are at seams.
TEST_P(FlipInPiecesTest, SmallSurface)
{
  for (std::uint32_t seed = 0; seed < 20; ++seed)
  {
    this->ExpectGood(MakeBadSphere(6, 4, seed).View(), MakeOnSurface());
  }
}

TEST_P(FlipInPiecesTest, MoebiusStrip)
{
  this->ExpectGood(MakeMoebiusStrip(60, 6, 45).View(), MakeOnSurface());
}

TEST_P(FlipInPiecesTest, RepeatedTriangles)
{
  this->ExpectGood(RepeatTriangles(MakeBadSphere(30, 15, 46)).View(), MakeOnSurface());
  FlipOptions options = MakeCanonical();
  options.TieRule = TieRuleKind::Keep;
  this->ExpectGood(RepeatTriangles(MakeRandomBadMeshDouble(400, 47)).View(), options);
}

/// Sheets that meet in one edge after the other, and so across seams.
TEST_P(FlipInPiecesTest, ThreeSheets)
{
  const OwnedMesh<double> sheet = MakeRandomBadMeshDouble(150, 48);
  OwnedMesh<double> mesh = sheet;
  const auto points = static_cast<std::int32_t>(sheet.NumberOfPoints());
  for (int copy = 1; copy < 3; ++copy)
  {
    for (std::size_t i = 0; i < sheet.Points.size(); i += 3)
    {
      mesh.Points.insert(mesh.Points.end(), { sheet.Points[i], sheet.Points[i + 1], 0.001 * copy });
    }
    for (const std::int32_t id : sheet.Triangles)
    {
      // Points with even ids belong to all sheets.
      mesh.Triangles.push_back(id % 2 == 0 ? id : id + copy * points);
    }
  }
  const PiecesResult result = this->ExpectGood(mesh.View(), MakeOnSurface());
  EXPECT_LT(0, result.Report.Edges.NonManifold);
}

/// Three pages around a spine.
OwnedMesh<double> MakePages(int length, int width)
{
  const double directions[3][2] = { { -1.0, 0.0 }, { 1.0, 0.3 }, { 1.0, -0.3 } };
  OwnedMesh<double> mesh;
  for (int i = 0; i <= length; ++i)
  {
    mesh.Points.insert(mesh.Points.end(), { 0.0, 1.0 * i, 0.0 });
  }
  for (int page = 0; page < 3; ++page)
  {
    const auto first = static_cast<std::int32_t>(mesh.NumberOfPoints());
    const auto find = [=](int i, int j) { return j == 0 ? i : first + (j - 1) * (length + 1) + i; };
    for (int i = 0; i < width * (length + 1); ++i)
    {
      const int j = i / (length + 1) + 1;
      const double away = 0.2 * j * j; // the first row is narrow
      mesh.Points.insert(mesh.Points.end(),
        { away * directions[page][0], i % (length + 1) + 0.5, away * directions[page][1] });
    }
    for (int i = 0; i < width * length; ++i)
    {
      const std::int32_t a = find(i % length, i / length), b = find(i % length + 1, i / length);
      const std::int32_t d = find(i % length, i / length + 1), c = d + 1;
      const bool isTurned = page == 2;
      mesh.Triangles.insert(mesh.Triangles.end(), { a, isTurned ? d : b, isTurned ? b : d });
      mesh.Triangles.insert(mesh.Triangles.end(), { b, isTurned ? d : c, isTurned ? c : d });
    }
  }
  return mesh;
}

/// Of three pieces one has the first page. In those of the others, edges of the spine have two
/// triangles and look like any edge that is bad.
TEST_P(FlipInPiecesTest, ThreePages)
{
  const PiecesResult result = this->ExpectGood(MakePages(12, 8).View(), MakeOnSurface());
  EXPECT_EQ(12, result.Report.Edges.NonManifold);
}

TEST_P(FlipInPiecesTest, AnyMess)
{
  for (std::uint32_t seed = 0; seed < 100 / Reduction; ++seed)
  {
    RandomMess mess = MakeRandomMess(seed);
    mess.Options.Backend = BackendKind::Threads;
    mess.Options.TieRule = TieRuleKind::Keep;
    mess.Options.MaximumIterations = -1;
    SCOPED_TRACE(seed);
    const TriangleMesh mesh = mess.View();
    const PiecesResult result = FlipHere(mesh, GetParam(), mess.Options);
    const FlipResult alone = Flip(mesh, mess.Options);
    if (!std::isnan(alone.Report.MinimumAngleBefore)) // it has triangles with finite points
    {
      ExpectSameCounts(alone.Report, result.Report);
    }
    const TriangleArray after = ViewTriangles(result.Triangles);
    EXPECT_EQ(0, CountDuplicateEdgesGained(mesh.Triangles, after));
    EXPECT_EQ(EulerCharacteristic(mesh.Triangles), EulerCharacteristic(after));
    EXPECT_EQ(result.Triangles, FlipHere(mesh, GetParam(), mess.Options).Triangles);
    if (result.Report.Converged())
    {
      this->ExpectNothingLeft(mesh, mess.Options, result);
    }
  }
}

TEST_P(FlipInPiecesTest, NumbersOfThreadsDoNotMatter)
{
  const OwnedMesh<double> mesh = MakeBadSphere(60, 30, 49);
  FlipOptions options = MakeOnSurface(30.0);
  const PiecesResult one = FlipHere(mesh.View(), GetParam(), options);
  options.NumberOfThreads = 4;
  const PiecesResult four = FlipHere(mesh.View(), GetParam(), options);
  EXPECT_EQ(one.Triangles, four.Triangles);
  ExpectSameStatistics(one.Report, four.Report);
}

TEST_P(FlipInPiecesTest, AnotherArrayOfLongIds)
{
  const OwnedMesh<float> mesh = MakeRandomBadMesh(500, 50);
  std::vector<std::int64_t> output(mesh.Triangles.size());
  FlipInPieces(mesh.View(), MakeInPieces(GetParam()),
    MutableTriangleArray(output.data(), mesh.NumberOfTriangles()));
  const std::vector<std::int32_t> expected =
    FlipHere(mesh.View(), GetParam(), MakeCanonical()).Triangles;
  EXPECT_TRUE(std::equal(output.begin(), output.end(), expected.begin(), expected.end()));
}

TEST_P(FlipInPiecesTest, IterationLimit)
{
  const OwnedMesh<double> mesh = MakeRandomBadMeshDouble(1000, 51);
  FlipOptions options = MakeCanonical();
  for (const std::int64_t limit : { 0, 1, 6 })
  {
    options.MaximumIterations = limit;
    const PiecesResult result = FlipHere(mesh.View(), GetParam(), options);
    EXPECT_EQ(StopReasonKind::IterationLimit, result.Report.StopReason);
    EXPECT_EQ(limit, static_cast<std::int64_t>(result.Report.Iterations.size()));
    TriangleMesh after = mesh.View();
    after.Triangles = ViewTriangles(result.Triangles);
    EXPECT_EQ(CountNonDelaunayEdges(after, options), result.Report.NonDelaunayAfter);
  }
}

/// The smallest angle after the last iteration is that of the whole mesh; it is not known after the
/// others.
TEST_P(FlipInPiecesTest, SmallestAngleAfterTheLastIteration)
{
  const OwnedMesh<double> mesh = MakeRandomBadMeshDouble(500, 52);
  FlipOptions options = MakeCanonical();
  options.TrackQuality = true;
  const PiecesReport report = FlipHere(mesh.View(), GetParam(), options).Report;
  const auto count = static_cast<std::int64_t>(report.Iterations.size());
  for (const std::int64_t limit : { std::int64_t(1), std::int64_t(3), count })
  {
    options.MaximumIterations = limit;
    const PiecesResult part = FlipHere(mesh.View(), GetParam(), options);
    TriangleMesh after = mesh.View();
    after.Triangles = ViewTriangles(part.Triangles);
    const double angle = MinimumAngle(after, GeometryKind::Planar);
    EXPECT_NEAR(angle, part.Report.Iterations.back().MinimumAngle, 1e-9);
    EXPECT_EQ(limit < count, std::isnan(report.Iterations[limit - 1].MinimumAngle));
    EXPECT_NEAR(angle, part.Report.MinimumAngleAfter, 1e-9);
  }
}

TEST_P(FlipInPiecesTest, Defects)
{
  OwnedMesh<double> mesh = MakeRandomBadMeshDouble(500, 53);
  mesh.Points[3 * 100] = std::numeric_limits<double>::quiet_NaN();
  mesh.Triangles.insert(mesh.Triangles.end(), { 3, 3, 4 });
  FlipOptions options = MakeCanonical();
  options.Geometry = GeometryKind::PlanarXY;
  options.TieRule = TieRuleKind::Keep;
  TriangleMesh given = mesh.View();
  const std::vector<std::int64_t> edges{ 1, 490, 2, 480 };
  given.ConstraintEdges = edges.data();
  given.NumberOfConstraintEdges = 2;
  const PiecesReport report = this->ExpectGood(given, options).Report;
  EXPECT_EQ(1, CountDefect(report, "NaN"));
  EXPECT_EQ(1, CountDefect(report, "repeated"));
  EXPECT_EQ(Flip(given, options).Report.UnmatchedConstraints, report.UnmatchedConstraints);
}

TEST_P(FlipInPiecesTest, MeshesWithFewTriangles)
{
  const OwnedMesh<double> none;
  EXPECT_EQ(StopReasonKind::Converged,
    FlipHere(none.View(), GetParam(), MakeCanonical()).Report.StopReason);
  this->ExpectSameAsAlone(MakeRandomBadMeshDouble(5, 54).View(), MakeCanonical());
}

TEST_P(FlipInPiecesTest, ErrorsChangeNothing)
{
  OwnedMesh<double> mesh = MakeRandomBadMeshDouble(100, 55);
  mesh.Triangles[100] = 77777;
  std::vector<std::int32_t> output(mesh.Triangles.size(), -5);
  const auto flip = [&](FlipOptions options)
  {
    options.NumberOfPieces = GetParam();
    FlipInPieces(
      mesh.View(), options, MutableTriangleArray(output.data(), mesh.NumberOfTriangles()));
  };
  EXPECT_THROW(flip(MakeCanonical()), InvalidMesh);
  mesh.Triangles[100] = 0;
  FlipOptions wrong = MakeOnSurface();
  wrong.TieRule = TieRuleKind::Canonical;
  EXPECT_THROW(flip(wrong), InvalidOptions);
  EXPECT_EQ(std::vector<std::int32_t>(output.size(), -5), output);
}

TEST_P(FlipInPiecesTest, TheCallerCanStopAtAnyTime)
{
  const OwnedMesh<double> mesh = MakeRandomBadMeshDouble(1000, 56);
  const std::vector<std::int32_t> all =
    FlipHere(mesh.View(), GetParam(), MakeCanonical()).Triangles;
  for (const double end : { 0.0, 0.3, 0.6, 0.95 })
  {
    double last = 0.0;
    const PiecesResult result = FlipHere(mesh.View(), GetParam(), MakeCanonical(),
      [&](double share)
      {
        EXPECT_LE(last, share);
        EXPECT_GE(1.0, share);
        last = share;
        return share < end;
      });
    EXPECT_TRUE(result.Report.StopReason == StopReasonKind::Aborted || all == result.Triangles);
    EXPECT_TRUE(end > 0.0 || mesh.Triangles == result.Triangles);
    EXPECT_EQ(EulerCharacteristic(mesh.View().Triangles),
      EulerCharacteristic(ViewTriangles(result.Triangles)));
  }
}

INSTANTIATE_TEST_SUITE_P(
  Pieces, FlipInPiecesTest, testing::Values(1, 2, 3, 7, 40), testing::PrintToStringParamName());

TEST(NumberOfPiecesTest, IsFrom1To255)
{
  const OwnedMesh<double> mesh = MakeRandomBadMeshDouble(20, 57);
  for (const int pieces : { -1, 256 })
  {
    EXPECT_THROW(FlipHere(mesh.View(), pieces, {}), InvalidOptions);
    EXPECT_THROW(FlipSession(mesh.View(), MakeInPieces(pieces)), InvalidOptions);
  }
  FlipHere(mesh.View(), 255, {});
}

TEST(NumberOfPiecesTest, IsTheSmallestThatIsPossibleByDefault)
{
  constexpr std::int64_t most = 715827882;
  EXPECT_EQ(1, CountPieces({}, 0));
  EXPECT_EQ(1, CountPieces({}, most));
  EXPECT_EQ(2, CountPieces({}, most + 1));
  EXPECT_EQ(3, CountPieces({}, 2 * most));
  EXPECT_EQ(7, CountPieces(MakeInPieces(7), 2 * most));
  EXPECT_EQ(1, CountPieces(MakeInPieces(1), 2 * most));
  EXPECT_THROW(CountPieces(MakeInPieces(2), 2 * most), MeshTooLarge);
}

}
}
