// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "MeshAudit.h"
#include "References.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

/// @file
/// The automatic tolerance: rounding alone causes no flips, larger errors do.

namespace delaunayflip
{
namespace
{

constexpr double Automatic = -1.0;
constexpr double Fixed = 1e-9;

FlipOptions OfSurfaces(double tolerance)
{
  return With(&FlipOptions::Tolerance, tolerance, OnSurface());
}

template <typename Real>
void ExpectUnchanged(const OwnedMesh<Real>& mesh, const FlipOptions& options)
{
  const FlipResult result = Flip(mesh.View(), options);
  EXPECT_TRUE(mesh.Triangles == result.Triangles);
  EXPECT_EQ(0, result.Report.TotalFlips);
  EXPECT_EQ(0, result.Report.NonDelaunayBefore);
  EXPECT_TRUE(result.Report.Converged());
  EXPECT_EQ("automatic", result.Report.Tolerance);
  EXPECT_EQ(0, CountNonDelaunayEdges(mesh.View(), options));
}

TEST(AutomaticTolerance, LeavesSpheresAsTheyAre)
{
  // A sphere of a hundred metres in UTM coordinates.
  const OwnedMesh<double> sphere = MakeLatLongSphere(300, 100);
  const OwnedMesh<double> far =
    Transform(sphere, { { { 100, 0, 0, 5e5 }, { 0, 100, 0, 4.6e6 }, { 0, 0, 100, 0 } } });
  for (const OwnedMesh<double>& mesh : { sphere, far })
  {
    ExpectUnchanged(mesh, OfSurfaces(Automatic));
    ExpectUnchanged(RoundToFloat(mesh), OfSurfaces(Automatic));
    EXPECT_LT(5000, Flip(RoundToFloat(mesh).View(), OfSurfaces(Fixed)).Report.TotalFlips);
  }
  EXPECT_LT(5000, Flip(sphere.View(), OfSurfaces(0.0)).Report.TotalFlips);
  // What rounding to float would explain is bad if the points are doubles.
  OwnedMesh<double> dented = far;
  dented.Points[3 * 15000] += 0.5;
  EXPECT_LT(0, Flip(dented.View(), OfSurfaces(Automatic)).Report.TotalFlips);
  ExpectUnchanged(RoundToFloat(dented), OfSurfaces(Automatic));
}

/// The engine packs the points of a plane as doubles; their precision is still float.
TEST(AutomaticTolerance, LeavesAPlaneOfFloatsAsItIs)
{
  const OwnedMesh<double> grid = Transform(
    MakeGridMesh(100, 80), { { { 0.3, -0.4, 0, 0 }, { 0.4, 0.3, 0, 0 }, { 0, 0, 0, 0 } } });
  FlipOptions options = OfSurfaces(Automatic);
  options.Criterion = CriterionKind::OppositeAngles;
  const OwnedMesh<float> floats = RoundToFloat(grid);
  const OwnedMesh<double> widened = Transform(floats, ScaleAndMove(1.0, 0.0));
  for (GeometryKind geometry : { GeometryKind::Planar, GeometryKind::PlanarXY })
  {
    options.Geometry = geometry;
    ExpectUnchanged(grid, options);
    ExpectUnchanged(floats, options);
    EXPECT_LT(1000, Flip(widened.View(), options).Report.TotalFlips);
  }
}

/// @param noise the most, in radians, by which the sum of an edge that is left may exceed pi.
template <typename Real>
void ExpectOnlyNoiseStays(const OwnedMesh<Real>& mesh, double noise)
{
  const FlipReport all = Flip(mesh.View(), OfSurfaces(Fixed)).Report;
  const FlipResult result = Flip(mesh.View(), OfSurfaces(Automatic));
  EXPECT_LT(mesh.NumberOfPoints() / 3, all.TotalFlips);
  EXPECT_NEAR(all.TotalFlips, result.Report.TotalFlips, 0.005 * all.TotalFlips);
  const TriangleMesh after = WithTriangles(mesh.View(), result.Triangles);
  EXPECT_EQ(0, CountNonDelaunayEdges(after, OfSurfaces(Automatic)));
  EXPECT_EQ(0, CountNonDelaunayEdges(after, OfSurfaces(noise)));
}

TEST(AutomaticTolerance, LetsABadSurfaceFlip)
{
  const OwnedMesh<double> sphere = MakeBadSphere(400, 200, 71);
  ExpectOnlyNoiseStays(sphere, 1e-9);
  ExpectOnlyNoiseStays(RoundToFloat(sphere), 0.02); // at the poles
}

/// Lattice points are moved further and further from the origin, without rounding. What is noise at
/// one distance is noise at larger ones.
TEST(AutomaticTolerance, GrowsWithTheDistanceFromTheOrigin)
{
  const AffineMap curved = { { { 1024, 0, 0, 0 }, { 0, 1024, 0, 0 }, { 0, 0, 1024, 0 } } };
  OwnedMesh<double> mesh = Transform(MakeLatLongSphere(200, 100), curved);
  for (double& coordinate : mesh.Points)
  {
    coordinate = std::nearbyint(0x1p12 * coordinate) * 0x1p-12;
  }
  std::int64_t before = mesh.NumberOfTriangles();
  for (double offset : { 0.0, 0x1p24, 0x1p30, 0x1p34, 0x1p40 })
  {
    const OwnedMesh<double> moved = Transform(mesh, ScaleAndMove(1.0, offset));
    const std::int64_t bad = CountNonDelaunayEdges(moved.View(), OfSurfaces(Automatic));
    EXPECT_EQ(bad, MakeSession(moved.View(), OfSurfaces(Automatic)).GetReport().NonDelaunayBefore);
    EXPECT_LT(bad, before) << offset;
    before = bad;
  }
  EXPECT_EQ(0, before);
}

TEST(Tolerance, IsReported)
{
  const OwnedMesh<double> grid = MakeGridMesh(3, 3);
  FlipOptions options;
  const auto describe = [&]() { return MakeSession(grid.View(), options).GetReport().Tolerance; };
  EXPECT_EQ(Automatic, options.Tolerance);
  EXPECT_EQ("none", describe()); // in-circle
  options.Criterion = CriterionKind::OppositeAngles;
  EXPECT_EQ("automatic", describe());
  options.Tolerance = 0.015;
  EXPECT_EQ("0.015", describe());
  options.Criterion = CriterionKind::InCircle;
  options.Geometry = GeometryKind::Surface;
  EXPECT_EQ("0.015", describe());
}

//------------------------------------------------------------------------------
// The promise on single edges: if one is bad, its angle sum exceeds pi wherever its four points are
// within one unit in the last place of their coordinates.

/// Coordinates of a, p, q, b.
template <typename Real>
using QuadCoordinates = std::array<Real, 12>;

/// By how much the sum of the angles at a and b exceeds pi.
template <typename Real>
long double FindExcess(const QuadCoordinates<Real>& x)
{
  const auto get = [&](int i) { return LongVector{ x[3 * i], x[3 * i + 1], x[3 * i + 2] }; };
  return FindAngle(get(0), get(1), get(2)) + FindAngle(get(3), get(1), get(2)) - std::acos(-1.0L);
}

double DrawSigned(std::mt19937& random) { return random() / 2147483648.0 - 1.0; }

/// Four points almost on a circle somewhere in space, with an angle sum just below or above pi.
template <typename Real>
QuadCoordinates<Real> DrawQuad(std::mt19937& random)
{
  const double offset = 1000.0 * std::pow(0.5, random() % 20);
  const double spread = 20.0 * std::numeric_limits<Real>::epsilon() * (1.0 + offset);
  const double tilt = 3.0 * DrawSigned(random);
  const std::array<double, 3> origin = { offset * DrawSigned(random), offset * DrawSigned(random),
    offset * DrawSigned(random) };
  QuadCoordinates<Real> x;
  int i = 0;
  for (double turn : { 0.0, 1.5, 4.5, 3.0 }) // a, p, q, b
  {
    const double angle = turn + 0.7 * DrawSigned(random);
    const double radius = 1.0 + (turn == 0.0 ? spread * DrawSigned(random) : 0.0);
    const double u = radius * std::cos(angle), v = radius * std::sin(angle);
    x[i++] = static_cast<Real>(origin[0] + u);
    x[i++] = static_cast<Real>(origin[1] + std::cos(tilt) * v);
    x[i++] = static_cast<Real>(origin[2] + std::sin(tilt) * v + 0.1 * spread * DrawSigned(random));
  }
  return x;
}

/// Keeps each coordinate or moves it to a neighbouring number, whichever makes the sum smallest.
template <typename Real>
void LowerSum(QuadCoordinates<Real>& x)
{
  constexpr Real Infinity = std::numeric_limits<Real>::infinity();
  for (Real& coordinate : x)
  {
    Real best = coordinate;
    long double least = FindExcess(x);
    for (Real choice :
      { std::nextafter(coordinate, -Infinity), std::nextafter(coordinate, Infinity) })
    {
      coordinate = choice;
      const long double excess = FindExcess(x);
      best = excess < least ? choice : best;
      least = std::min(excess, least);
    }
    coordinate = best;
  }
}

/// Keeps each coordinate or moves it to a neighbouring number, at random.
template <typename Real>
QuadCoordinates<Real> Perturb(QuadCoordinates<Real> x, std::mt19937& random)
{
  for (Real& coordinate : x)
  {
    const double direction = static_cast<double>(DrawIndex(random, 3)) - 1.0;
    coordinate = std::nextafter(coordinate, static_cast<Real>(coordinate + direction));
  }
  return x;
}

template <typename Real>
void ExpectBadEdgesAreBadWithinPrecision(std::uint32_t seed)
{
  std::mt19937 random(seed);
  int bad = 0, doubtful = 0, different = 0;
  for (int i = 0; i < 20000 / Reduction; ++i)
  {
    const QuadCoordinates<Real> x = DrawQuad<Real>(random);
    const OwnedMesh<Real> mesh = { { x.begin(), x.end() }, { 0, 1, 2, 3, 2, 1 } };
    const bool isBad = MakeSession(mesh.View(), OnSurface()).GetReport().NonDelaunayBefore == 1;
    const bool isBadByAudit = CountNonDelaunayEdges(mesh.View(), OnSurface()) == 1;
    QuadCoordinates<Real> lowest = x;
    LowerSum(lowest);
    bad += isBad;
    different += isBad != isBadByAudit;
    doubtful += FindExcess(x) > 0 && FindExcess(lowest) <= 0;
    ASSERT_FALSE(isBad && FindExcess(lowest) <= 0) << "case " << i;
    for (int trial = 0; isBad && trial < 20; ++trial)
    {
      ASSERT_LT(0, FindExcess(Perturb(x, random))) << "case " << i;
    }
  }
  // Some sums are so close to pi + tolerance that rounding decides, differently in the two.
  EXPECT_LE(different, 40 / Reduction);
  // Many edges are bad, and without a tolerance many more would be.
  EXPECT_LT(2000 / Reduction, bad);
  EXPECT_LT(1000 / Reduction, doubtful);
}

TEST(AutomaticTolerance, BadEdgesAreBadWithinPrecision)
{
  ExpectBadEdgesAreBadWithinPrecision<float>(73);
  ExpectBadEdgesAreBadWithinPrecision<double>(74);
}

}
}
