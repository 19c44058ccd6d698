// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "DelaunayFlip.h"
#include "GeneratedMeshes.h"
#include "MeshAudit.h"
#include "PieceTestSupport.h"

#include <gtest/gtest.h>

#include <numeric>

/// @file
/// Sessions with several pieces.

namespace delaunayflip
{
namespace
{

std::vector<std::int32_t> StoreTriangles(const FlipSession& session)
{
  std::vector<std::int32_t> ids(3 * session.GetReport().Triangles);
  session.StoreTriangles(MutableTriangleArray(ids.data(), session.GetReport().Triangles));
  return ids;
}

std::vector<std::int32_t> StoreFlipCounts(const FlipSession& session)
{
  std::vector<std::int32_t> counts(session.GetReport().Triangles, -1);
  session.StoreFlipCounts(counts.data());
  return counts;
}

/// The parameter is the number of pieces.
class DividedSessionTest : public testing::TestWithParam<int>
{
protected:
  FlipOptions MakeOptions() const { return MakeInPieces(GetParam()); }
  const OwnedMesh<double> Mesh = MakeRandomBadMeshDouble(2000, 61);
};

TEST_P(DividedSessionTest, GivesTheTrianglesOfFlipInPieces)
{
  for (const OwnedMesh<double>& mesh : { this->Mesh, MakeBadSphere(40, 20, 62) })
  {
    FlipOptions options = this->MakeOptions();
    options.TieRule = TieRuleKind::Keep;
    std::vector<std::int32_t> expected(mesh.Triangles.size());
    const PiecesReport report = FlipInPieces(
      mesh.View(), options, MutableTriangleArray(expected.data(), mesh.NumberOfTriangles()));
    FlipSession session(mesh.View(), options);
    EXPECT_EQ(mesh.NumberOfPoints(), session.GetReport().Points);
    EXPECT_EQ(report.GeometryUsed, session.GetReport().GeometryUsed);
    EXPECT_EQ(report.Tolerance, session.GetReport().Tolerance);
    EXPECT_EQ(mesh.Triangles, StoreTriangles(session));
    EXPECT_TRUE(session.Advance(0));
    EXPECT_FALSE(session.Advance(1));
    EXPECT_EQ(expected, StoreTriangles(session));
    EXPECT_FALSE(session.Advance());
    ExpectSameStatistics(report, session.GetReport());
  }
}

TEST_P(DividedSessionTest, CountsTheFlipsOfEveryTriangle)
{
  FlipSession session(this->Mesh.View(), this->MakeOptions());
  EXPECT_EQ(std::vector<std::int32_t>(this->Mesh.NumberOfTriangles()), StoreFlipCounts(session));
  session.Advance();
  const std::vector<std::int32_t> counts = StoreFlipCounts(session);
  const std::vector<std::int32_t> after = StoreTriangles(session);
  EXPECT_LT(0, session.GetReport().TotalFlips);
  EXPECT_EQ(2 * session.GetReport().TotalFlips,
    std::accumulate(counts.begin(), counts.end(), std::int64_t(0)));
  for (std::size_t t = 0; t < counts.size(); ++t)
  {
    const auto first = after.begin() + 3 * static_cast<std::ptrdiff_t>(t);
    EXPECT_TRUE(counts[t] > 0 || std::equal(first, first + 3, &this->Mesh.Triangles[3 * t]));
  }
}

TEST_P(DividedSessionTest, CountsTheFlipsOfConstraints)
{
  const std::vector<std::int64_t> edges{ 10, 1990, 20, 1980 };
  const std::vector<unsigned char> insert{ 1, 1 };
  TriangleMesh mesh = this->Mesh.View();
  mesh.ConstraintEdges = edges.data();
  mesh.NumberOfConstraintEdges = 2;
  mesh.ConstraintsToInsert = insert.data();
  FlipSession session(mesh, this->MakeOptions());
  session.Advance();
  const FlipReport report = session.GetReport();
  const std::vector<std::int32_t> counts = StoreFlipCounts(session);
  EXPECT_LT(0, report.ConstraintFlips);
  EXPECT_EQ(2 * (report.TotalFlips + report.ConstraintFlips),
    std::accumulate(counts.begin(), counts.end(), std::int64_t(0)));
  const FlipResult alone = Flip(mesh, MakeCanonical());
  EXPECT_EQ(ToTriangleSet(alone.Triangles), ToTriangleSet(StoreTriangles(session)));
}

TEST_P(DividedSessionTest, BeginsAnewAfterItWasStopped)
{
  FlipSession session(this->Mesh.View(), this->MakeOptions());
  session.Advance();
  const std::vector<std::int32_t> expected = StoreTriangles(session);
  const std::vector<std::int32_t> counts = StoreFlipCounts(session);
  FlipSession stopped(this->Mesh.View(), this->MakeOptions());
  EXPECT_FALSE(stopped.Advance(-1, {}, [](double share) { return share < 0.5; }));
  EXPECT_EQ(StopReasonKind::Aborted, stopped.GetReport().StopReason);
  EXPECT_NE(this->Mesh.Triangles, StoreTriangles(stopped));
  EXPECT_EQ(EulerCharacteristic(this->Mesh.View().Triangles),
    EulerCharacteristic(ViewTriangles(StoreTriangles(stopped))));
  double last = 0.0;
  EXPECT_FALSE(stopped.Advance(-1, {},
    [&](double share)
    {
      last = share;
      return true;
    }));
  EXPECT_EQ(1.0, last);
  EXPECT_EQ(expected, StoreTriangles(stopped));
  EXPECT_EQ(counts, StoreFlipCounts(stopped));
}

TEST_P(DividedSessionTest, CanBeStoppedWhileConstraintsAreInserted)
{
  const std::vector<std::int64_t> edges{ 10, 1990 };
  const unsigned char insert = 1;
  TriangleMesh mesh = this->Mesh.View();
  mesh.ConstraintEdges = edges.data();
  mesh.NumberOfConstraintEdges = 1;
  mesh.ConstraintsToInsert = &insert;
  FlipSession session(mesh, this->MakeOptions(), [](double) { return false; });
  EXPECT_EQ(StopReasonKind::Aborted, session.GetReport().StopReason);
  EXPECT_EQ(this->Mesh.Triangles, StoreTriangles(session));
  session.Advance();
  EXPECT_EQ(StopReasonKind::Converged, session.GetReport().StopReason);
  EXPECT_EQ(
    ToTriangleSet(Flip(mesh, MakeCanonical()).Triangles), ToTriangleSet(StoreTriangles(session)));
}

TEST_P(DividedSessionTest, TellsAllIterations)
{
  FlipSession session(this->Mesh.View(), this->MakeOptions());
  std::int64_t iterations = 0;
  session.Advance(-1, [&](const IterationRecord& row) { return row.Iteration == ++iterations; });
  EXPECT_LT(0, iterations);
  EXPECT_EQ(iterations, static_cast<std::int64_t>(session.GetReport().Iterations.size()));
}

TEST_P(DividedSessionTest, FlipToDelaunayWritesNothingAfterAnError)
{
  OwnedMesh<double> mesh = this->Mesh;
  mesh.Triangles[100] = 77777;
  std::vector<std::int32_t> output(mesh.Triangles.size(), -5);
  const MutableTriangleArray triangles(output.data(), mesh.NumberOfTriangles());
  EXPECT_THROW(FlipToDelaunay(mesh.View(), this->MakeOptions(), triangles), InvalidMesh);
  EXPECT_EQ(std::vector<std::int32_t>(output.size(), -5), output);
}

TEST_P(DividedSessionTest, LongIdsInPlace)
{
  const FlipResult expected = Flip(this->Mesh.View(), this->MakeOptions());
  std::vector<std::int64_t> ids(this->Mesh.Triangles.begin(), this->Mesh.Triangles.end());
  TriangleMesh mesh = this->Mesh.View();
  mesh.Triangles = TriangleArray(ids.data(), mesh.Triangles.Count);
  FlipToDelaunay(mesh, this->MakeOptions(), MutableTriangleArray(ids.data(), mesh.Triangles.Count));
  EXPECT_TRUE(
    std::equal(ids.begin(), ids.end(), expected.Triangles.begin(), expected.Triangles.end()));
}

INSTANTIATE_TEST_SUITE_P(
  Pieces, DividedSessionTest, testing::Values(2, 5), testing::PrintToStringParamName());

}
}
