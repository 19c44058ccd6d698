// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FlipError.h"
#include "HullInserter.h"
#include "MeshAudit.h"
#include "PointTriangulation.h"
#include "PortableMath.h"
#include "RandomNumbers.h"
#include "References.h"
#include "SpherePasses.h"
#include "SphereTestSupport.h"
#include "ThreadBackend.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>

/// @file
/// Triangulations of points on a sphere.

namespace delaunayflip
{
namespace
{

struct SphereResult
{
  std::vector<std::int32_t> Triangles, Neighbors;
  std::vector<std::int64_t> Used;
  FlipReport Report;
};

PointOptions Projected(ProjectionKind projection = ProjectionKind::Sphere)
{
  return With(&PointOptions::Projection, projection);
}

SphereResult Triangulate(
  const std::vector<Point3>& points, const PointOptions& options = Projected())
{
  PointInput input;
  input.Points = PlaneArray(points.data()->data(), static_cast<std::int64_t>(points.size()), 3);
  const FlipSession session = FlipPoints(input, options);
  SphereResult result;
  result.Report = session.GetReport();
  result.Triangles = StoreTriangles(session);
  result.Neighbors.resize(result.Triangles.size());
  session.StoreNeighbors(result.Neighbors.data());
  result.Used.resize(points.size());
  session.StoreUsedPoints(result.Used.data());
  return result;
}

/// Triangles as the places of their corners, which do not depend on the ids of points.
std::set<std::array<Point3, 3>> ListPlaces(
  const std::vector<Point3>& points, const std::vector<std::int32_t>& triangles)
{
  std::set<std::array<Point3, 3>> places;
  for (std::size_t i = 0; i < triangles.size(); i += 3)
  {
    std::array<Point3, 3> corners{ points[triangles[i]], points[triangles[i + 1]],
      points[triangles[i + 2]] };
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    places.insert(corners);
  }
  return places;
}

/// How many edges are not convex, in rational numbers.
std::int64_t CountReflexEdges(const std::vector<Point3>& points, const SphereResult& result)
{
  std::int64_t reflex = 0;
  for (std::size_t corner = 0; corner < result.Triangles.size(); ++corner)
  {
    if (result.Neighbors[corner] < 0)
    {
      continue;
    }
    const std::size_t t = corner - corner % 3;
    const std::int32_t* ids = &result.Triangles[t];
    const std::int32_t* other = &result.Triangles[3 * result.Neighbors[corner]];
    const std::int32_t across =
      other[0] + other[1] + other[2] - (ids[0] + ids[1] + ids[2] - ids[corner % 3]);
    reflex += static_cast<std::int64_t>(
      RationalOrientation3D(points[ids[0]], points[ids[1]], points[ids[2]], points[across]) < 0);
  }
  return reflex;
}

class SphereTest : public testing::TestWithParam<SphereFamily>
{
protected:
  std::vector<Point3> Points = GetParam().Make();
  OwnedMesh<double> Hull = MakeHull(this->Points);
};

TEST_P(SphereTest, IsTheConvexHull)
{
  const SphereResult result = Triangulate(this->Points);
  EXPECT_EQ(0, CountReflexEdges(this->Points, result));
  const FlipReport& report = result.Report;
  EXPECT_EQ(2 * report.FromPoints.Used - 4, report.Triangles);
  EXPECT_EQ(2, report.EulerCharacteristic);
  EXPECT_EQ(0, report.Edges.Boundary);
  EXPECT_EQ(this->Hull.Triangles.size(), result.Triangles.size());
  if (!GetParam().HasTies)
  {
    EXPECT_EQ(ToTriangleSet(this->Hull.Triangles), ToTriangleSet(result.Triangles));
  }
  std::set<Point3> places(this->Points.begin(), this->Points.end());
  const auto given = static_cast<std::int64_t>(this->Points.size());
  EXPECT_EQ(given - static_cast<std::int64_t>(places.size()), report.FromPoints.Repeated);
  EXPECT_EQ(
    static_cast<std::int64_t>(places.size()) - report.FromPoints.Used, report.FromPoints.Inside);
}

TEST_P(SphereTest, DependsOnThePlacesAlone)
{
  const auto expected = ListPlaces(this->Points, Triangulate(this->Points).Triangles);
  std::mt19937 random(5);
  for (int i = 0; i < 3; ++i)
  {
    Shuffle(this->Points.begin(), this->Points.end(), random);
    EXPECT_EQ(expected, ListPlaces(this->Points, Triangulate(this->Points).Triangles));
  }
}

TEST_P(SphereTest, IsTheSameOnThreads)
{
  const SphereResult one = Triangulate(this->Points, WithThreads(1, Projected()));
  for (const int threads : { 2, 3, 16 })
  {
    const SphereResult several = Triangulate(this->Points, WithThreads(threads, Projected()));
    EXPECT_EQ(one.Triangles, several.Triangles);
    EXPECT_EQ(one.Neighbors, several.Neighbors);
    EXPECT_EQ(one.Used, several.Used);
  }
}

/// Flips make the same triangles of any mesh of the same points.
TEST_P(SphereTest, IsWhatFlipsEndAt)
{
  const SphereResult result = Triangulate(this->Points);
  OwnedMesh<double> start{ this->Hull.Points, result.Triangles };
  Scramble(start, 5000, 1);
  const FlipResult flipped = Flip(start.View(), OnSphere());
  if (!GetParam().IsPart) // then all triangles face the origin with the same side
  {
    EXPECT_EQ(ToTriangleSet(result.Triangles), ToTriangleSet(flipped.Triangles));
  }
}

/// The insertion of one point after the other makes the same triangles as the projection.
TEST_P(SphereTest, IsTheHullOfInsertion)
{
  SpacePoints points;
  std::vector<std::int32_t> all(this->Points.size());
  std::iota(all.begin(), all.end(), 0);
  for (const Point3& p : this->Points)
  {
    points.push_back({ p[0], p[1], p[2] });
  }
  const Simplex simplex =
    FindSimplex(SpherePoints{ points.data(), nullptr, SizeOf(points) }, ThreadBackend(1));
  std::vector<std::int32_t> s;
  for (const NumberedPoint& corner : simplex)
  {
    s.push_back(corner.Id);
  }
  HullInserter hull(points, FindCenter(simplex),
    { s[0], s[1], s[2], s[1], s[0], s[3], s[2], s[1], s[3], s[0], s[2], s[3] });
  for (const std::int32_t i : all)
  {
    hull.Insert(i);
  }
  EXPECT_EQ(this->Hull.Triangles.size(), hull.ListTriangles().size());
  if (!GetParam().HasTies)
  {
    EXPECT_EQ(ToTriangleSet(this->Hull.Triangles), ToTriangleSet(hull.ListTriangles()));
  }
}

INSTANTIATE_TEST_SUITE_P(Families, SphereTest, testing::ValuesIn(ListSphereFamilies()),
  [](const auto& each) { return std::string(each.param.Name); });

TEST(SphereTriangulation, HasOnePointWhereLongitudesMeet)
{
  const std::vector<Point3> points = PlaceAll({ { 0, 90 }, { 77, 90 }, { -90, -90 }, { 0, -90 },
    { 180, 0 }, { -180, -0.0 }, { 540, 0 }, { 0, 0 }, { 360, 0 }, { 90, 0 }, { -90, 0 } });
  const SphereResult result = Triangulate(points);
  EXPECT_EQ((std::vector<std::int64_t>{ 0, 0, 2, 2, 4, 4, 4, 7, 7, 9, 10 }), result.Used);
  EXPECT_EQ(5, result.Report.FromPoints.Repeated);
  EXPECT_EQ(8, result.Report.Triangles);
  ASSERT_EQ(1u, result.Report.Defects.size());
  EXPECT_EQ(DefectKind::PointsRepeated, result.Report.Defects[0].Kind);
  EXPECT_EQ((std::vector<std::int64_t>{ 1, 3, 5 }), result.Report.Defects[0].FirstIds);
}

TEST(SphereTriangulation, PlacesAnglesExactly)
{
  double xyz[3];
  PlaceOnSphere(90.0, 0.0, xyz);
  EXPECT_EQ((Point3{ 0.0, 1.0, 0.0 }), (Point3{ xyz[0], xyz[1], xyz[2] }));
  EXPECT_FALSE(std::signbit(xyz[0]));
  PlaceOnSphere(45.0, 30.0, xyz);
  EXPECT_NEAR(std::sqrt(0.375), xyz[0], 1e-15);
  EXPECT_NEAR(std::sqrt(0.375), xyz[1], 1e-15);
  EXPECT_NEAR(0.5, xyz[2], 1e-15);
  double turned[3];
  for (const double longitude : { -135.0, -45.0, 45.0, 135.0, 12.5 })
  {
    PlaceOnSphere(longitude, 30.0, xyz);
    PlaceOnSphere(longitude + 360.0, 30.0, turned);
    EXPECT_TRUE(std::equal(xyz, xyz + 3, turned)) << longitude;
  }
  PlaceOnSphere(std::numeric_limits<double>::infinity(), 0.0, xyz);
  EXPECT_TRUE(std::isnan(xyz[0]));
}

TEST(SphereTriangulation, PlacesAnglesAlikeOnAllSystems)
{
  constexpr int Count = 40000 / Reduction;
  int different = 0; // from correctly rounded, which the sines of C libraries often are not
  for (int i = 0; i <= Count; ++i)
  {
    const double radians = (2.0 * i / Count - 1.0) * 0.78539816339744828;
    const SineAndCosine found = FindSineAndCosine(radians);
    const double sine = Sine(radians), cosine = Cosine(radians);
    EXPECT_NEAR(sine, found.Sine, 0x1p-52 * std::fabs(sine));
    EXPECT_NEAR(cosine, found.Cosine, 0x1p-53);
    different += static_cast<int>(sine != found.Sine) + static_cast<int>(cosine != found.Cosine);
  }
  EXPECT_GE(4, different);
  EXPECT_NEAR(std::tan(0.3), Tangent(0.3), 1e-16);
  EXPECT_NEAR(std::cos(2.5), Cosine(2.5), 2e-16);
}

TEST(SphereTriangulation, FindsLengthsOfAllSizes)
{
  for (int i = 0; i < 20000 / Reduction; ++i)
  {
    const double x = std::ldexp(1.0 + 4e-5 * i, i % 2000 - 1000);
    const double y = std::ldexp(1.5 + 3e-5 * i, i % 2000 - 1040 + i % 61);
    const double length = std::hypot(x, y); // its error is below one unit, too
    EXPECT_NEAR(length, PlaneLength(-x, y), 0x1p-52 * length) << x << " " << y;
    EXPECT_EQ(PlaneLength(y, x), PlaneLength(x, y));
  }
  EXPECT_EQ(5.0 * 0x1p1020, PlaneLength(3.0 * 0x1p1020, 4.0 * 0x1p1020));
  EXPECT_EQ(0.0, PlaneLength(0.0, -0.0));
}

/// The smallest angle of triangles in degrees.
double FindSmallestAngle(
  const std::vector<Point3>& points, const std::vector<std::int32_t>& triangles)
{
  double smallest = 180.0;
  for (std::size_t corner = 0; corner < triangles.size(); ++corner)
  {
    const std::size_t first = corner - corner % 3;
    const Point3& at = points[triangles[corner]];
    const Point3& next = points[triangles[first + (corner + 1) % 3]];
    const Point3& last = points[triangles[first + (corner + 2) % 3]];
    double dot = 0.0, square = 0.0, otherSquare = 0.0;
    for (int i = 0; i < 3; ++i)
    {
      dot += (next[i] - at[i]) * (last[i] - at[i]);
      square += (next[i] - at[i]) * (next[i] - at[i]);
      otherSquare += (last[i] - at[i]) * (last[i] - at[i]);
    }
    const double cosine = std::clamp(dot / std::sqrt(square * otherSquare), -1.0, 1.0);
    smallest = std::min(smallest, std::acos(cosine) * 180.0 / Pi);
  }
  return smallest;
}

TEST(SphereTriangulation, OpensPartsOfASphere)
{
  for (const SphereFamily& family : ListSphereFamilies())
  {
    const std::vector<Point3> points = family.Make();
    const SphereResult closed = Triangulate(points);
    const SphereResult open = Triangulate(points, Projected(ProjectionKind::OpenSphere));
    const bool isPart = family.IsPart;
    EXPECT_EQ(isPart, open.Report.Edges.Boundary > 0) << family.Name;
    EXPECT_EQ(isPart ? 1 : 2, open.Report.EulerCharacteristic) << family.Name;
    EXPECT_EQ(
      closed.Report.Triangles, open.Report.Triangles + open.Report.FromPoints.LargeTriangles)
      << family.Name;
    EXPECT_EQ(closed.Report.FromPoints.Used, open.Report.FromPoints.Used) << family.Name;
    EXPECT_NEAR(FindSmallestAngle(points, open.Triangles), open.Report.MinimumAngleAfter, 1e-4)
      << family.Name;
  }
}

TEST(SphereTriangulation, LeavesPointsInsideOut)
{
  std::vector<Point3> points = MakeRandomPoints<double>(300, 4);
  for (std::size_t i = 0; i < points.size(); i += 10)
  {
    std::for_each(points[i].begin(), points[i].end(), [](double& x) { x *= 0.9; });
  }
  points[17][1] = std::numeric_limits<double>::quiet_NaN();
  points[5] = { 0.0, 0.0, 0.0 };
  const SphereResult result = Triangulate(points);
  EXPECT_EQ(31, result.Report.FromPoints.Inside);
  EXPECT_EQ(1, result.Report.FromPoints.NotFinite);
  EXPECT_EQ(268, result.Report.FromPoints.Used);
  EXPECT_EQ(-1, result.Used[10]);
  EXPECT_EQ(-1, result.Used[17]);
  EXPECT_EQ(11, result.Used[11]);
  points[17] = points[16];
  EXPECT_EQ(0, CountReflexEdges(points, Triangulate(points)));
}

/// Points that differ in the last bits, which the projection cannot tell from each other.
TEST(SphereTriangulation, IsExactWherePointsNearlyCoincide)
{
  std::vector<Point3> points = MakeRandomPoints<double>(30, 6);
  std::mt19937 random(3);
  for (std::size_t i = 0; i < 300; ++i)
  {
    Point3 near = points[i];
    for (double& x : near)
    {
      x += static_cast<double>(random() % 9) * 0x1p-53;
    }
    points.push_back(near);
  }
  const SphereResult result = Triangulate(points);
  EXPECT_EQ(0, CountReflexEdges(points, result));
  EXPECT_EQ(MakeHull(points).Triangles.size(), result.Triangles.size());
  const auto expected = ListPlaces(points, result.Triangles);
  Shuffle(points.begin(), points.end(), random);
  EXPECT_EQ(expected, ListPlaces(points, Triangulate(points).Triangles));
}

/// Once a corner of the first simplex is found to be inside, no four of the other points have a
/// center that rounds to a place between them.
TEST(SphereTriangulation, HasTheHullOfCoordinatesOfAllSizes)
{
  std::vector<Point3> points = { { -347.94949245452881, 2.3669399902327274e+61,
                                   3.5146635019276282e+265 },
    { -1.2891898490383992e-38, 2.3864390909939372e-56, -1.1931978316114272e+77 },
    { -2.9399501000964817e+87, 8.435986648399403e+232, 2.6461020278909884e-279 },
    { 1.1118051057488166e-282, -1.5144166314170641e+125, -1.9274880465585523e-182 },
    { 3.7853452497895675e+122, 9.1025701600251605e+30, 1.3900153543042085e-83 },
    { 6.3086981583100346e+141, -1.7162754202575546e+280, 5.1567255585939378e+274 },
    { -5.1564711304621685e-154, -1.1197808504079822e+30, -3.9621001309174549e-129 },
    { 5.5076701549066542e+111, 2.3919423326476399e+224, 5.3597045345735412e-188 },
    { -1.8324759713536079e+44, 4.0366915201259145e+108, -9.1843821013387589e+232 },
    { 4.6683799574419487e-250, -6.2093248006910311e+239, -5.0646157720500536e+144 },
    { -2.0053419395084992e-39, 1.491581476080207e-27, -7.7807129439017564e-60 },
    { -4.9401596090851211e+49, -1.4335839237337871e-87, 1.1592432244826032e+170 } };
  const SphereResult result = Triangulate(points);
  EXPECT_EQ(8, result.Report.Triangles);
  EXPECT_EQ(6, result.Report.FromPoints.Inside);
  EXPECT_EQ(0, CountReflexEdges(points, result));
  const auto places = ListPlaces(points, result.Triangles);
  std::reverse(points.begin(), points.end());
  EXPECT_EQ(places, ListPlaces(points, Triangulate(points).Triangles));
}

TEST(SphereTriangulation, HasNoTrianglesInOnePlane)
{
  std::vector<Point3> points;
  for (int i = 0; i < 8; ++i)
  {
    points.push_back(PlaceAll({ { 45.0 * i, 0.0 } })[0]);
  }
  const SphereResult result = Triangulate(points);
  EXPECT_EQ(0, result.Report.Triangles);
  ASSERT_EQ(1u, result.Report.Defects.size());
  EXPECT_EQ(DefectKind::PointsInOnePlane, result.Report.Defects[0].Kind);
  EXPECT_EQ(0, Triangulate({ { 0, 0, 1 }, { 1, 0, 0 }, { 0, 1, 0 } }).Report.Triangles);
  EXPECT_EQ(
    4, Triangulate({ { 0, 0, 1 }, { 1, 0, 0 }, { 0, 1, 0 }, { 1, 1, 1 } }).Report.Triangles);
}

/// A random number in -1 to 1, times a random power of two.
double DrawCoordinate(std::mt19937& random, int lowest, int highest)
{
  const double exponent = DrawReal(random, lowest, highest + 1);
  return std::ldexp(DrawReal(random, -1.0, 1.0), static_cast<int>(exponent));
}

TEST(SphereTriangulation, FilterOfPlanesNeverErrs)
{
  std::mt19937 random(11);
  int certain = 0, wrong = 0;
  constexpr int Cases = 20000;
  for (int i = 0; i < Cases; ++i)
  {
    // The fourth point is in the plane of the others, except for rounding, and a little beside it.
    const int most = i % 2 == 0 ? 0 : 200;
    const auto draw = [&] { return DrawCoordinate(random, -most, most); };
    PlanePoint p[4];
    for (PlanePoint& point : p)
    {
      point = { draw(), draw(), draw() };
    }
    const double s = DrawReal(random, -1.0, 1.0), t = DrawReal(random, -1.0, 1.0);
    const double aside = i % 3 == 0 ? 0.0 : DrawCoordinate(random, -60, 0);
    const auto place = [&](double PlanePoint::*axis)
    {
      const double inPlane =
        p[0].*axis + s * (p[1].*axis - p[0].*axis) + t * (p[2].*axis - p[0].*axis);
      p[3].*axis = inPlane + aside * (p[3].*axis);
    };
    place(&PlanePoint::U);
    place(&PlanePoint::V);
    place(&PlanePoint::W);
    const int sign = FindOrientation3D(p[0], p[1], p[2], p[3]);
    const bool isInside = FilteredPlane(p[0], p[1], p[2]).IsInside(p[3]);
    const bool isOutside = FilteredPlane(p[0], p[2], p[1]).IsInside(p[3]);
    wrong += int(isInside && sign <= 0) + int(isOutside && sign >= 0);
    certain += int(isInside || isOutside);
  }
  EXPECT_EQ(0, wrong);
  EXPECT_LT(Cases / 4, certain);
  EXPECT_GT(Cases, certain + Cases / 4);
}

TEST(SphereTriangulation, ThreePlacesMakeOneOpenTriangle)
{
  const std::vector<Point3> points = PlaceAll({ { 0, 0 }, { 0, 80 }, { 70, 0 }, { 0, 0 } });
  const SphereResult result = Triangulate(points, Projected(ProjectionKind::OpenSphere));
  ASSERT_EQ(1, result.Report.Triangles);
  EXPECT_EQ((std::vector<std::int32_t>{ -1, -1, -1 }), result.Neighbors);
  EXPECT_EQ((std::vector<std::int64_t>{ 0, 1, 2, 0 }), result.Used);
  const std::set<std::array<Point3, 3>> expected = ListPlaces(points, { 0, 2, 1 });
  EXPECT_EQ(expected, ListPlaces(points, result.Triangles));
  EXPECT_EQ(3, result.Report.FromPoints.Used);
  EXPECT_EQ(1, result.Report.FromPoints.Repeated);
  EXPECT_EQ(3, result.Report.Edges.Boundary);
  EXPECT_EQ(1, result.Report.EulerCharacteristic);
  EXPECT_GT(result.Report.MinimumAngleAfter, 50.0);
  EXPECT_FALSE(result.Report.Backend.empty());
  EXPECT_EQ(0, Triangulate(points).Report.Triangles);
  // A great circle encloses half of the sphere.
  const std::vector<Point3> onEquator = PlaceAll({ { 0, 0 }, { 90, 0 }, { 180, 0 } });
  EXPECT_EQ(0, Triangulate(onEquator, Projected(ProjectionKind::OpenSphere)).Report.Triangles);
}

/// Points on one parallel lie in one plane exactly: z is the same for all.
TEST(SphereTriangulation, OneParallelMakesAnOpenPolygon)
{
  for (const double latitude : { 60.0, -10.0, 1e-9 })
  {
    std::vector<std::array<double, 2>> places;
    for (int i = 0; i < 24; ++i)
    {
      places.push_back({ 15.0 * i, latitude });
    }
    places.push_back(places[3]);
    std::vector<Point3> points = PlaceAll(places);
    const SphereResult result = Triangulate(points, Projected(ProjectionKind::OpenSphere));
    ASSERT_EQ(22, result.Report.Triangles) << latitude;
    EXPECT_EQ(24, result.Report.FromPoints.Used);
    EXPECT_EQ(1, result.Report.FromPoints.Repeated);
    EXPECT_EQ(24, result.Report.Edges.Boundary);
    EXPECT_EQ(1, result.Report.EulerCharacteristic);
    EXPECT_EQ(1u, result.Report.Defects.size()); // the repeated point
    EXPECT_EQ(3, result.Used[24]);
    EXPECT_EQ(0, CountReflexEdges(points, result));
    EXPECT_NEAR(FindSmallestAngle(points, result.Triangles), result.Report.MinimumAngleAfter, 1e-6);
    const auto expected = ListPlaces(points, result.Triangles);
    std::reverse(points.begin(), points.end());
    const SphereResult again = Triangulate(points, Projected(ProjectionKind::OpenSphere));
    EXPECT_EQ(expected, ListPlaces(points, again.Triangles));
  }
  const std::vector<Point3> line(30, PlaceAll({ { 10.0, 20.0 } })[0]);
  const SphereResult none = Triangulate(line, Projected(ProjectionKind::OpenSphere));
  EXPECT_EQ(0, none.Report.Triangles);
  ASSERT_EQ(2u, none.Report.Defects.size());
  EXPECT_EQ(DefectKind::PointsInOnePlane, none.Report.Defects[1].Kind);
  EXPECT_NE(std::string::npos, none.Report.Defects[1].Detail.find("fewer than three places"));
}

TEST(SphereTriangulation, MayBeStopped)
{
  const std::vector<Point3> points = MakeRandomPoints<double>(20000, 7);
  PointInput input;
  input.Points = PlaneArray(points.data()->data(), 20000, 3);
  FlipSession session(input, Projected());
  double last = -1.0;
  EXPECT_FALSE(session.Advance(-1, {},
    [&](double share)
    {
      EXPECT_LE(last, share);
      last = share;
      return share < 0.6;
    }));
  EXPECT_EQ(StopReasonKind::Aborted, session.GetReport().StopReason);
  EXPECT_EQ(0, session.GetReport().Triangles);
  session.Advance();
  EXPECT_TRUE(session.GetReport().Converged());
  EXPECT_EQ(2 * 20000 - 4, session.GetReport().Triangles);
}

TEST(SphereTriangulation, RefusesWhatItCannotDoYet)
{
  const std::vector<Point3> points = MakeRandomPoints<double>(20, 7);
  PointInput input;
  input.Points = PlaneArray(points.data()->data(), 20, 3);
  FlipSession session = FlipPoints(input, Projected());
  EXPECT_THROW(session.Insert(input.Points), InvalidOptions);
  const std::string why =
    GetMessage<InvalidOptions>([&] { session.StoreOrderedTriangles(MutableTriangleArray()); });
  EXPECT_NE(std::string::npos, why.find("stored in order")) << why;
  EXPECT_THROW(
    FlipSession(input, With(&PointOptions::MinimumAngle, 20.0, Projected())), InvalidOptions);
  const double sizes[20] = {};
  input.Sizes = sizes;
  EXPECT_THROW(FlipSession(input, Projected()), InvalidOptions);
  PointInput flat;
  flat.Points = PlaneArray(points.data()->data(), 30, 2);
  EXPECT_THROW(FlipSession(flat, Projected()), InvalidOptions);
}

}
}
