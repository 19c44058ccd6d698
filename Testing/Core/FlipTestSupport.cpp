// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FlipTestSupport.h"

#include "MeshAudit.h"
#include "TestBackend.h"
#include "TriangleAngles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

namespace delaunayflip
{

TriangleSet ToTriangleSet(const TriangleArray& triangles)
{
  TriangleSet set;
  for (std::int64_t t = 0; t < triangles.Count; ++t)
  {
    std::array<std::int64_t, 3> ids = { triangles.Get(t, 0), triangles.Get(t, 1),
      triangles.Get(t, 2) };
    std::rotate(ids.begin(), std::min_element(ids.begin(), ids.end()), ids.end());
    set.push_back(ids);
  }
  std::sort(set.begin(), set.end());
  return set;
}

TriangleSet ToTriangleSet(const std::vector<std::int32_t>& triangles)
{
  return ToTriangleSet(ViewTriangles(triangles));
}

std::vector<std::int32_t> ToIds(const TriangleSet& triangles)
{
  std::vector<std::int32_t> ids;
  for (const auto& triangle : triangles)
  {
    ids.insert(ids.end(), triangle.begin(), triangle.end());
  }
  return ids;
}

FlipOptions OnTestBackend(FlipOptions options)
{
  if (options.Backend == BackendKind::Auto && IsTestBackendCuda())
  {
    options.Backend = BackendKind::CUDA;
  }
  return options;
}

namespace
{

/// Calls run(options) on the test's backend. If a GPU that the test itself did not force lacks the
/// arithmetic for the coordinates, the CPU takes over. Any other failure of it fails the test.
template <typename Run>
auto RunOnTestBackend(const FlipOptions& options, const Run& run)
{
  try
  {
    return run(OnTestBackend(options));
  }
  catch (const BackendUnavailable& error)
  {
    if (options.Backend != BackendKind::Auto || std::string(error.what()) != BeyondDevice().what())
    {
      throw;
    }
  }
  return run(OnBackend(BackendKind::Threads, options));
}

}

FlipSession MakeSession(const TriangleMesh& mesh, const FlipOptions& options)
{
  return RunOnTestBackend(
    options, [&](const FlipOptions& chosen) { return FlipSession(mesh, chosen); });
}

FlipSession FlipPoints(const PointInput& points, const PointOptions& options)
{
  return RunOnTestBackend(options,
    [&](const FlipOptions& chosen)
    {
      PointOptions onBackend = options;
      static_cast<FlipOptions&>(onBackend) = chosen;
      FlipSession session(points, onBackend);
      session.Advance();
      return session;
    });
}

FlipResult Flip(const TriangleMesh& mesh, const FlipOptions& options)
{
  return RunOnTestBackend(
    options, [&](const FlipOptions& chosen) { return FlipInSteps(mesh, chosen); });
}

FlipResult FlipInSteps(const TriangleMesh& mesh, const FlipOptions& options, std::int64_t step)
{
  FlipSession session(mesh, options);
  while (session.Advance(step))
  {
  }
  return { StoreTriangles(session), StoreFlipCounts(session), session.GetReport() };
}

std::vector<std::int32_t> StoreTriangles(const FlipSession& session)
{
  const std::int64_t count = session.GetReport().Triangles;
  std::vector<std::int32_t> triangles(3 * count);
  session.StoreTriangles(MutableTriangleArray(triangles.data(), count));
  return triangles;
}

std::vector<std::int32_t> StoreOrderedTriangles(const FlipSession& session)
{
  const std::int64_t count = session.GetReport().Triangles;
  std::vector<std::int32_t> triangles(3 * count);
  session.StoreOrderedTriangles(MutableTriangleArray(triangles.data(), count));
  return triangles;
}

std::vector<std::int32_t> StoreFlipCounts(const FlipSession& session)
{
  std::vector<std::int32_t> counts(session.GetReport().Triangles, -1);
  session.StoreFlipCounts(counts.data());
  return counts;
}

namespace
{

/// Both NaN, or close.
void ExpectNearAngle(double expected, double angle)
{
  EXPECT_EQ(expected != expected, angle != angle) << expected << " and " << angle;
  EXPECT_FALSE(std::abs(expected - angle) > 1e-6) << expected << " and " << angle;
}

}

void ExpectSmallAngles(
  const TriangleMesh& mesh, GeometryKind geometry, const std::array<std::int64_t, 3>& below10To30)
{
  std::vector<double> angles(mesh.Triangles.Count);
  FindSmallestAngles(mesh, geometry, 1, angles.data());
  for (int i = 0; i < 3; ++i)
  {
    constexpr double Rounding = 1e-6;
    const double limit = 10.0 * (i + 1);
    const auto countBelow = [&](double degrees)
    {
      return std::count_if(
        angles.begin(), angles.end(), [degrees](double angle) { return angle < degrees; });
    };
    EXPECT_GE(below10To30[i], countBelow(limit - Rounding)) << limit;
    EXPECT_LE(below10To30[i], countBelow(limit + Rounding)) << limit;
  }
}

FlipResult FlipAndAudit(const TriangleMesh& mesh, const FlipOptions& options)
{
  FlipResult result = Flip(mesh, options);
  const FlipReport& report = result.Report;
  FlipOptions audit = options;
  audit.Geometry = report.GeometryUsed; // flips may change what Auto chooses
  const TriangleMesh after = WithTriangles(mesh, result.Triangles);
  EXPECT_TRUE(report.Converged());
  EXPECT_EQ(report.TotalFlips + report.ConstraintFlips, SumFlips(result.FlipCounts));
  const std::int64_t badBefore = CountNonDelaunayEdges(mesh, audit);
  EXPECT_LE(badBefore, report.NonDelaunayBefore); // which has ties, too, where a rule decides them
  EXPECT_TRUE(badBefore == report.NonDelaunayBefore || audit.TieRule == TieRuleKind::Canonical);
  EXPECT_EQ(CountNonDelaunayEdges(after, audit), report.NonDelaunayAfter);
  ExpectNearAngle(MinimumAngle(mesh, audit.Geometry), report.MinimumAngleBefore);
  ExpectNearAngle(MinimumAngle(after, audit.Geometry), report.MinimumAngleAfter);
  ExpectSmallAngles(mesh, audit.Geometry,
    { report.TrianglesBelow10Before, report.TrianglesBelow20Before,
      report.TrianglesBelow30Before });
  ExpectSmallAngles(after, audit.Geometry,
    { report.TrianglesBelow10After, report.TrianglesBelow20After, report.TrianglesBelow30After });
  ExpectSameTopology(mesh.Triangles, result.Triangles, report);
  ExpectConsistentStatistics(report);
  return result;
}

FlipOptions OnBackend(BackendKind backend, FlipOptions options)
{
  return With(&FlipOptions::Backend, backend, options);
}

FlipOptions OnSurface(double featureAngle)
{
  FlipOptions options;
  options.Geometry = GeometryKind::Surface;
  options.FeatureAngle = featureAngle;
  return options;
}

FlipOptions InPlane(TieRuleKind ties)
{
  FlipOptions options;
  options.Geometry = GeometryKind::PlanarXY;
  options.TieRule = ties;
  return options;
}

OwnedMesh<double> MakeSoup(std::int32_t points, std::int32_t triangles, std::uint32_t seed)
{
  std::mt19937 random(seed);
  OwnedMesh<double> mesh{ std::vector<double>(3 * points),
    std::vector<std::int32_t>(3 * triangles) };
  std::generate(mesh.Points.begin(), mesh.Points.end(), [&] { return DrawIndex(random, 1024); });
  std::generate(
    mesh.Triangles.begin(), mesh.Triangles.end(), [&] { return DrawIndex(random, points); });
  return mesh;
}

OwnedMesh<double> Lift(OwnedMesh<double> mesh, const std::function<double(double, double)>& height)
{
  for (std::size_t i = 0; i < mesh.Points.size(); i += 3)
  {
    mesh.Points[i + 2] = height(mesh.Points[i], mesh.Points[i + 1]);
  }
  return mesh;
}

OwnedMesh<double> MakeWindingFan(int count, double turns, bool closed)
{
  OwnedMesh<double> mesh = { { 0, 0, 0 }, {} };
  for (std::int32_t i = 0; i <= count; ++i)
  {
    const double angle = 6.283185307179586 * turns * i / count;
    mesh.Points.insert(mesh.Points.end(), { std::cos(angle), std::sin(angle), 0.0 });
    if (i < count)
    {
      mesh.Triangles.insert(
        mesh.Triangles.end(), { 0, i + 1, closed && i + 1 == count ? 1 : i + 2 });
    }
  }
  return mesh;
}

OwnedMesh<float> RoundToFloat(const OwnedMesh<double>& mesh)
{
  return { { mesh.Points.begin(), mesh.Points.end() }, mesh.Triangles };
}

TriangleArray ViewTriangles(const std::vector<std::int32_t>& triangles)
{
  return TriangleArray(triangles.data(), static_cast<std::int64_t>(triangles.size()) / 3);
}

TriangleMesh WithTriangles(const TriangleMesh& mesh, const std::vector<std::int32_t>& triangles)
{
  TriangleMesh result = mesh;
  result.Triangles = ViewTriangles(triangles);
  return result;
}

TriangleMesh WithConstraints(
  TriangleMesh mesh, const std::vector<std::int64_t>& ends, const unsigned char* toInsert)
{
  mesh.ConstraintsToInsert = toInsert;
  mesh.ConstraintEdges = ends.data();
  mesh.NumberOfConstraintEdges = static_cast<std::int64_t>(ends.size()) / 2;
  return mesh;
}

std::int64_t SumFlips(const std::vector<std::int32_t>& flipCounts)
{
  return std::accumulate(flipCounts.begin(), flipCounts.end(), std::int64_t(0)) / 2;
}

void ExpectSameTopology(
  const TriangleArray& before, const std::vector<std::int32_t>& after, const FlipReport& report)
{
  const TriangleArray view = ViewTriangles(after);
  const EdgeCounts expected = CountEdges(before);
  for (const EdgeCounts& found : { CountEdges(view), report.Edges })
  {
    EXPECT_EQ(expected.Edges, found.Edges);
    EXPECT_EQ(expected.Boundary, found.Boundary);
    EXPECT_EQ(expected.NonManifold, found.NonManifold);
    EXPECT_EQ(expected.WronglyWound, found.WronglyWound);
  }
  EXPECT_EQ(EulerCharacteristic(before), EulerCharacteristic(view));
  EXPECT_EQ(EulerCharacteristic(before), report.EulerCharacteristic);
  EXPECT_EQ(0, CountDuplicateEdgesGained(before, view));
}

void ExpectConsistentStatistics(const FlipReport& report)
{
  std::int64_t flipped = 0;
  std::int64_t excluded = 0;
  std::int64_t blocked = 0;
  std::int64_t iteration = 0;
  for (const IterationRecord& row : report.Iterations)
  {
    EXPECT_EQ(++iteration, row.Iteration);
    EXPECT_EQ(row.NonDelaunay, row.Flipped + row.Excluded + row.Blocked)
      << "iteration " << row.Iteration;
    EXPECT_GE(row.Tested, 0);
    flipped += row.Flipped;
    excluded += row.Excluded;
    blocked += row.Blocked;
  }
  EXPECT_EQ(flipped, report.TotalFlips);
  EXPECT_EQ(excluded, report.TotalExcluded);
  EXPECT_EQ(blocked, report.TotalBlocked);
  const std::int64_t explained =
    report.BlockedByShape + report.BlockedByDeviation + report.BlockedByEdge;
  EXPECT_TRUE(report.Converged() ? explained == report.NonDelaunayAfter
                                 : explained <= report.NonDelaunayAfter)
    << explained << " of " << report.NonDelaunayAfter;
}

namespace
{

void ExpectSameAngle(double a, double b)
{
  EXPECT_TRUE(a == b || (a != a && b != b)) << a << " and " << b;
}

// The structured bindings below name every member: a new one is an error until it is compared here,
// or left out on purpose.

std::array<std::int64_t, 6> ListCounts(const IterationRecord& row)
{
  const auto& [iteration, tested, nonDelaunay, flipped, excluded, blocked, angle, seconds] = row;
  return { iteration, tested, nonDelaunay, flipped, excluded, blocked };
}

std::array<std::int64_t, 8> ListCounts(const EdgeCounts& counts)
{
  const auto& [edges, boundary, nonManifold, wronglyWound, feature, constraint, region, fixed] =
    counts;
  return { edges, boundary, nonManifold, wronglyWound, feature, constraint, region, fixed };
}

void ExpectSameDefects(const std::vector<Defect>& a, const std::vector<Defect>& b)
{
  ASSERT_EQ(a.size(), b.size()) << DescribeDefects(a) << " and " << DescribeDefects(b);
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    const auto& [kind, count, firstIds, ids, crossed, detail] = b[i];
    EXPECT_TRUE(a[i].IsLike(b[i])) << static_cast<int>(kind) << detail << crossed.size();
    EXPECT_EQ(a[i].Count, count);
    EXPECT_EQ(a[i].FirstIds, firstIds);
    EXPECT_EQ(a[i].Ids, ids);
    EXPECT_EQ(DescribeDefects({ a[i] }), DescribeDefects({ b[i] }));
  }
}

void ExpectSameRows(const std::vector<IterationRecord>& a, const std::vector<IterationRecord>& b)
{
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    EXPECT_EQ(ListCounts(a[i]), ListCounts(b[i]));
    ExpectSameAngle(a[i].MinimumAngle, b[i].MinimumAngle);
  }
}

}

