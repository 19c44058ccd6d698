// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "EngineJudge.h"

#include "ExactRest.h"
#include "FlipTestSupport.h"
#include "MeshAudit.h"
#include "References.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <utility>

namespace delaunayflip
{
namespace
{

FlipOptions WithThreads(FlipOptions options, int threads)
{
  options.NumberOfThreads = threads;
  return options;
}

/// Advances `step` iterations at a time; -1: all at once.
FlipResult FlipInSteps(const TriangleMesh& mesh, const FlipOptions& options, std::int64_t step)
{
  FlipResult result;
  result.Triangles.resize(static_cast<std::size_t>(3 * mesh.Triangles.Count));
  result.FlipCounts.resize(static_cast<std::size_t>(mesh.Triangles.Count));
  FlipSession session(mesh, options);
  while (session.Advance(step))
  {
  }
  session.StoreTriangles(MutableTriangleArray(result.Triangles.data(), mesh.Triangles.Count));
  session.StoreFlipCounts(result.FlipCounts.data());
  result.Report = session.GetReport();
  return result;
}

/// The engine may refuse options only if they do not suit the mesh.
std::optional<FlipResult> TryToFlip(
  const TriangleMesh& mesh, const FlipOptions& options, std::int64_t step = -1)
{
  try
  {
    return FlipInSteps(mesh, options, step);
  }
  catch (const InvalidOptions& error)
  {
    EXPECT_TRUE(
      options.Geometry == GeometryKind::Planar || options.TieRule == TieRuleKind::Canonical)
      << error.what();
    return std::nullopt;
  }
}

void ExpectSameResult(const FlipResult& a, const std::optional<FlipResult>& b)
{
  ASSERT_TRUE(b.has_value());
  EXPECT_EQ(a.Triangles, b->Triangles);
  EXPECT_EQ(a.FlipCounts, b->FlipCounts);
  ExpectSameStatistics(a.Report, b->Report);
}

void ExpectUntouchedTrianglesStay(const TriangleMesh& mesh, const FlipResult& result)
{
  std::int64_t touches = 0;
  for (std::int64_t t = 0; t < mesh.Triangles.Count; ++t)
  {
    touches += result.FlipCounts[t];
    for (int slot = 0; result.FlipCounts[t] == 0 && slot < 3; ++slot)
    {
      EXPECT_EQ(mesh.Triangles.Get(t, slot), result.Triangles[3 * t + slot]) << "triangle " << t;
    }
  }
  EXPECT_EQ(2 * result.Report.TotalFlips, touches);
}

/// Whether edges are judged exactly, without rounding.
bool IsExact(const FlipOptions& options, const FlipReport& report)
{
  return report.GeometryUsed != GeometryKind::Surface &&
    options.Criterion == CriterionKind::InCircle;
}

void ExpectRightStop(const FlipOptions& options, const FlipReport& report)
{
  if (options.MaximumIterations < 0)
  {
    // With a fixed tolerance flips may cycle (Documentation/method.md).
    const bool mayCycle = !IsExact(options, report) && options.Tolerance >= 0.0;
    EXPECT_TRUE(report.Converged() || mayCycle) << ToString(report.StopReason);
    return;
  }
  EXPECT_LE(static_cast<std::int64_t>(report.Iterations.size()), options.MaximumIterations);
  EXPECT_TRUE(report.Converged() || report.StopReason == StopReasonKind::IterationLimit);
}

/// Larger meshes would take seconds in rational arithmetic.
constexpr std::int64_t MostExactTriangles = 400;

/// The constraints that are edges of a mesh. Others fix no edge, even one that flips create.
std::vector<std::int64_t> FindConstraintEdges(const EngineCase& drawn)
{
  std::vector<std::int64_t> found;
  for (std::size_t i = 0; i < drawn.Constraints.size(); i += 2)
  {
    const std::int64_t p = drawn.Constraints[i];
    const std::int64_t q = drawn.Constraints[i + 1];
    if (HasEdge(drawn.Triangles, p, q))
    {
      found.insert(found.end(), { p, q });
    }
  }
  return found;
}

bool IsLevel(const TriangleMesh& mesh)
{
  for (std::int64_t i = 1; i < mesh.Points.Count; ++i)
  {
    if (mesh.Points.Get(i, 2) != mesh.Points.Get(0, 2))
    {
      return false;
    }
  }
  return true;
}

/// The bad edges left must be those that the audit and exact arithmetic find.
void ExpectRightRest(const EngineCase& drawn, const TriangleMesh& after, const FlipReport& report)
{
  FlipOptions options = drawn.Options;
  options.Geometry = report.GeometryUsed;
  const bool isExact = IsExact(options, report);
  if (isExact)
  {
    const std::int64_t audited = CountNonDelaunayEdges(after, options);
    EXPECT_LE(audited, report.NonDelaunayAfter);
    // The audit does not count ties.
    EXPECT_TRUE(audited == report.NonDelaunayAfter || options.TieRule == TieRuleKind::Canonical);
  }
  // Feature edges are found in the input; the output does not show which edges they were.
  const bool isKnown = options.Geometry == GeometryKind::Surface
    ? options.FeatureAngle == 180.0
    : options.Geometry == GeometryKind::PlanarXY || IsLevel(after);
  if (isKnown && after.Triangles.Count <= MostExactTriangles)
  {
    const RestBounds rest = BoundRest(after, options, options.Geometry);
    EXPECT_LE(rest.Certain, report.NonDelaunayAfter);
    EXPECT_GE(rest.Possible, report.NonDelaunayAfter);
  }
}

/// The smallest angle must be the one that the audit measures.
void ExpectRightAngle(const EngineCase& drawn, const TriangleMesh& after, const FlipReport& report)
{
  const bool isFinite = std::all_of(
    drawn.Points.begin(), drawn.Points.end(), [](double x) { return std::isfinite(x); });
  const double measured = MinimumAngle(after, report.GeometryUsed);
  // Numbers too large for float become infinite; then no triangle has an angle.
  if (isFinite && !(std::isnan(measured) && std::isnan(report.MinimumAngleAfter)))
  {
    EXPECT_NEAR(measured, report.MinimumAngleAfter, 1e-6);
  }
}

/// A clean mesh must stay a triangulation without overlaps and become Delaunay.
void ExpectDelaunay(const EngineCase& drawn, const TriangleMesh& after, const FlipResult& result)
{
  if (!drawn.IsClean || after.Triangles.Count > MostExactTriangles)
  {
    return;
  }
  const TriangleTurns turns = CountTurns(after);
  EXPECT_EQ(0, turns.Right + turns.Straight);
  if (!IsExact(drawn.Options, result.Report) || !result.Report.Converged())
  {
    return;
  }
  EXPECT_EQ(0, result.Report.NonDelaunayAfter);
  if (drawn.Constraints.empty() && drawn.Regions.empty() && drawn.Frozen.empty())
  {
    EXPECT_EQ(0, CountRationalViolations(after));
  }
}

/// With canonical ties the mesh must be Lawson's, triangle for triangle.
void ExpectLawsonsMesh(const EngineCase& drawn, const TriangleMesh& after, const FlipResult& result)
{
  const bool applies = drawn.IsClean && IsExact(drawn.Options, result.Report) &&
    drawn.Options.TieRule == TieRuleKind::Canonical && result.Report.Converged() &&
    drawn.Regions.empty() && drawn.Frozen.empty() && drawn.Triangles.size() <= 120;
  if (!applies)
  {
    return;
  }
  OwnedMesh<double> mesh = { drawn.Points, drawn.Triangles };
  std::set<VertexPair> constraints;
  for (std::int64_t i = 0; i < after.NumberOfConstraintEdges; ++i)
  {
    constraints.insert(
      std::minmax({ after.ConstraintEdges[2 * i], after.ConstraintEdges[2 * i + 1] }));
  }
  FlipByLawson(mesh, constraints, TieRuleKind::Canonical);
  EXPECT_EQ(ToTriangleSet(mesh.Triangles), ToTriangleSet(result.Triangles));
}

/// Doubling the coordinates is exact, so it must not change the triangles.
void ExpectSameWhenDoubled(const EngineCase& drawn, const FlipResult& result)
{
  const double largest = drawn.HasFloats ? 1e38 : 8e307;
  EngineCase doubled = drawn;
  for (double& coordinate : doubled.Points)
  {
    if (std::isfinite(coordinate) && std::abs(coordinate) > largest)
    {
      return;
    }
    coordinate *= 2.0;
  }
  const EngineInput input(doubled);
  const std::optional<FlipResult> other = TryToFlip(input.View(), WithThreads(drawn.Options, 1));
  ASSERT_TRUE(other.has_value());
  EXPECT_EQ(result.Triangles, other->Triangles);
  EXPECT_EQ(result.Report.NonDelaunayAfter, other->Report.NonDelaunayAfter);
}

template <typename Number>
bool AreSameBytes(const std::vector<Number>& a, const std::vector<Number>& b)
{
  return a.size() == b.size() &&
    (a.empty() ||
      std::equal(reinterpret_cast<const char*>(a.data()),
        reinterpret_cast<const char*>(a.data() + a.size()),
        reinterpret_cast<const char*>(b.data())));
}

void ExpectSameInput(const EngineCase& before, const EngineCase& after)
{
  EXPECT_TRUE(AreSameBytes(before.Points, after.Points));
  EXPECT_EQ(before.Triangles, after.Triangles);
  EXPECT_EQ(before.Constraints, after.Constraints);
  EXPECT_EQ(before.Regions, after.Regions);
  EXPECT_EQ(before.Frozen, after.Frozen);
}

}

void JudgeEngineCase(const EngineCase& drawn)
{
  const EngineCase copy = drawn;
  const EngineInput input(drawn);
  const TriangleMesh mesh = input.View();
  const std::optional<FlipResult> result = TryToFlip(mesh, WithThreads(drawn.Options, 1));
  const int threads = 2 + static_cast<int>(drawn.Triangles.size() % 3);
  const std::optional<FlipResult> other = TryToFlip(mesh, WithThreads(drawn.Options, threads));
  ASSERT_EQ(result.has_value(), other.has_value());
  if (!result)
  {
    return;
  }
  ExpectSameResult(*result, other);
  ExpectSameResult(*result, TryToFlip(mesh, WithThreads(drawn.Options, 1), 1));
  ExpectSameInput(copy, drawn);
  ExpectSameTopology(mesh.Triangles, result->Triangles, result->Report);
  ExpectUntouchedTrianglesStay(mesh, *result);
  ExpectConsistentStatistics(result->Report);
  ExpectRightStop(drawn.Options, result->Report);
  TriangleMesh after = WithTriangles(mesh, result->Triangles);
  const std::vector<std::int64_t> constraints = FindConstraintEdges(drawn);
  after.ConstraintEdges = constraints.data();
  after.NumberOfConstraintEdges = static_cast<std::int64_t>(constraints.size()) / 2;
  ExpectRightRest(drawn, after, result->Report);
  ExpectRightAngle(drawn, after, result->Report);
  ExpectDelaunay(drawn, after, *result);
  ExpectLawsonsMesh(drawn, after, *result);
  ExpectSameWhenDoubled(drawn, *result);
}

}
