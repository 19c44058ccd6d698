// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "TriangleAngles.h"
#include "FlipTestSupport.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>

namespace delaunayflip
{
namespace
{

constexpr double NaN = std::numeric_limits<double>::quiet_NaN();

std::vector<double> FindAngles(const TriangleMesh& mesh, GeometryKind geometry, int threads = 2)
{
  std::vector<double> angles(mesh.Triangles.Count, -1.0);
  FindSmallestAngles(mesh, geometry, threads, angles.data());
  return angles;
}

/// The smallest angle from the lengths of the sides, by the law of cosines.
double AngleByLengths(const TriangleMesh& mesh, std::int64_t triangle, int axes)
{
  long double squares[3]; // of the side opposite to each corner
  for (int corner = 0; corner < 3; ++corner)
  {
    squares[corner] = 0.0L;
    for (int axis = 0; axis < axes; ++axis)
    {
      const long double difference = static_cast<long double>(mesh.Points.Get(
                                       mesh.Triangles.Get(triangle, (corner + 1) % 3), axis)) -
        mesh.Points.Get(mesh.Triangles.Get(triangle, (corner + 2) % 3), axis);
      squares[corner] += difference * difference;
    }
  }
  long double smallest = 180.0L;
  for (int corner = 0; corner < 3; ++corner)
  {
    const long double b = squares[(corner + 1) % 3], c = squares[(corner + 2) % 3];
    const long double cosine = (b + c - squares[corner]) / (2.0L * std::sqrt(b * c));
    const long double angle = std::acos(std::max(-1.0L, std::min(1.0L, cosine)));
    smallest = std::min(smallest, angle * 180.0L / 3.14159265358979323846L);
  }
  return static_cast<double>(smallest);
}

void ExpectAnglesByLengths(const TriangleMesh& mesh, GeometryKind geometry)
{
  const std::vector<double> angles = FindAngles(mesh, geometry);
  for (std::int64_t t = 0; t < mesh.Triangles.Count; ++t)
  {
    const double expected = AngleByLengths(mesh, t, geometry == GeometryKind::PlanarXY ? 2 : 3);
    // Lengths determine small angles poorly: the cosine is 1 - angle^2 / 2.
    ASSERT_NEAR(expected, angles[t], 1e-9 + 1e-12 / std::max(expected, 1e-6)) << t;
  }
}

TEST(TriangleAngles, AgreeWithTheLengthsOfSides)
{
  for (const GeometryKind geometry :
    { GeometryKind::Planar, GeometryKind::Surface, GeometryKind::PlanarXY })
  {
    ExpectAnglesByLengths(MakeRandomBadMesh(3000, 5).View(), geometry);
    ExpectAnglesByLengths(MakeRandomBadMeshDouble(3000, 6).View(), geometry);
    ExpectAnglesByLengths(MakeBadSphere(40, 21, 7).View(), geometry);
  }
}

TEST(TriangleAngles, DoNotDependOnThreadsOrIds)
{
  const OwnedMesh<double> mesh = MakeRandomBadMeshDouble(30000, 8);
  const std::vector<std::int64_t> ids(mesh.Triangles.begin(), mesh.Triangles.end());
  TriangleMesh wide = mesh.View();
  wide.Triangles = TriangleArray(ids.data(), mesh.NumberOfTriangles());
  const std::vector<double> expected = FindAngles(mesh.View(), GeometryKind::Planar, 1);
  for (const int threads : { 0, 2, 7 })
  {
    EXPECT_EQ(expected, FindAngles(wide, GeometryKind::Planar, threads));
  }
}

/// The smallest angle of one triangle.
double FindAngle(const std::vector<double>& points, GeometryKind geometry)
{
  const OwnedMesh<double> mesh = { points, { 0, 1, 2 } };
  return FindAngles(mesh.View(), geometry)[0];
}

TEST(TriangleAngles, AtAnyScaleAndCorner)
{
  for (double s : { 1.0, 1e-300, 1e-160, 1e160, 1e308 })
  {
    EXPECT_NEAR(30.0,
      FindAngle({ 0, 0, 0, s, 0, 0, 0, s * std::sqrt(1.0 / 3.0), 0 }, GeometryKind::Surface),
      1e-12);
  }
  std::vector<double> needle = { 0, 0, 0, 1, 0, 0, 1, 1e-10, 0 };
  for (int turn = 0; turn < 3; ++turn)
  {
    EXPECT_NEAR(1e-10 * 57.29577951308232, FindAngle(needle, GeometryKind::Planar), 1e-24);
    std::rotate(needle.begin(), needle.begin() + 3, needle.end());
  }
}

TEST(TriangleAngles, WithoutAreaTheyAreZero)
{
  for (const std::vector<double>& points :
    std::vector<std::vector<double>>{
      { 0, 0, 0, 1, 0, 0, 3, 0, 0 }, { 0, 0, 0, 0, 0, 0, 3, 0, 0 }, { 1, 1, 1, 1, 1, 1, 1, 1, 1 } })
  {
    EXPECT_EQ(0.0, FindAngle(points, GeometryKind::Surface));
    EXPECT_EQ(0.0, FindAngle(points, GeometryKind::PlanarXY));
  }
  EXPECT_EQ(0.0, FindAngle({ 0, 0, 0, 1, 0, 1, 2, 0, 0 }, GeometryKind::PlanarXY));
  EXPECT_NEAR(45.0, FindAngle({ 0, 0, 0, 1, 0, 1, 2, 0, 0 }, GeometryKind::Surface), 1e-12);
}

TEST(TriangleAngles, NaNWhereACoordinateThatMattersIsNotFinite)
{
  for (const double x : std::initializer_list<double>{ NaN, -INFINITY })
  {
    EXPECT_TRUE(std::isnan(FindAngle({ 0, 0, 0, 1, x, 0, 0, 1, 0 }, GeometryKind::PlanarXY)));
    EXPECT_TRUE(std::isnan(FindAngle({ 0, 0, 0, 1, 0, 0, 0, 1, x }, GeometryKind::Surface)));
    EXPECT_NEAR(45.0, FindAngle({ 0, 0, 0, 1, 0, 0, 0, 1, x }, GeometryKind::PlanarXY), 1e-12);
  }
}

TEST(TriangleAngles, NameATriangleWithoutItsPoint)
{
  const std::vector<double> points{ 0, 0, 0, 1, 0, 0, 0, 1, 0 };
  const std::vector<std::int64_t> triangles{ 0, 1, 2, 0, 3, 2, 0, 1, -1 };
  TriangleMesh mesh;
  mesh.Points = PointArray(points.data(), 3);
  mesh.Triangles = TriangleArray(triangles.data(), 3);
  try
  {
    FindAngles(mesh, GeometryKind::Planar);
    FAIL() << "no exception";
  }
  catch (const InvalidMesh& error)
  {
    EXPECT_EQ(1, error.Cell);
    EXPECT_EQ(3, error.Point);
  }
}

}
}