void ExpectSameStatistics(const FlipReport& a, const FlipReport& b)
{
  const auto& [points, triangles, edges, unmatched, inserted, constraintFlips, euler, geometry,
    reason, tolerance, backend, fallback, iterations, flips, excluded, blocked, badBefore, badAfter,
    byShape, byDeviation, byEdge, angleBefore, angleAfter, below10Before, below10After,
    below20Before, below20After, below30Before, below30After, keepsSliver, duplicates, byWinding,
    obtuse, stopReason, fromPoints, buildSeconds, flipSeconds, defects] = b;
  EXPECT_EQ(a.Points, points);
  EXPECT_EQ(a.Triangles, triangles);
  EXPECT_EQ(ListCounts(a.Edges), ListCounts(edges));
  EXPECT_EQ(a.UnmatchedConstraints, unmatched);
  EXPECT_EQ(a.InsertedConstraints, inserted);
  EXPECT_EQ(a.ConstraintFlips, constraintFlips);
  EXPECT_EQ(a.EulerCharacteristic, euler);
  EXPECT_EQ(a.GeometryUsed, geometry);
  EXPECT_EQ(a.GeometryReason, reason);
  EXPECT_EQ(a.Tolerance, tolerance);
  ExpectSameRows(a.Iterations, iterations);
  EXPECT_EQ(a.TotalFlips, flips);
  EXPECT_EQ(a.TotalExcluded, excluded);
  EXPECT_EQ(a.TotalBlocked, blocked);
  EXPECT_EQ(a.NonDelaunayBefore, badBefore);
  EXPECT_EQ(a.NonDelaunayAfter, badAfter);
  EXPECT_EQ(a.BlockedByShape, byShape);
  EXPECT_EQ(a.BlockedByDeviation, byDeviation);
  EXPECT_EQ(a.BlockedByEdge, byEdge);
  ExpectSameAngle(a.MinimumAngleBefore, angleBefore);
  ExpectSameAngle(a.MinimumAngleAfter, angleAfter);
  EXPECT_EQ(a.TrianglesBelow10Before, below10Before);
  EXPECT_EQ(a.TrianglesBelow10After, below10After);
  EXPECT_EQ(a.TrianglesBelow20Before, below20Before);
  EXPECT_EQ(a.TrianglesBelow20After, below20After);
  EXPECT_EQ(a.TrianglesBelow30Before, below30Before);
  EXPECT_EQ(a.TrianglesBelow30After, below30After);
  EXPECT_EQ(a.StopReason, stopReason);
  EXPECT_EQ(a.FromPoints.Repeated, fromPoints.Repeated);
  EXPECT_EQ(a.FromPoints.SegmentEdges, fromPoints.SegmentEdges);
  ExpectSameDefects(a.Defects, defects);
}

