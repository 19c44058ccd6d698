// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FlipError.h"
#include "InputChecks.h"
#include "MeshAudit.h"
#include "PartTestSupport.h"
#include "RandomInputs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

/// @file
/// Meshes in parts become those of one run on the whole: cut or scattered over ranks, or one part
/// after the other in one process.

namespace delaunayflip
{
namespace
{

using Mesh = OwnedMesh<double>;

/// A mesh and how it is flipped.
struct Case
{
  const char* Name;
  Mesh (*Make)();
  FlipOptions (*GetOptions)();
  bool IsUnique; ///< Whether its triangles do not depend on the order of flips.
};

FlipOptions Canonical() { return MakeCanonical(); }
FlipOptions KeepTies() { return With(&FlipOptions::TieRule, TieRuleKind::Keep, MakeCanonical()); }
FlipOptions Terrain() { return With(&FlipOptions::Geometry, GeometryKind::PlanarXY, KeepTies()); }
FlipOptions OnSurfaces() { return OnSurfaceOfRanks(); }
FlipOptions WithFeatures() { return OnSurfaceOfRanks(20.0); }
FlipOptions WithDeviation()
{
  return With(&FlipOptions::MaximumDeviation, 0.002, OnSurfaceOfRanks());
}

Mesh MakeClockwisePlane()
{
  Mesh mesh = Transform(MakeRandomBadMeshDouble(2000 / Reduction, 9),
    { { { 1, 0, 0, 0 }, { 0, 1, 0, 0 }, { 2, -3, 0, 0 } } });
  ReverseTriangles(mesh.Triangles);
  return mesh;
}

Mesh MakeHills(double height)
{
  return Lift(MakeRandomBadMeshDouble(600, 19),
    [=](double x, double y) { return height * std::sin(9 * x) * std::cos(7 * y); });
}

/// With points that are not finite, and a triangle that has one point twice.
Mesh MakeBroken()
{
  Mesh mesh = MakeRandomBadMeshDouble(500, 27);
  mesh.Points[3 * 100] = std::numeric_limits<double>::quiet_NaN();
  mesh.Points[3 * 200 + 1] = std::numeric_limits<double>::infinity();
  mesh.Triangles.insert(mesh.Triangles.end(), { 3, 3, 4 });
  return mesh;
}

/// Sheets that meet in one edge after the other, and so across seams.
Mesh MakeSheets()
{
  const Mesh sheet = MakeRandomBadMeshDouble(150, 48);
  Mesh mesh = sheet;
  for (int copy = 1; copy < 3; ++copy)
  {
    std::vector<std::int32_t> ids;
    for (std::int32_t i = 0; i < sheet.NumberOfPoints(); ++i)
    {
      // Points with even ids belong to all sheets.
      ids.push_back(i % 2 == 0 ? i : static_cast<std::int32_t>(mesh.NumberOfPoints()));
      if (i % 2 == 1)
      {
        const double* x = &sheet.Points[3 * i];
        mesh.Points.insert(mesh.Points.end(), { x[0], x[1], 0.001 * copy });
      }
    }
    for (const std::int32_t id : sheet.Triangles)
    {
      mesh.Triangles.push_back(ids[id]);
    }
  }
  return mesh;
}

/// Two triangulations of the same points, one over the other.
Mesh MakeTwoSheets()
{
  Mesh mesh = MakeRandomBadMeshDouble(80, 5);
  const FlipOptions few = With(&FlipOptions::MaximumIterations, 2, MakeCanonical());
  const std::vector<std::int32_t> other = Flip(mesh.View(), few).Triangles;
  mesh.Triangles.insert(mesh.Triangles.end(), other.begin(), other.end());
  return mesh;
}

/// Three pages around a spine. One of three parts has the first page. In the other parts, edges of
/// the spine have two triangles and look like any edge that is bad.
Mesh MakePages()
{
  constexpr int Length = 12;
  constexpr int Width = 8;
  const double directions[3][2] = { { -1.0, 0.0 }, { 1.0, 0.3 }, { 1.0, -0.3 } };
  Mesh mesh;
  for (int i = 0; i <= Length; ++i)
  {
    mesh.Points.insert(mesh.Points.end(), { 0.0, 1.0 * i, 0.0 });
  }
  for (int page = 0; page < 3; ++page)
  {
    const auto first = static_cast<std::int32_t>(mesh.NumberOfPoints());
    const auto find = [=](int i, int j) { return j == 0 ? i : first + (j - 1) * (Length + 1) + i; };
    for (int i = 0; i < Width * (Length + 1); ++i)
    {
      const int j = i / (Length + 1) + 1;
      const double away = 0.2 * j * j; // the first row is narrow
      mesh.Points.insert(mesh.Points.end(),
        { away * directions[page][0], i % (Length + 1) + 0.5, away * directions[page][1] });
    }
    for (int i = 0; i < Width * Length; ++i)
    {
      const std::int32_t a = find(i % Length, i / Length), b = find(i % Length + 1, i / Length);
      const std::int32_t d = find(i % Length, i / Length + 1), c = d + 1;
      const bool isTurned = page == 2;
      mesh.Triangles.insert(mesh.Triangles.end(), { a, isTurned ? d : b, isTurned ? b : d });
      mesh.Triangles.insert(mesh.Triangles.end(), { b, isTurned ? d : c, isTurned ? c : d });
    }
  }
  return mesh;
}

const Case Cases[] = {
  { "Plane", [] { return MakeRandomBadMeshDouble(6000 / Reduction, 5); }, Canonical, true },
  { "Ties", [] { return MakeGridMesh(30, 20); }, Canonical, true },
  { "ClockwiseTiltedPlane", MakeClockwisePlane, Canonical, true },
  { "WorstCase", [] { return MakeWorstCaseMesh(40); }, Canonical, true },
  { "HighTerrain", [] { return MakeHills(100.0); }, Canonical, true },
  { "FewTriangles", [] { return MakeRandomBadMeshDouble(5, 54); }, Canonical, true },
  { "Sphere", [] { return MakeBadSphere(60, 30, 11); }, OnSurfaces, false },
  { "SmallSphere", [] { return MakeBadSphere(6, 4, 2); }, OnSurfaces, false },
  { "SphereWithFeatures", [] { return MakeBadSphere(40, 20, 44); }, WithFeatures, false },
  { "SphereWithDeviation", [] { return MakeBadSphere(40, 20, 44); }, WithDeviation, false },
  { "Hills", [] { return MakeHills(0.3); }, OnSurfaces, false },
  { "MoebiusStrip", [] { return MakeMoebiusStrip(60, 6, 14); }, OnSurfaces, false },
  { "RepeatedTriangles", [] { return RepeatTriangles(MakeBadSphere(30, 15, 15)); }, OnSurfaces,
    false },
  { "RepeatedInAPlane", [] { return RepeatTriangles(MakeRandomBadMeshDouble(400, 17)); }, KeepTies,
    false },
  { "Broken", MakeBroken, Terrain, false },
  { "ThreeSheets", MakeSheets, OnSurfaces, false },
  { "TwoSheetsOverTheSamePoints", MakeTwoSheets, Canonical, false },
  { "ThreePages", MakePages, OnSurfaces, false },
};

/// The parameter is the number of parts.
class PartsTest : public testing::TestWithParam<int>
{
protected:
  std::vector<OwnPiece> Cut(const TriangleMesh& mesh) const { return DivideMesh(mesh, GetParam()); }
  std::vector<OwnPiece> Scatter(const TriangleMesh& mesh) const
  {
    return DivideMesh(mesh, DivideAtRandom(mesh, GetParam()), GetParam());
  }

