// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// Meshes whose coordinates span so many orders of magnitude that products of lengths overflow in
/// one part of the mesh and vanish in another.
#include "FlipTestSupport.h"
#include "MeshAudit.h"

#include <gtest/gtest.h>

#include <cmath>

namespace delaunayflip
{
namespace
{

template <typename Real>
FlipResult FlipInSpace(const OwnedMesh<Real>& mesh)
{
  FlipOptions options;
  options.Geometry = GeometryKind::Surface;
  options.FeatureAngle = 180.0;
  return Flip(mesh.View(), options);
}

/// Adds the points and triangles of another mesh times a factor.
template <typename Real>
void Append(OwnedMesh<Real>& mesh, const OwnedMesh<double>& other, double factor)
{
  const auto offset = static_cast<std::int32_t>(mesh.NumberOfPoints());
  for (const double coordinate : other.Points)
  {
    mesh.Points.push_back(static_cast<Real>(factor * coordinate));
  }
  for (const std::int32_t id : other.Triangles)
  {
    mesh.Triangles.push_back(id + offset);
  }
}

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
    const FlipResult result = FlipInSpace(alone);
    EXPECT_LT(50, result.Report.TotalFlips) << size;
    badBefore += result.Report.NonDelaunayBefore;
  }
  const FlipResult result = FlipInSpace(all);
  EXPECT_EQ(badBefore, result.Report.NonDelaunayBefore);
  EXPECT_TRUE(result.Report.Converged());
  OwnedMesh<Real> after = all;
  after.Triangles = result.Triangles;
  FlipOptions options;
  options.Geometry = GeometryKind::Surface;
  options.FeatureAngle = 180.0;
  EXPECT_EQ(CountNonDelaunayEdges(after.View(), options), result.Report.NonDelaunayAfter);
  EXPECT_NEAR(
    MinimumAngle(after.View(), GeometryKind::Surface), result.Report.MinimumAngleAfter, 1e-6);
}

TEST(WideRange, SmallSpheresBesideLargeOnes)
{
  ExpectRightInAllSizes<double>({ 1.0, 0x1p-540 });
  ExpectRightInAllSizes<double>({ 0x1p1000, 1.0, 0x1p-1000 });
  ExpectRightInAllSizes<double>({ 0x1p-300, 0x1p300, 0x1p20, 0x1p-20 });
}

TEST(WideRange, SmallSpheresOfFloatsBesideLargeOnes)
{
  ExpectRightInAllSizes<float>({ 0x1p120, 1.0, 0x1p-60, 0x1p-100 });
}

/// A quad in a plane far above, whose coordinates differ in x and y only.
TEST(WideRange, OneLargeCoordinateHidesNoBadEdge)
{
  for (const double height : { 1e100, 1e160, 1e300, 1.7e308 })
  {
    OwnedMesh<double> mesh;
    mesh.Points = { 0, 0, height, 4, 0, height, 2, 1, height, 2, -1, height, 1, 0, -height };
    mesh.Triangles = { 0, 1, 2, 1, 0, 3, 2, 1, 4 };
    FlipOptions options;
    options.Geometry = GeometryKind::Surface;
    options.FeatureAngle = 180.0;
    options.Tolerance = 0.0;
    const FlipResult result = Flip(mesh.View(), options);
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

}
}
