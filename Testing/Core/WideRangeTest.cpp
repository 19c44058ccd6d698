// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// Meshes with coordinates of so many orders of magnitude that products of lengths overflow in
/// one part of the mesh and vanish in another.
#include "FlipTestSupport.h"
#include "GeometryChoice.h"
#include "MeshAudit.h"
#include "WideAngles.h"

#include <gtest/gtest.h>

#include <cmath>

namespace delaunayflip
{
namespace
{

/// One bad sphere in several sizes. Each must be flipped as if it were alone.
template <typename Real>
void ExpectRightInAllSizes(const std::vector<double>& sizes)
{
  const OwnedMesh<double> sphere = MakeBadSphere(24, 12, 66);
  OwnedMesh<Real> all;
  std::int64_t badBefore = 0;
  for (const double size : sizes)
  {
    OwnedMesh<Real> alone;
    Append(alone, sphere, size);
    Append(all, sphere, size);
    const FlipResult result = Flip(alone.View(), OnSurface());
    EXPECT_LT(50, result.Report.TotalFlips) << size;
    badBefore += result.Report.NonDelaunayBefore;
  }
  EXPECT_EQ(badBefore, FlipAndAudit(all.View(), OnSurface()).Report.NonDelaunayBefore);
}

TEST(WideRange, SmallSpheresBesideLargeOnes)
{
  ExpectRightInAllSizes<double>({ 1.0, 0x1p-540 });
  ExpectRightInAllSizes<double>({ 0x1p1000, 1.0, 0x1p-1000 });
  ExpectRightInAllSizes<double>({ 0x1p-300, 0x1p300, 0x1p20, 0x1p-20 });
  ExpectRightInAllSizes<float>({ 0x1p120, 1.0, 0x1p-60, 0x1p-100 });
}

/// A quad in a plane far above. Its coordinates differ in x and y only.
TEST(WideRange, OneLargeCoordinateHidesNoBadEdge)
{
  for (const double height : { 1e100, 1e160, 1e300, 1.7e308 })
  {
    OwnedMesh<double> mesh;
    mesh.Points = { 0, 0, height, 4, 0, height, 2, 1, height, 2, -1, height, 1, 0, -height };
    mesh.Triangles = { 0, 1, 2, 1, 0, 3, 2, 1, 4 };
    const FlipResult result = Flip(mesh.View(), With(&FlipOptions::Tolerance, 0.0, OnSurface()));
    EXPECT_EQ(1, result.Report.NonDelaunayBefore) << height;
    EXPECT_EQ(1, result.Report.TotalFlips) << height;
    EXPECT_EQ(0, result.Report.NonDelaunayAfter) << height;
  }
}

TEST(WideRange, FeatureEdgesAreThoseOfTheShape)
{
  const OwnedMesh<double> sphere = MakeBadSphere(24, 12, 66);
  const FlipOptions options; // features sharper than 30 degrees
  const std::int64_t features = Flip(sphere.View(), options).Report.Edges.Feature;
  EXPECT_LT(0, features);
  for (const double size : { 0x1p-1000, 0x1p-540, 0x1p540, 0x1p1000 })
  {
    OwnedMesh<double> scaled;
    Append(scaled, sphere, size);
    EXPECT_EQ(features, Flip(scaled.View(), options).Report.Edges.Feature) << size;
  }
}

/// In a level plane z plays no part in the criterion; but a triangle with such a point has no
/// angle.
TEST(WideRange, HeightsThatAreNotFiniteCountInNoAngle)
{
  for (const double bad : { std::nan(""), HUGE_VAL, -HUGE_VAL })
  {
    OwnedMesh<double> mesh;
    mesh.Points = { 0, 0, 5, 4, 0, 5, 4, 4, 5, 0, 4, 5, 8, 0.01, bad };
    mesh.Triangles = { 0, 1, 2, 0, 2, 3, 1, 4, 2 };
    const FlipResult result = Flip(mesh.View(), {});
    EXPECT_EQ(GeometryKind::Planar, result.Report.GeometryUsed);
    EXPECT_DOUBLE_EQ(45.0, MinimumAngle(mesh.View(), GeometryKind::Planar));
    EXPECT_DOUBLE_EQ(45.0, result.Report.MinimumAngleBefore) << bad;
    EXPECT_DOUBLE_EQ(45.0, result.Report.MinimumAngleAfter) << bad;
  }
}

/// Doubled coordinates are the same shape, so they must give the same triangles.
void ExpectSameWhenDoubled(const OwnedMesh<double>& mesh, const FlipOptions& options)
{
  const OwnedMesh<double> doubled = Transform(mesh, ScaleAndMove(2.0, 0.0));
  const FlipResult result = Flip(mesh.View(), options);
  EXPECT_EQ(result.Triangles, Flip(doubled.View(), options).Triangles);
}

constexpr double Tiny = 0x1p-538; // its square is half the smallest number

/// All triangles are almost flat: their areas are usual, but products of two areas vanish.
TEST(WideRange, ThinTrianglesFoldNothing)
{
  constexpr double Small = 0x1p-269, A = -0.4795848592184484;
  OwnedMesh<double> mesh;
  mesh.Points = { 0, 0, A, 0, 2 * Tiny, 0.37, 2 * Tiny, 2 * Tiny, -0.5, 3 * Tiny, 2 * Tiny, A,
    3 * Tiny, 3 * Tiny, A, 2 * Small, 6 * Small, -0.3, 4 * Small, 0, 0.5, 6 * Small, 2 * Small,
    0.38 };
  mesh.Triangles = { 4, 1, 2, 1, 0, 2, 0, 3, 2, 3, 4, 2, 4, 5, 1, 4, 3, 5, 3, 6, 5, 3, 0, 6, 6, 7,
    5 };
  ExpectSameWhenDoubled(mesh, OnSurface());
}

TEST(WideRange, FeaturesOfThinTrianglesAreFound)
{
  OwnedMesh<double> mesh;
  mesh.Points = { 0, 0, 1, 0, Tiny, 0, 0, 2 * Tiny, 1, 2 * Tiny, 0, 1, 2 * Tiny, Tiny, 0, 2 * Tiny,
    3 * Tiny, 3, 3 * Tiny, 0, 2, 3 * Tiny, Tiny, 3, 3 * Tiny, 3 * Tiny, 2 };
  mesh.Triangles = { 2, 1, 3, 0, 1, 3, 2, 4, 3, 5, 2, 4, 6, 4, 3, 6, 7, 4, 7, 5, 6 };
  FlipOptions options = OnSurface(30.0);
  options.Tolerance = 0.0;
  options.MaximumIterations = 1;
  ExpectSameWhenDoubled(mesh, options);
}

/// The smallest components of a long vector do not fit its new size. If they were rounded twice,
/// it would matter where the first rounding is.
TEST(WideRange, VectorsAreRoundedOnce)
{
  for (int i = 1; i < 2000; ++i)
  {
    const Vector3 vector = { 1e-298 + i * 1e-301, 0.0, 6e23 };
    const WideVector once = MakeWide(vector);
    EXPECT_EQ(std::ldexp(vector.X, -once.Exponent), once.Vector.X) << i;
  }
}

TEST(WideRange, HeightsOfAnyBoxAreCompared)
{
  constexpr double Unit = 0x1p-1074;
  EXPECT_TRUE(IsHigherThanWide({ { 0, 0, 0 }, { 4 * Unit, 4 * Unit, 5 * Unit } }));
  EXPECT_FALSE(IsHigherThanWide({ { 0, 0, 0 }, { 5 * Unit, 4 * Unit, 5 * Unit } }));
  EXPECT_TRUE(IsHigherThanWide({ { 0, 0, 100 }, { 1, 1, 102 } }));
  EXPECT_FALSE(IsHigherThanWide({ { 0, 0, 100 }, { 50, 50, 101 } }));
  EXPECT_FALSE(IsHigherThanWide({ { 0, 0, -1e308 }, { 1, 1e300, -1e308 } }));
  EXPECT_TRUE(IsHigherThanWide({ { 0, 0, -1.7e308 }, { 1.7e308, 1.7e308, 1.7e308 } }));
  EXPECT_TRUE(IsHigherThanWide({ { -1e308, 0, -1.7e308 }, { 1e308, 0, 1.7e308 } }));
}

}
}
