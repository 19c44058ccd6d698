// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "DelaunayFlip.h"
#include "GeneratedMeshes.h"
#include "MeshAudit.h"
#include "PieceTestSupport.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

/// @file
/// Divided meshes with edges that stay, uneven pieces, errors and aborts.

namespace delaunayflip
{
namespace
{

std::vector<std::int32_t> MakeStripes(const TriangleMesh& mesh)
{
  std::vector<std::int32_t> labels;
  for (std::int64_t t = 0; t < mesh.Triangles.Count; ++t)
  {
    labels.push_back(static_cast<std::int32_t>(5 * mesh.Points.Get(mesh.Triangles.Get(t, 0), 1)));
  }
  return labels;
}

/// @param flipped what the ranks' results overwrite.
std::vector<FlippedPiece> FlipInto(std::vector<FlippedPiece> flipped,
  const std::vector<OwnedPiece>& pieces, const FlipOptions& options)
{
  flipped.resize(pieces.size());
  RunInThreads(static_cast<int>(pieces.size()),
    [&](PieceGroup& group)
    {
      const int rank = group.GetRank();
      FlipPiece(pieces[rank].View(true), options, group, flipped[rank]);
    });
  return flipped;
}

void ExpectSameOrigins(
  const std::vector<PieceOrigin>& expected, const std::vector<PieceOrigin>& found)
{
  EXPECT_TRUE(std::equal(expected.begin(), expected.end(), found.begin(), found.end(),
    [](const PieceOrigin& a, const PieceOrigin& b) { return a.Rank == b.Rank && a.Id == b.Id; }));
}

void ExpectSamePieces(
  const std::vector<FlippedPiece>& expected, const std::vector<FlippedPiece>& found)
{
  for (std::size_t rank = 0; rank < expected.size(); ++rank)
  {
    EXPECT_EQ(expected[rank].Triangles, found[rank].Triangles);
    EXPECT_EQ(expected[rank].FlipCounts, found[rank].FlipCounts);
    EXPECT_EQ(expected[rank].GoneTriangles, found[rank].GoneTriangles);
    EXPECT_EQ(expected[rank].ReceivedCoordinates, found[rank].ReceivedCoordinates);
    ExpectSameOrigins(expected[rank].ReceivedTriangles, found[rank].ReceivedTriangles);
    ExpectSameOrigins(expected[rank].ReceivedPoints, found[rank].ReceivedPoints);
  }
}

class PieceEdgesTest : public RanksTest
{
};

TEST_P(PieceEdgesTest, Regions)
{
  const OwnedMesh<double> owned = MakeRandomBadMeshDouble(800, 24);
  const std::vector<std::int32_t> labels = MakeStripes(owned.View());
  TriangleMesh mesh = owned.View();
  mesh.Regions = labels.data();
  ExpectSameTriangles(mesh, this->Cut(mesh), GetParam(), MakeCanonical());
  ExpectSameTriangles(mesh, this->Scatter(mesh), GetParam(), MakeCanonical());
}

TEST_P(PieceEdgesTest, FrozenTriangles)
{
  const OwnedMesh<double> owned = MakeRandomBadMeshDouble(800, 25);
  std::vector<unsigned char> frozen(owned.NumberOfTriangles());
  for (std::size_t t = 0; t < frozen.size(); t += 7)
  {
    frozen[t] = 1;
  }
  TriangleMesh mesh = owned.View();
  mesh.FrozenTriangles = frozen.data();
  ExpectSameTriangles(mesh, this->Scatter(mesh), GetParam(), MakeCanonical());
}

TEST_P(PieceEdgesTest, FeatureEdges)
{
  const OwnedMesh<double> mesh = MakeBadSphere(30, 15, 26);
  const FlipOptions options = MakeOnSurface(20.0);
  FlipOptions alone = options;
  const std::vector<std::int64_t> fixed = FindFixedEdges(mesh.View(), alone);
  ASSERT_LT(0u, fixed.size());
  ExpectGoodTriangles(mesh.View(), this->Scatter(mesh.View()), GetParam(), options, fixed);
  ExpectGoodTriangles(mesh.View(), this->Cut(mesh.View()), GetParam(), options, fixed);
}

TEST_P(PieceEdgesTest, PointsThatAreNotFinite)
{
  OwnedMesh<double> mesh = MakeRandomBadMeshDouble(500, 27);
  mesh.Points[3 * 100] = std::numeric_limits<double>::quiet_NaN();
  mesh.Points[3 * 200 + 1] = std::numeric_limits<double>::infinity();
  FlipOptions options = MakeCanonical();
  options.Geometry = GeometryKind::PlanarXY;
  options.TieRule = TieRuleKind::Keep;
  ExpectGoodTriangles(mesh.View(), this->Scatter(mesh.View()), GetParam(), options,
    FindFixedEdges(mesh.View(), options));
}

TEST_P(PieceEdgesTest, NumberOfPiecesHasNoEffect)
{
  const OwnedMesh<double> mesh = MakeRandomBadMeshDouble(2000, 37);
  const std::vector<OwnedPiece> pieces = Divide(mesh.View(), this->Cut(mesh.View()), GetParam());
  FlipOptions options = MakeCanonical();
  const GroupResult expected = FlipDivided(mesh.View(), pieces, options);
  options.NumberOfPieces = 3;
  const GroupResult found = FlipDivided(mesh.View(), pieces, options);
  EXPECT_EQ(ToTriangleSet(expected.View()), ToTriangleSet(found.View()));
  EXPECT_EQ(expected.Reports.front().TotalFlips, found.Reports.front().TotalFlips);
}

TEST_P(PieceEdgesTest, AResultIsOverwritten)
{
  const OwnedMesh<double> one = MakeRandomBadMeshDouble(2000, 38);
  const OwnedMesh<double> other = MakeRandomBadMeshDouble(1000, 39);
  const std::vector<OwnedPiece> large = Divide(one.View(), this->Cut(one.View()), GetParam());
  const std::vector<OwnedPiece> small = Divide(other.View(), this->Cut(other.View()), GetParam());
  for (const FlipOptions& options : { MakeCanonical(), MakeOnSurface() })
  {
    // On the surface all triangles are listed in the end.
    const std::vector<FlippedPiece> first = FlipInto({}, large, options);
    const std::vector<FlippedPiece> second = FlipInto(first, small, options);
    ExpectSamePieces(FlipInto({}, small, options), second);
    ExpectSamePieces(first, FlipInto(second, large, options));
  }
}

TEST_P(PieceEdgesTest, OneRankHasAll)
{
  const OwnedMesh<double> mesh = MakeRandomBadMeshDouble(500, 28);
  const Owners owners(mesh.NumberOfTriangles(), GetParam() - 1);
  const GroupResult result = ExpectSameTriangles(mesh.View(), owners, GetParam(), MakeCanonical());
  EXPECT_EQ(1, result.Reports.front().Rounds);
  EXPECT_EQ(mesh.NumberOfTriangles(), result.Sizes.back());
}

TEST_P(PieceEdgesTest, OneRankHasNone)
{
  const OwnedMesh<double> mesh = MakeRandomBadMeshDouble(500, 29);
  Owners owners = this->Cut(mesh.View());
  for (int& owner : owners)
  {
    owner = owner == 1 ? 0 : owner;
  }
  ExpectSameTriangles(mesh.View(), owners, GetParam(), MakeCanonical());
}

TEST_P(PieceEdgesTest, NoRankHasAny)
{
  const OwnedMesh<double> mesh;
  const GroupResult result =
    FlipDivided(mesh.View(), Divide(mesh.View(), {}, GetParam()), FlipOptions());
  ExpectSameOnAllRanks(result.Reports);
  EXPECT_EQ(StopReasonKind::Converged, result.Reports.front().StopReason);
  EXPECT_TRUE(std::isnan(result.Reports.front().MinimumAngleAfter));
}

TEST_P(PieceEdgesTest, AFailureOfOneRankIsThatOfAll)
{
  const OwnedMesh<double> mesh = MakeRandomBadMeshDouble(200, 30);
  std::vector<OwnedPiece> pieces = Divide(mesh.View(), this->Cut(mesh.View()), GetParam());
  pieces[1].Triangles[4] = 77777;
  std::atomic<int> failures{ 0 };
  RunInThreads(GetParam(),
    [&](PieceGroup& group)
    {
      FlippedPiece flipped;
      try
      {
        FlipPiece(pieces[group.GetRank()].View(true), MakeCanonical(), group, flipped);
      }
      catch (const InvalidMesh& error)
      {
        const std::string text = error.what();
        failures += text.find("rank 1: triangle 1 names point 77777") == 0 ? 1 : 0;
      }
    });
  EXPECT_EQ(GetParam(), failures);
}

TEST_P(PieceEdgesTest, GeometryIsDecidedTogether)
{
  // Each half lies in a plane of its own.
  OwnedMesh<double> mesh = MakeGridMesh(8, 4);
  for (std::size_t i = 0; i < mesh.Points.size(); i += 3)
  {
    mesh.Points[i + 2] = 3 * std::fabs(mesh.Points[i] - 4);
  }
  FlipOptions options = MakeOnSurface();
  options.Geometry = GeometryKind::Auto;
  const GroupResult result =
    FlipDivided(mesh.View(), Divide(mesh.View(), this->Cut(mesh.View()), GetParam()), options);
  EXPECT_EQ(GeometryKind::PlanarXY, FindGeometry(mesh.View(), options));
  EXPECT_EQ(GeometryKind::PlanarXY, result.Reports.front().GeometryUsed);
  options.Geometry = GeometryKind::Planar;
  EXPECT_THROW(
    FlipDivided(mesh.View(), Divide(mesh.View(), this->Cut(mesh.View()), GetParam()), options),
    InvalidOptions);
}

TEST_P(PieceEdgesTest, AnyRankCanStopAll)
{
  const OwnedMesh<double> mesh = MakeRandomBadMeshDouble(3000 / Reduction, 31);
  const std::vector<OwnedPiece> pieces = Divide(mesh.View(), this->Cut(mesh.View()), GetParam());
  for (const double limit : { 0.0, 0.3, 0.85 })
  {
    std::vector<PiecesReport> reports(GetParam());
    std::vector<FlippedPiece> flipped(GetParam());
    RunInThreads(GetParam(),
      [&](PieceGroup& group)
      {
        const int rank = group.GetRank();
        const ProgressObserver progress = [&](double share) { return rank != 1 || share <= limit; };
        reports[rank] =
          FlipPiece(pieces[rank].View(true), MakeCanonical(), group, flipped[rank], progress);
      });
    ExpectSameOnAllRanks(reports);
    EXPECT_EQ(StopReasonKind::Aborted, reports.front().StopReason) << limit;
    EXPECT_EQ(mesh.NumberOfTriangles(), reports.front().Triangles);
  }
}

TEST_P(PieceEdgesTest, IterationLimit)
{
  const OwnedMesh<double> mesh = MakeRandomBadMeshDouble(1000, 32);
  const std::vector<OwnedPiece> pieces = Divide(mesh.View(), this->Cut(mesh.View()), GetParam());
  for (const std::int64_t limit : { 0, 1, 3 })
  {
    FlipOptions options = MakeCanonical();
    options.MaximumIterations = limit;
    const GroupResult result = FlipDivided(mesh.View(), pieces, options);
    const PiecesReport& report = result.Reports.front();
    EXPECT_EQ(StopReasonKind::IterationLimit, report.StopReason);
    EXPECT_EQ(limit, static_cast<std::int64_t>(report.Iterations.size()));
    TriangleMesh after = mesh.View();
    after.Triangles = result.View();
    EXPECT_EQ(CountNonDelaunayEdges(after, options), report.NonDelaunayAfter);
  }
}

/// They are not looked at.
TEST(PiecesTest, TooManyPointsForARankAreAnError)
{
  const double x[3] = {};
  MeshPiece piece;
  piece.Mesh.Points = PointArray(x, std::int64_t(1) << 31);
  FlippedPiece flipped;
  EXPECT_THROW(FlipPiece(piece, {}, *MakeSingleGroup(), flipped), MeshTooLarge);
}

TEST(PiecesTest, PointsThatCoincideOnOneRankStayApart)
{
  // A slit from (0, 0) to (1, 0), along which the left piece has two points at the same place.
  OwnedMesh<double> mesh;
  mesh.Points = { 0, 0, 0, 1, 0, 0, 0.5, 1, 0, 0, 0, 0, 0.5, -1, 0, 2, 0.1, 0 };
  mesh.Triangles = { 0, 1, 2, 3, 4, 1, 1, 5, 2 };
  const Owners owners{ 0, 0, 1 };
  const GroupResult result =
    FlipDivided(mesh.View(), Divide(mesh.View(), owners, 2), MakeCanonical(), false);
  EXPECT_EQ(0, result.Reports.front().AmbiguousPoints); // the other rank has neither of them
  const Owners others{ 0, 0, 1 };
  mesh.Triangles = { 0, 1, 2, 3, 4, 1, 0, 2, 5 };
  const GroupResult ambiguous =
    FlipDivided(mesh.View(), Divide(mesh.View(), others, 2), MakeCanonical(), false);
  EXPECT_EQ(3, ambiguous.Reports.front().AmbiguousPoints);
}

TEST_P(PieceEdgesTest, AMeshOfOneProcessInPieces)
{
  const OwnedMesh<float> mesh = MakeRandomBadMesh(3000 / Reduction, 33);
  const FlipResult alone = Flip(mesh.View(), MakeCanonical());
  for (const std::vector<int>& devices : { std::vector<int>{}, { 0, 1 } })
  {
    std::vector<std::int32_t> triangles = mesh.Triangles;
    TriangleMesh given = mesh.View();
    given.Triangles = ViewTriangles(triangles);
    FlipOptions options = MakeInPieces(GetParam());
    options.Devices = devices;
    const PiecesReport report = FlipInPieces(
      given, options, MutableTriangleArray(triangles.data(), mesh.NumberOfTriangles()));
    EXPECT_EQ(ToTriangleSet(alone.Triangles), ToTriangleSet(triangles));
    ExpectSameCounts(alone.Report, report);
  }
}

TEST_P(PieceEdgesTest, WhatIsFixedInAMeshOfOneProcessStays)
{
  const OwnedMesh<double> mesh = MakeRandomBadMeshDouble(800, 35);
  TriangleMesh given = mesh.View();
  const std::vector<std::int64_t> edges = ChooseEdges(given);
  const std::vector<std::int32_t> labels = MakeStripes(given);
  std::vector<unsigned char> frozen(mesh.NumberOfTriangles());
  for (std::size_t t = 0; t < frozen.size(); t += 20)
  {
    frozen[t] = 1;
  }
  given.ConstraintEdges = edges.data();
  given.NumberOfConstraintEdges = static_cast<std::int64_t>(edges.size()) / 2;
  given.Regions = labels.data();
  given.FrozenTriangles = frozen.data();
  const FlipResult alone = Flip(given, MakeCanonical());
  std::vector<std::int32_t> triangles = mesh.Triangles;
  const PiecesReport report = FlipInPieces(given, MakeInPieces(GetParam()),
    MutableTriangleArray(triangles.data(), mesh.NumberOfTriangles()));
  EXPECT_EQ(ToTriangleSet(alone.Triangles), ToTriangleSet(triangles));
  ExpectSameCounts(alone.Report, report);
  EXPECT_LT(0, report.Edges.Constraint);
  EXPECT_LT(0, report.Edges.Region);
}

TEST_P(PieceEdgesTest, TheCallerCanStopAMeshInPieces)
{
  const OwnedMesh<double> mesh = MakeRandomBadMeshDouble(1000, 34);
  std::vector<std::int32_t> triangles = mesh.Triangles;
  const PiecesReport report = FlipInPieces(mesh.View(), MakeInPieces(GetParam()),
    MutableTriangleArray(triangles.data(), mesh.NumberOfTriangles()),
    [](double share) { return share < 0.3; });
  EXPECT_EQ(StopReasonKind::Aborted, report.StopReason);
  EXPECT_EQ(0, report.Edges.Edges); // as of a run on one rank that is stopped so early
  EXPECT_EQ(
    EulerCharacteristic(mesh.View().Triangles), EulerCharacteristic(ViewTriangles(triangles)));
}

INSTANTIATE_TEST_SUITE_P(Pieces, PieceEdgesTest, testing::Values(2, 3, 7), NameRanks);

}
}
