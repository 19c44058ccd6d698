// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FuzzTarget.h"

#include "EngineCase.h"
#include "FlipTestSupport.h"
#include "MeshAudit.h"
#include "References.h"

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

/// @file
/// The engine as a target for fuzzers: the bad edges that exact arithmetic expects to be left, and
/// the judgement of a case.

namespace delaunayflip
{
namespace
{

/// Bounds on the number of bad edges that a run must leave. They differ by the edges with an angle
/// sum within rounding of the tolerance.
struct RestBounds
{
  std::int64_t Certain = 0, Possible = 0;
};

using Real = boost::multiprecision::number<
  boost::multiprecision::cpp_bin_float<300, boost::multiprecision::digit_base_2>,
  boost::multiprecision::et_off>;
using RealVector = std::array<Real, 3>;

/// a, p, q, b: triangles (a, p, q) and (b, q, p).
using QuadCorners = std::array<Point3, 4>;

RealVector Subtract(const Point3& p, const Point3& q)
{
  return { Real(p[0]) - q[0], Real(p[1]) - q[1], Real(p[2]) - q[2] };
}

Real Dot(const RealVector& a, const RealVector& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// An angle as cosine and sine, and the lengths of its legs.
struct ExactAngle
{
  ExactAngle(const Point3& apex, const Point3& p, const Point3& q)
  {
    const RealVector u = Subtract(p, apex), v = Subtract(q, apex);
    const RealVector n = { u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
      u[0] * v[1] - u[1] * v[0] };
    this->First = sqrt(Dot(u, u));
    this->Second = sqrt(Dot(v, v));
    this->Cosine = Dot(u, v);
    this->Sine = sqrt(Dot(n, n));
    if (this->HasLegs())
    {
      this->Cosine /= this->First * this->Second;
      this->Sine /= this->First * this->Second;
    }
  }

  bool HasLegs() const { return this->First > 0 && this->Second > 0; }

  Real Cosine, Sine, First, Second;
};

/// Judges opposite-angle sums.
class AngleCriterion
{
public:
  AngleCriterion(double tolerance, double precision)
    : Tolerance(tolerance),
      Precision(precision)
  {
  }

  /// @returns whether the sum certainly exceeds pi plus the tolerance, and whether it may.
  std::pair<bool, bool> Judge(const QuadCorners& apqb) const
  {
    const ExactAngle a(apqb[0], apqb[1], apqb[2]);
    const ExactAngle b(apqb[3], apqb[1], apqb[2]);
    if (!a.HasLegs() || !b.HasLegs())
    {
      return { false, false };
    }
    // In double: sums with a relative error of 1e-12 suffice from here on.
    const auto sine = static_cast<double>(a.Sine * b.Cosine + a.Cosine * b.Sine);
    const auto cosine = static_cast<double>(a.Cosine * b.Cosine - a.Sine * b.Sine);
    const double sum = std::atan2(sine, cosine);
    const bool isObtuse = a.Cosine < 0 && b.Cosine < 0;
    // atan2 gives -pi to pi; the sum is in 0 .. 2 pi.
    const double excess = isObtuse || sum < 0.0 ? (sum > 0.0 ? sum - Pi : sum + Pi) : sum - Pi;
    const double limit = this->GetLimit(a, b, apqb);
    const double margin = 1e-9 * std::max(std::min(1.0, limit), 1e-5);
    return { excess > limit + margin, excess > limit - margin };
  }

private:
  static constexpr double Pi = 3.14159265358979323846;

  /// The tolerance of a quad in radians; Documentation/method.md has the automatic one.
  double GetLimit(const ExactAngle& a, const ExactAngle& b, const QuadCorners& apqb) const
  {
    if (this->Tolerance >= 0.0)
    {
      return this->Tolerance;
    }
    Real farthest = 0;
    for (const Point3& point : apqb)
    {
      farthest = std::max(farthest, Real(sqrt(Dot(Subtract(point, {}), Subtract(point, {})))));
    }
    const Real reciprocals = 1 / a.First + 1 / a.Second + 1 / b.First + 1 / b.Second;
    const auto sine = static_cast<double>(2 * this->Precision * farthest * reciprocals) + 0x1p-47;
    return sine < 1.0 ? std::asin(sine) : 2.0 * Pi;
  }

  double Tolerance;
  double Precision;
};

std::set<VertexPair> ListConstraints(const TriangleMesh& mesh)
{
  return ToEdges({ mesh.ConstraintEdges, mesh.ConstraintEdges + 2 * mesh.NumberOfConstraintEdges });
}

/// Counts the edges of a mesh that are bad and not fixed, in rational arithmetic for the in-circle
/// criterion and with 300 bits for angles. Independent of the engine.
class RestJudge
{
public:
  /// @param mesh with those constraints that are edges of it.
  /// @param geometry PlanarXY; Planar if z is the same for all points; or Surface, without feature
  /// edges.
  RestJudge(const TriangleMesh& mesh, const FlipOptions& options, GeometryKind geometry)
    : Mesh(mesh),
      Options(options),
      IsPlane(geometry != GeometryKind::Surface),
      HasDepth(geometry != GeometryKind::PlanarXY),
      Angles(options.Tolerance, mesh.Points.Floats ? 0x1p-23 : 0x1p-52),
      Constraints(ListConstraints(mesh))
  {
  }

  RestBounds Count() const
  {
    RestBounds bounds;
    for (const auto& [ends, triangles] : CollectEdges(this->Mesh.Triangles))
    {
      if (triangles.size() != 2 || this->Constraints.count(ends) != 0 ||
        !this->IsTouchable(triangles[0]) || !this->IsTouchable(triangles[1]))
      {
        continue;
      }
      const EdgeSide first = this->FindSide(triangles[0], ends);
      const EdgeSide second = this->FindSide(triangles[1], ends);
      const std::int32_t* regions = this->Mesh.Regions;
      const bool isBorder = regions && regions[triangles[0]] != regions[triangles[1]];
      if (!isBorder && first.Upwards != second.Upwards && first.Opposite != second.Opposite)
      {
        const auto [a, b] = first.Upwards ? std::pair(first, second) : std::pair(second, first);
        const auto [certain, possible] = this->Judge({ this->Get(a.Opposite), this->Get(ends.first),
          this->Get(ends.second), this->Get(b.Opposite) });
        bounds.Certain += certain;
        bounds.Possible += possible;
      }
    }
    return bounds;
  }

private:
  struct EdgeSide
  {
    std::int64_t Opposite;
    bool Upwards; ///< Whether the half-edge runs from the smaller id to the larger.
  };

  /// What a triangle of three points has at its edge with these ends.
  EdgeSide FindSide(std::int64_t t, const VertexPair& ends) const
  {
    const TriangleArray& triangles = this->Mesh.Triangles;
    int slot = 0;
    while (triangles.Get(t, slot) == ends.first || triangles.Get(t, slot) == ends.second)
    {
      ++slot;
    }
    return { triangles.Get(t, slot), triangles.Get(t, (slot + 1) % 3) == ends.first };
  }

  Point3 Get(std::int64_t id) const
  {
    const PointArray& points = this->Mesh.Points;
    return { points.Get(id, 0), points.Get(id, 1), this->HasDepth ? points.Get(id, 2) : 0.0 };
  }

  bool IsTouchable(std::int64_t t) const
  {
    const std::int64_t ids[] = { this->Mesh.Triangles.Get(t, 0), this->Mesh.Triangles.Get(t, 1),
      this->Mesh.Triangles.Get(t, 2) };
    const bool repeats = ids[0] == ids[1] || ids[1] == ids[2] || ids[2] == ids[0];
    const bool frozen = this->Mesh.FrozenTriangles && this->Mesh.FrozenTriangles[t] != 0;
    return !repeats && !frozen &&
      std::all_of(ids, ids + 3, [this](std::int64_t id) { return this->IsFinite(id); });
  }

  bool IsFinite(std::int64_t id) const
  {
    const Point3 point = this->Get(id);
    return std::isfinite(point[0]) && std::isfinite(point[1]) && std::isfinite(point[2]);
  }

  std::pair<bool, bool> Judge(const QuadCorners& apqb) const
  {
    if (!this->IsPlane)
    {
      return this->Angles.Judge(apqb);
    }
    const auto& [a, p, q, b] = apqb;
    const int upper = RationalTurn(a, p, q), lower = RationalTurn(b, q, p);
    if (upper == 0 && lower == 0)
    {
      return this->JudgeFlat(apqb);
    }
    const int turn = upper + lower; // 0 if the triangles have opposite orientations
    if (this->Options.Criterion == CriterionKind::OppositeAngles)
    {
      return turn == 0 ? std::make_pair(false, false) : this->Angles.Judge(apqb);
    }
    const int inCircle = RationalInCircle(a, p, q, b);
    const bool isCanonical = this->Options.TieRule == TieRuleKind::Canonical;
    const bool isBad = inCircle == 0 && std::abs(turn) == 2 && isCanonical
      ? std::max(a, b) < std::max(p, q)
      : turn * inCircle > 0;
    return { isBad, isBad };
  }

  /// Judges a quad without area: bad if the flip would make a shorter edge within the edge.
  std::pair<bool, bool> JudgeFlat(const QuadCorners& apqb) const
  {
    const auto edge = std::minmax(apqb[1], apqb[2]);
    const auto made = std::minmax(apqb[0], apqb[3]);
    const bool spans = edge.first <= made.first && made.second <= edge.second && edge != made;
    const bool byAngles = this->Options.Criterion == CriterionKind::OppositeAngles;
    const auto [certain, possible] =
      byAngles ? this->Angles.Judge(apqb) : std::make_pair(true, true);
    return { spans && certain, spans && possible };
  }

  const TriangleMesh& Mesh;
  const FlipOptions& Options;
  bool IsPlane;
  bool HasDepth; ///< Whether z is used.
  AngleCriterion Angles;
  std::set<VertexPair> Constraints;
};

/// The engine may refuse options only if they do not suit the mesh.
std::optional<FlipResult> TryToFlip(const TriangleMesh& mesh, const FlipOptions& options)
{
  try
  {
    return FlipInSteps(mesh, options);
  }
  catch (const InvalidOptions& error)
  {
    EXPECT_TRUE(
      options.Geometry == GeometryKind::Planar || options.TieRule == TieRuleKind::Canonical)
      << error.what();
    return std::nullopt;
  }
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
    const RestBounds rest = RestJudge(after, options, options.Geometry).Count();
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
  FlipByLawson(mesh, ListConstraints(after), TieRuleKind::Canonical);
  EXPECT_EQ(ToTriangleSet(mesh.Triangles), ToTriangleSet(result.Triangles));
}

/// Doubling the coordinates is exact, so it must not change the triangles.
void ExpectSameWhenDoubled(const EngineCase& drawn, const FlipResult& result)
{
  const double largest = drawn.HasFloats ? 1e38 : 8e307;
  EngineCase doubled = drawn;
  doubled.Options.MaximumDeviation *= 2.0;
  for (double& coordinate : doubled.Points)
  {
    if (std::isfinite(coordinate) && std::abs(coordinate) > largest)
    {
      return;
    }
    coordinate *= 2.0;
  }
  const EngineInput input(doubled);
  const std::optional<FlipResult> other = TryToFlip(input.View(), WithThreads(1, doubled.Options));
  ASSERT_TRUE(other.has_value());
  EXPECT_EQ(result.Triangles, other->Triangles);
  EXPECT_EQ(result.Report.NonDelaunayAfter, other->Report.NonDelaunayAfter);
}

/// With all bits of its numbers.
std::string Describe(const EngineCase& drawn)
{
  std::ostringstream text;
  Print(drawn, text);
  return text.str();
}

/// Runs a case and reports a failure of GoogleTest for each promise of the engine that is broken:
///
/// - one thread, several, and a session that advances step by step give the same bits;
/// - the caller's arrays stay as they are;
/// - edges by kind, the Euler characteristic and triangles that no flip touched stay;
/// - the statistics add up, and the loop ends by itself;
/// - the bad edges left are those that the audit finds and, in x and y, those that rational
///   arithmetic finds;
/// - a triangulation without overlaps stays one; if no edge is fixed or blocked, it becomes
///   Delaunay, and with canonical ties it is that of Lawson's algorithm in rational arithmetic.
void JudgeEngineCase(const EngineCase& drawn)
{
  const std::string before = Describe(drawn);
  const EngineInput input(drawn);
  const TriangleMesh mesh = input.View();
  const std::optional<FlipResult> result = TryToFlip(mesh, WithThreads(1, drawn.Options));
  const int threads = 2 + static_cast<int>(drawn.Triangles.size() % 3);
  const std::optional<FlipResult> other = TryToFlip(mesh, WithThreads(threads, drawn.Options));
  ASSERT_EQ(result.has_value(), other.has_value());
  if (!result)
  {
    return;
  }
  ExpectSameResult(*result, *other);
  ExpectSameResult(*result, FlipInSteps(mesh, WithThreads(1, drawn.Options), 1));
  EXPECT_EQ(before, Describe(drawn));
  ExpectSameTopology(mesh.Triangles, result->Triangles, result->Report);
  ExpectUntouchedTrianglesStay(mesh, *result);
  ExpectConsistentStatistics(result->Report);
  ExpectRightStop(drawn.Options, result->Report);
  const std::vector<std::int64_t> constraints = FindConstraintEdges(drawn);
  const TriangleMesh after = WithConstraints(WithTriangles(mesh, result->Triangles), constraints);
  ExpectRightRest(drawn, after, result->Report);
  ExpectRightAngle(drawn, after, result->Report);
  ExpectDelaunay(drawn, after, *result);
  ExpectLawsonsMesh(drawn, after, *result);
  ExpectSameWhenDoubled(drawn, *result);
}

}
}

using namespace delaunayflip;

void SetUpTarget(int* argc, char** argv)
{
  testing::InitGoogleTest(argc, argv);
  testing::GTEST_FLAG(throw_on_failure) = true;
}

void RunTarget(const std::uint8_t* bytes, std::size_t size)
{
  JudgeEngineCase(MakeEngineCase(bytes, size));
}

void PrintTarget(const std::uint8_t* bytes, std::size_t size)
{
  Print(MakeEngineCase(bytes, size), std::cout);
}