  /// However the mesh is divided.
  void ExpectRight(const TriangleMesh& mesh, const FlipOptions& options, bool isUnique) const
  {
    const auto flip = [&](int way)
    {
      return way == 2
        ? FlipHere(mesh, GetParam(), options)
        : FlipDivided(mesh, way == 0 ? this->Cut(mesh) : this->Scatter(mesh), options);
    };
    for (const int way : { 0, 1, 2 })
    {
      SCOPED_TRACE(way == 0 ? "cut" : way == 1 ? "scattered" : "in one process");
      const PartsResult result = flip(way);
      isUnique ? ExpectAsAlone(mesh, options, result) : ExpectGood(mesh, options, result);
      EXPECT_EQ(result.Triangles, flip(way).Triangles) << "a second run";
    }
  }
};

TEST_P(PartsTest, MeshesOfAllKinds)
{
  for (const Case& one : Cases)
  {
    SCOPED_TRACE(one.Name);
    this->ExpectRight(one.Make().View(), one.GetOptions(), one.IsUnique);
  }
}

TEST_P(PartsTest, WhatIsFixed)
{
  const Mesh owned = MakeRandomBadMeshDouble(800, 24);
  TriangleMesh mesh = owned.View();
  std::vector<std::int32_t> regions;
  std::vector<unsigned char> frozen;
  std::vector<std::int64_t> constraints{ 1, 490, 2, 480 }; // no edges
  for (std::int64_t t = 0; t < mesh.Triangles.Count; ++t)
  {
    const std::int64_t first = mesh.Triangles.Get(t, 0);
    regions.push_back(static_cast<std::int32_t>(5 * mesh.Points.Get(first, 1)));
    frozen.push_back(t % 20 == 0);
    if (t % 9 == 0)
    {
      constraints.insert(constraints.end(), { first, mesh.Triangles.Get(t, 1) });
    }
  }
  mesh.Regions = regions.data();
  this->ExpectRight(mesh, MakeCanonical(), true);
  mesh.FrozenTriangles = frozen.data();
  this->ExpectRight(mesh, MakeCanonical(), true);
  // Ranks that lack an end of a constraint do not count it.
  ExpectAsAlone(WithConstraints(mesh, constraints), MakeCanonical(),
    FlipHere(WithConstraints(mesh, constraints), GetParam(), MakeCanonical()));
  constraints.erase(constraints.begin(), constraints.begin() + 4);
  this->ExpectRight(WithConstraints(mesh, constraints), MakeCanonical(), true);
}

TEST_P(PartsTest, AnyMess)
{
  for (std::uint32_t seed = 0; seed < 100 / Reduction; ++seed)
  {
    SCOPED_TRACE(seed);
    RandomMess mess = MakeRandomMess(seed);
    mess.Options.Backend = BackendKind::Threads;
    mess.Options.TieRule = TieRuleKind::Keep;
    const TriangleMesh mesh = mess.View();
    const PartsResult result = FlipHere(mesh, GetParam(), mess.Options);
    const FlipReport alone = Flip(mesh, mess.Options).Report;
    if (!std::isnan(alone.MinimumAngleBefore)) // it has triangles with finite points
    {
      ExpectSameCounts(alone, result.Report);
    }
    ExpectSameTopology(mesh.Triangles, result.Triangles, alone);
    EXPECT_EQ(result.Triangles, FlipHere(mesh, GetParam(), mess.Options).Triangles);
    if (result.Report.Converged())
    {
      ExpectNothingLeft(mesh, mess.Options, result);
    }
  }
}

TEST_P(PartsTest, ThreadsAndDevicesDoNotMatter)
{
  const Mesh mesh = MakeBadSphere(60, 30, 49);
  FlipOptions options = OnSurfaceOfRanks(30.0);
  const PartsResult one = FlipHere(mesh.View(), GetParam(), options);
  options.NumberOfThreads = 4;
  options.Devices = { 0, 1 };
  const PartsResult four = FlipHere(mesh.View(), GetParam(), options);
  EXPECT_EQ(one.Triangles, four.Triangles);
  ExpectSameStatistics(one.Report, four.Report);
}

/// What parts do at the same time is one iteration.
TEST_P(PartsTest, IterationsAreLimitedOverAllRounds)
{
  for (const bool isPlanar : { true, false })
  {
    const Mesh mesh = isPlanar ? MakeRandomBadMeshDouble(300, 17) : MakeBadSphere(20, 10, 3);
    FlipOptions options = isPlanar ? MakeCanonical() : OnSurfaceOfRanks();
    for (const bool onRanks : { true, false })
    {
      const auto flip = [&]
      {
        return onRanks ? FlipDivided(mesh.View(), this->Scatter(mesh.View()), options)
                       : FlipHere(mesh.View(), GetParam(), options);
      };
      options.MaximumIterations = -1;
      const auto all = static_cast<std::int64_t>(flip().Report.Iterations.size());
      for (const std::int64_t most : std::vector<std::int64_t>{ 0, 1, 2, all - 1, all })
      {
        options.MaximumIterations = most;
        const PartsResult result = flip();
        EXPECT_EQ(most, static_cast<std::int64_t>(result.Report.Iterations.size()));
        EXPECT_EQ(most < all ? StopReasonKind::IterationLimit : StopReasonKind::Converged,
          result.Report.StopReason)
          << most << " of " << all;
        EXPECT_EQ(CountNonDelaunayEdges(WithTriangles(mesh.View(), result.Triangles), options),
          result.Report.NonDelaunayAfter)
          << most << " of " << all;
      }
    }
  }
}

/// In one process, the smallest angle after an iteration is that of the whole mesh. Ranks know only
/// those before the first iteration and after the last.
TEST_P(PartsTest, SmallestAngles)
{
  for (const Mesh& mesh : { MakeRandomBadMeshDouble(500, 52), MakeBadSphere(20, 10, 3) })
  {
    FlipOptions options = KeepTies();
    options.TrackQuality = true;
    const PiecesReport report = FlipHere(mesh.View(), GetParam(), options).Report;
    const auto count = static_cast<std::int64_t>(report.Iterations.size());
    for (const std::int64_t limit : std::vector<std::int64_t>{ 1, (count + 1) / 2, count })
    {
      options.MaximumIterations = limit;
      const PartsResult part = FlipHere(mesh.View(), GetParam(), options);
      const double angle =
        MinimumAngle(WithTriangles(mesh.View(), part.Triangles), report.GeometryUsed);
      EXPECT_NEAR(angle, part.Report.Iterations.back().MinimumAngle, 1e-9);
      EXPECT_EQ(limit < count, std::isnan(report.Iterations[limit - 1].MinimumAngle));
      EXPECT_NEAR(angle, part.Report.MinimumAngleAfter, 1e-9);
    }
    options.MaximumIterations = -1;
    const PiecesReport ranks = FlipDivided(mesh.View(), this->Cut(mesh.View()), options).Report;
    for (const IterationRecord& row : ranks.Iterations)
    {
      const bool isLast = &row == &ranks.Iterations.back();
      EXPECT_EQ(!isLast, std::isnan(row.MinimumAngle)) << row.Iteration;
    }
    EXPECT_EQ(ranks.MinimumAngleAfter, ranks.Iterations.back().MinimumAngle);
  }
}

TEST_P(PartsTest, EmptyMeshes)
{
  const Mesh none;
  for (const PartsResult& result :
    { FlipHere(none.View(), GetParam(), {}), FlipDivided(none.View(), this->Cut(none.View()), {}) })
  {
    EXPECT_EQ(StopReasonKind::Converged, result.Report.StopReason);
    EXPECT_TRUE(std::isnan(result.Report.MinimumAngleAfter));
  }
}

//------------------------------------------------------------------------------
// Sessions and calls in one process.

/// The observer may stop at any time, also while constraints are inserted; then the mesh is whole,
/// and a session begins anew.
TEST_P(PartsTest, TheCallerCanStopAtAnyTime)
{
  const Mesh owned = MakeRandomBadMeshDouble(1000, 56);
  const std::vector<std::int64_t> edges{ 10, 990, 20, 980, 50, 60 };
  const std::vector<unsigned char> insert{ 1, 1, 0 };
  const TriangleMesh mesh = WithConstraints(owned.View(), edges, insert.data());
  const FlipResult alone = Flip(mesh, MakeCanonical());
  const PartsResult expected = FlipHere(mesh, GetParam(), MakeCanonical());
  ASSERT_LT(0, alone.Report.InsertedConstraints);
  ExpectAsAlone(mesh, MakeCanonical(), expected);
  EXPECT_EQ(alone.Report.ConstraintFlips, expected.Report.ConstraintFlips);
  for (const double end : { 0.0, 0.3, 0.6, 0.95 })
  {
    double last = 0.0;
    const ProgressObserver observer = [&](double share)
    {
      EXPECT_LE(last, share);
      EXPECT_GE(1.0, share);
      last = share;
      return share < end;
    };
    const PartsResult stopped = FlipHere(mesh, GetParam(), MakeCanonical(), observer);
    EXPECT_TRUE(stopped.Report.StopReason == StopReasonKind::Aborted ||
      expected.Triangles == stopped.Triangles);
    EXPECT_TRUE(end > 0.0 || owned.Triangles == stopped.Triangles);
    EXPECT_EQ(1, EulerCharacteristic(ViewTriangles(stopped.Triangles)));
    last = 0.0;
    FlipSession session(mesh, MakeCanonical(GetParam()), observer);
    session.Advance(-1, {}, [&](double share) { return share < end; });
    session.Advance();
    EXPECT_TRUE(session.GetReport().Converged());
    EXPECT_EQ(ToTriangleSet(alone.Triangles), ToTriangleSet(StoreTriangles(session)));
    EXPECT_EQ(session.GetReport().TotalFlips + session.GetReport().ConstraintFlips,
      SumFlips(StoreFlipCounts(session)));
  }
}

TEST_P(PartsTest, SessionsGiveTheSame)
{
  for (const Mesh& mesh : { MakeRandomBadMeshDouble(2000, 61), MakeBadSphere(40, 20, 62) })
  {
    FlipOptions options = KeepTies();
    const PartsResult expected = FlipHere(mesh.View(), GetParam(), options);
    options.NumberOfPieces = GetParam();
    FlipSession session(mesh.View(), options);
    EXPECT_EQ(mesh.NumberOfPoints(), session.GetReport().Points);
    EXPECT_EQ(expected.Report.GeometryUsed, session.GetReport().GeometryUsed);
    EXPECT_EQ(expected.Report.Tolerance, session.GetReport().Tolerance);
    EXPECT_EQ(mesh.Triangles, StoreTriangles(session));
    EXPECT_EQ(std::vector<std::int32_t>(mesh.NumberOfTriangles()), StoreFlipCounts(session));
    EXPECT_TRUE(session.Advance(0));
    std::int64_t iterations = 0;
    session.Advance(-1, [&](const IterationRecord& row) { return row.Iteration == ++iterations; });
    EXPECT_EQ(iterations, static_cast<std::int64_t>(session.GetReport().Iterations.size()));
    EXPECT_EQ(expected.Triangles, StoreTriangles(session));
    EXPECT_FALSE(session.Advance());
    if (GetParam() > 1) // else the session is that of a whole mesh, with all its angles
    {
      ExpectSameStatistics(expected.Report, session.GetReport());
    }

    std::vector<std::int64_t> ids(mesh.Triangles.begin(), mesh.Triangles.end());
    TriangleMesh wide = mesh.View();
    wide.Triangles = TriangleArray(ids.data(), wide.Triangles.Count);
    FlipToDelaunay(wide, options, MutableTriangleArray(ids.data(), wide.Triangles.Count));
    EXPECT_TRUE(std::equal(ids.begin(), ids.end(), expected.Triangles.begin()));
  }
}

TEST_P(PartsTest, ErrorsChangeNothing)
{
  Mesh mesh = MakeRandomBadMeshDouble(100, 55);
  std::vector<std::int32_t> output(mesh.Triangles.size(), -5);
  const MutableTriangleArray triangles(output.data(), mesh.NumberOfTriangles());
  const std::int32_t good = mesh.Triangles[100];
  mesh.Triangles[100] = 77777;
  EXPECT_THROW(FlipInPieces(mesh.View(), MakeCanonical(GetParam()), triangles), InvalidMesh);
  EXPECT_THROW(FlipToDelaunay(mesh.View(), MakeCanonical(GetParam()), triangles), InvalidMesh);
  mesh.Triangles[100] = good;
  FlipOptions wrong = MakeCanonical(GetParam());
  wrong.Geometry = GeometryKind::Surface;
  EXPECT_THROW(FlipInPieces(mesh.View(), wrong, triangles), InvalidOptions);
  EXPECT_EQ(std::vector<std::int32_t>(output.size(), -5), output);
}

INSTANTIATE_TEST_SUITE_P(
  Pieces, PartsTest, testing::Values(1, 2, 3, 7, 16), testing::PrintToStringParamName());

TEST(NumberOfPieces, IsFrom1To255)
{
  const Mesh mesh = MakeRandomBadMeshDouble(20, 57);
  for (const int pieces : { -1, 256 })
  {
    EXPECT_THROW(FlipHere(mesh.View(), pieces, {}), InvalidOptions);
    EXPECT_THROW(FlipSession(mesh.View(), MakeCanonical(pieces)), InvalidOptions);
  }
  FlipHere(mesh.View(), 255, {});
}

/// Other sessions from triangles have regions, and move.
TEST(NumberOfPieces, IsNamedByRefusals)
{
  const Mesh mesh = MakeRandomBadMeshDouble(20, 57);
  FlipSession session(mesh.View(), MakeCanonical(2));
  const std::string why = GetMessage<InvalidOptions>([&] { session.StoreRegions(nullptr); });
  EXPECT_NE(std::string::npos, why.find("several pieces")) << why;
  EXPECT_EQ(why, GetMessage<InvalidOptions>([&] { session.Move({}); }));
}

TEST(NumberOfPieces, IsTheSmallestThatIsPossibleByDefault)
{
  constexpr std::int64_t most = 715827882;
  EXPECT_EQ(1, CountPieces({}, 0));
  EXPECT_EQ(1, CountPieces({}, most));
  EXPECT_EQ(2, CountPieces({}, most + 1));
  EXPECT_EQ(3, CountPieces({}, 2 * most));
  EXPECT_EQ(7, CountPieces(MakeCanonical(7), 2 * most));
  EXPECT_EQ(1, CountPieces(MakeCanonical(1), 2 * most));
  EXPECT_THROW(CountPieces(MakeCanonical(2), 2 * most), MeshTooLarge);
}

}
}