void ExpectSameResult(const FlipResult& expected, const FlipResult& actual)
{
  EXPECT_TRUE(expected.Triangles == actual.Triangles);
  EXPECT_TRUE(expected.FlipCounts == actual.FlipCounts);
  ExpectSameStatistics(expected.Report, actual.Report);
  EXPECT_EQ(expected.Report.KeepsSliver, actual.Report.KeepsSliver);
  EXPECT_EQ(expected.Report.HiddenByWinding, actual.Report.HiddenByWinding);
  EXPECT_EQ(expected.Report.ObtuseAtNonManifold, actual.Report.ObtuseAtNonManifold);
}

std::string ExpectInvalidMesh(
  std::int64_t cell, std::int64_t point, const std::function<void()>& run)
{
  try
  {
    run();
    ADD_FAILURE() << "no error";
  }
  catch (const InvalidMesh& error)
  {
    EXPECT_EQ(cell, error.Cell);
    EXPECT_EQ(point, error.Point);
    return error.what();
  }
  return "";
}

std::int64_t CountDefect(const FlipReport& report, const std::string& word)
{
  for (const Defect& defect : report.Defects)
  {
    Defect several = defect;
    several.Count = 2; // the words do not depend on it
    if (DescribeDefects({ several }).find(word) != std::string::npos)
    {
      const bool isPaired = defect.Ids == DefectIds::PointPairs;
      EXPECT_EQ(
        std::min<std::size_t>(3, defect.Count) * (isPaired ? 2 : 1), defect.FirstIds.size());
      EXPECT_TRUE(isPaired || std::is_sorted(defect.FirstIds.begin(), defect.FirstIds.end()));
      return defect.Count;
    }
  }
  return 0;
}

bool HasEdge(const std::vector<std::int32_t>& triangles, std::int64_t p, std::int64_t q)
{
  for (std::size_t corner = 0; corner < triangles.size(); ++corner)
  {
    const std::int64_t from = triangles[corner];
    const std::int64_t to = triangles[corner % 3 == 2 ? corner - 2 : corner + 1];
    if ((from == p && to == q) || (from == q && to == p))
    {
      return true;
    }
  }
  return false;
}

void ReverseTriangles(std::vector<std::int32_t>& triangles)
{
  for (std::size_t corner = 0; corner < triangles.size(); corner += 3)
  {
    std::swap(triangles[corner + 1], triangles[corner + 2]);
  }
}

}
