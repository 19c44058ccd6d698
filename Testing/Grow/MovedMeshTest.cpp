// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// Sessions from triangles that go on with points at other places.

#include "FlipTestSupport.h"
#include "MeshAudit.h"
#include "References.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace delaunayflip
{
namespace
{

/// Moves every coordinate by up to this much.
void Shake(OwnedMesh<double>& mesh, double size, std::uint32_t seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> draw(-size, size);
  for (double& coordinate : mesh.Points)
  {
    coordinate += draw(random);
  }
}

bool MoveTo(FlipSession& session, const std::vector<double>& points)
{
  PointMove move;
  move.Points = PlaneArray(points.data(), static_cast<std::int64_t>(points.size()) / 3, 3);
  return session.Move(move);
}

FlipOptions OnThreads(int threads, const FlipOptions& options)
{
  return WithThreads(threads, OnBackend(BackendKind::Threads, options));
}

/// A plane without points that are near to each other.
OwnedMesh<double> MakePlane()
{
  const OwnedMesh<float> jittered = MakeJitteredGrid(4000 / Reduction, 3);
  OwnedMesh<double> mesh{ { jittered.Points.begin(), jittered.Points.end() }, jittered.Triangles };
  for (std::size_t i = 0; i < mesh.Points.size(); i += 3)
  {
    mesh.Points[i] += 0.7 * mesh.Points[i + 1];
  }
  return mesh;
}

/// The length of an edge of the first triangle.
double GetScale(const OwnedMesh<double>& mesh)
{
  const double* a = &mesh.Points[3 * static_cast<std::size_t>(mesh.Triangles[0])];
  const double* b = &mesh.Points[3 * static_cast<std::size_t>(mesh.Triangles[1])];
  return std::hypot(std::hypot(b[0] - a[0], b[1] - a[1]), b[2] - a[2]);
}

struct Family
{
  const char* Name;
  OwnedMesh<double> (*Make)();
  FlipOptions Options;
};

std::vector<Family> ListFamilies()
{
  const auto sphere = [] { return MakeBadSphere(60 / Reduction + 10, 30, 5); };
  const auto moebius = [] { return MakeMoebiusStrip(60, 9, 5); };
  return { { "plane", MakePlane, InPlane(TieRuleKind::Canonical) },
    { "plane, ties", MakePlane, InPlane() }, { "sphere", sphere, OnSurface() },
    { "sphere, edges", sphere, OnSurface(8.0) }, { "moebius", moebius, OnSurface(30.0) },
    { "angles", MakePlane,
      With(&FlipOptions::Criterion, CriterionKind::OppositeAngles, InPlane()) } };
}

}

TEST(MovedMesh, GivesTheSameForAnyNumberOfThreads)
{
  for (const Family& family : ListFamilies())
  {
    SCOPED_TRACE(family.Name);
    OwnedMesh<double> mesh = family.Make();
    const OwnedMesh<double> first = mesh;
    FlipSession one(first.View(), OnThreads(1, family.Options));
    FlipSession three(first.View(), OnThreads(3, family.Options));
    const EdgeCounts edges = one.GetReport().Edges;
    one.Advance(-1);
    three.Advance(-1);
    const std::int64_t flips = one.GetReport().TotalFlips;
    for (std::uint32_t frame = 0; frame < 5; ++frame)
    {
      Shake(mesh, 0.02 * GetScale(first), frame);
      for (FlipSession* session : { &one, &three })
      {
        ASSERT_TRUE(MoveTo(*session, mesh.Points));
        EXPECT_EQ(session->GetReport().TotalFlips, 0);
        session->Advance(frame == 2 ? 1 : -1); // the next one comes in the middle of a run
      }
      const FlipReport& report = one.GetReport();
      EXPECT_EQ(report.Edges.Fixed, edges.Fixed);
      EXPECT_EQ(report.Edges.Feature, edges.Feature);
      EXPECT_LT(report.TotalFlips, flips / 2);
      EXPECT_EQ(SumFlips(StoreFlipCounts(one)), report.TotalFlips);
      ExpectConsistentStatistics(report);
      ExpectSameStatistics(report, three.GetReport());
      EXPECT_EQ(StoreTriangles(one), StoreTriangles(three));
      EXPECT_EQ(StoreFlipCounts(one), StoreFlipCounts(three));
      ExpectSameTopology(first.View().Triangles, StoreTriangles(one), report);
      if (report.Edges.Feature == 0)
      {
        const std::vector<std::int32_t> triangles = StoreTriangles(one);
        const TriangleMesh now = WithTriangles(mesh.View(), triangles);
        const FlipOptions audit = With(&FlipOptions::FeatureAngle, 180.0, family.Options);
        EXPECT_EQ(CountNonDelaunayEdges(now, audit), report.NonDelaunayAfter);
      }
    }
    EXPECT_TRUE(one.GetReport().Converged());
  }
}

/// In the plane, with canonical ties, the triangles are those of a new session.
TEST(MovedMesh, FollowsPointsOfAPlane)
{
  OwnedMesh<double> mesh = MakePlane();
  const OwnedMesh<double> first = mesh;
  const FlipOptions options = OnThreads(2, InPlane(TieRuleKind::Canonical));
  FlipSession session(first.View(), options);
  session.Advance(-1);
  std::int64_t flips = 0;
  for (std::uint32_t frame = 0; frame < 10; ++frame)
  {
    Shake(mesh, 0.02 * GetScale(first), frame);
    ASSERT_TRUE(MoveTo(session, mesh.Points));
    session.Advance(-1);
    flips += session.GetReport().TotalFlips;
    const FlipResult fresh = Flip(mesh.View(), options);
    EXPECT_EQ(ToTriangleSet(fresh.Triangles), ToTriangleSet(StoreTriangles(session)));
    EXPECT_EQ(session.GetReport().NonDelaunayAfter, 0);
    EXPECT_DOUBLE_EQ(fresh.Report.MinimumAngleAfter, session.GetReport().MinimumAngleAfter);
  }
  EXPECT_GT(flips, 0);
}

/// Edges that were fixed at first stay, also where the surface has become flat.
TEST(MovedMesh, KeepsFixedEdges)
{
  OwnedMesh<double> roof{ { -2, 0, 0, 0, -1, -1, 2, 0, 0, 0, 1, -1 }, { 0, 1, 2, 0, 2, 3 } };
  FlipSession session(roof.View(), OnThreads(1, OnSurface(30.0)));
  session.Advance(-1);
  const std::vector<std::int32_t> before = StoreTriangles(session);
  std::vector<double> flat = roof.Points;
  flat[5] = flat[11] = 0.0;
  ASSERT_TRUE(MoveTo(session, flat));
  session.Advance(-1);
  EXPECT_EQ(StoreTriangles(session), before);
  EXPECT_EQ(session.GetReport().Edges.Feature, 1);

  FlipSession smooth(roof.View(), OnThreads(1, OnSurface()));
  ASSERT_TRUE(MoveTo(smooth, flat));
  smooth.Advance(-1);
  EXPECT_EQ(smooth.GetReport().TotalFlips, 1);
}

TEST(MovedMesh, DoesNotCountFlipsOfConstraintsAgain)
{
  const OwnedMesh<double> mesh = MakePlane();
  const auto last = static_cast<std::int64_t>(mesh.NumberOfPoints() - 1);
  const std::vector<std::int64_t> ends = { 1, last };
  const unsigned char toInsert[] = { 1 };
  FlipSession session(
    WithConstraints(mesh.View(), ends, toInsert), OnThreads(1, InPlane(TieRuleKind::Canonical)));
  session.Advance(-1);
  const std::int64_t inserted = session.GetReport().InsertedConstraints;
  ASSERT_GT(session.GetReport().ConstraintFlips, 0);
  ASSERT_TRUE(MoveTo(session, mesh.Points));
  session.Advance(-1);
  EXPECT_EQ(session.GetReport().InsertedConstraints, inserted);
  EXPECT_EQ(SumFlips(StoreFlipCounts(session)), 0);
}

TEST(MovedMesh, RefusesWhatDoesNotFit)
{
  const OwnedMesh<double> mesh = MakePlane();
  const auto count = static_cast<std::int64_t>(mesh.NumberOfPoints());
  FlipOptions options = OnThreads(1, FlipOptions());
  FlipSession session(mesh.View(), options);
  session.Advance(-1);
  const std::vector<std::int32_t> before = StoreTriangles(session);
  PointMove move;
  move.Points = PlaneArray(mesh.Points.data(), count - 1, 3);
  EXPECT_THROW(session.Move(move), InvalidOptions);
  move.Points = PlaneArray(mesh.Points.data(), count, 2);
  EXPECT_THROW(session.Move(move), InvalidOptions);
  const std::int64_t id = 0;
  move.Points = PlaneArray(mesh.Points.data(), 1, 3);
  move.Ids = &id;
  EXPECT_THROW(session.Move(move), InvalidOptions);
  move = PointMove();
  move.Points = PlaneArray(mesh.Points.data(), count, 3);
  EXPECT_FALSE(session.Move(move, [](double) { return false; }));
  std::vector<double> lost = mesh.Points, bent = mesh.Points;
  lost[30] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(MoveTo(session, lost), InvalidOptions);
  for (std::size_t i = 0; i < bent.size(); i += 3)
  {
    bent[i + 2] = bent[i];
    bent[i] = std::fabs(bent[i] - bent[bent.size() / 2]); // folded, so no height field
  }
  EXPECT_THROW(MoveTo(session, bent), InvalidOptions);
  EXPECT_EQ(StoreTriangles(session), before);
  EXPECT_TRUE(session.GetReport().Converged());
  EXPECT_TRUE(MoveTo(session, mesh.Points));
  session.Advance(-1);
  EXPECT_EQ(StoreTriangles(session), before);

  options = With(&FlipOptions::MinimumAngle, 10.0, OnThreads(1, InPlane()));
  FlipSession refined(mesh.View(), options);
  refined.Advance(-1);
  EXPECT_THROW(MoveTo(refined, mesh.Points), InvalidOptions);
}

}
