// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ByteSource.h"
#include "FilteredPredicates.h"
#include "FlipTestSupport.h"
#include "FuzzTarget.h"
#include "PointTriangulation.h"
#include "QueryTestSupport.h"
#include "RandomInputs.h"
#include "References.h"
#include "SphereSegmentAudit.h"
#include "SphereSegments.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iostream>
#include <numeric>

/// @file
/// Triangulations of points on a sphere, as a target for fuzzers, judged by rational numbers.

namespace delaunayflip
{
namespace
{

struct SphereCase
{
  std::vector<Point3> Points;
  bool AreFloats = false;
  bool AreAnywhere = false; ///< Not on a sphere, and perhaps nearly in a plane.
  std::vector<float> Floats; ///< The points, if they are floats.
  std::vector<std::int64_t> Segments; ///< Pairs of points.

  PointInput View() const
  {
    const auto count = static_cast<std::int64_t>(this->Points.size());
    PointInput input;
    input.Points = PlaneArray(this->Points.data()->data(), count, 3);
    if (this->AreFloats)
    {
      input.Points = PlaneArray(this->Floats.data(), count, 3);
    }
    input.Segments = this->Segments.data();
    input.NumberOfSegments = static_cast<std::int64_t>(this->Segments.size()) / 2;
    return input;
  }
};

/// A point with small integer coordinates at a distance from the origin that many such points have.
Point3 DrawLatticePoint(ByteSource& source)
{
  constexpr int Kinds[][3] = { { 0, 0, 9 }, { 1, 4, 8 }, { 3, 6, 6 }, { 4, 4, 7 } };
  Point3 p{};
  std::copy_n(Kinds[source.Draw(4)], 3, p.begin());
  std::rotate(p.begin(), p.begin() + source.Draw(3), p.end());
  if (source.Once(2))
  {
    std::swap(p[0], p[1]);
  }
  for (double& x : p)
  {
    x = source.Once(2) ? -x : x;
  }
  return p;
}

/// Longitudes and latitudes on a grid, of the whole globe or of a part.
Point3 DrawGridPoint(ByteSource& source, int step, int part)
{
  Point3 p{};
  PlaceOnSphere(step * static_cast<int>(source.Draw(part)),
    step * (static_cast<int>(source.Draw(13)) - 6), p.data());
  return p;
}

/// A direction, of length 1 except for rounding.
Point3 DrawDirection(std::mt19937& random, double spread)
{
  std::normal_distribution<double> normal;
  Point3 p{ spread * normal(random), spread * normal(random), 1.0 };
  if (spread >= 1.0)
  {
    p[2] = normal(random);
  }
  const double length = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
  for (double& x : p)
  {
    x /= length;
  }
  return p;
}

/// Draws segments between points that follow each other, or anywhere. None has ends on opposite
/// sides of the sphere.
void DrawSegments(ByteSource& source, SphereCase& drawn)
{
  const auto count = static_cast<std::uint32_t>(drawn.Points.size());
  const std::uint32_t wanted = 1 + source.Draw(source.Once(4) ? 60 : 8);
  std::uint32_t from = source.Draw(count);
  for (std::uint32_t i = 0; i < wanted; ++i)
  {
    const std::uint32_t to = source.Draw(count);
    const PlanePoint a{ drawn.Points[from][0], drawn.Points[from][1], drawn.Points[from][2] };
    const PlanePoint b{ drawn.Points[to][0], drawn.Points[to][1], drawn.Points[to][2] };
    if (!AreOpposite(a, b, 1e-5))
    {
      drawn.Segments.insert(drawn.Segments.end(), { from, to });
    }
    from = source.Once(3) ? source.Draw(count) : to;
  }
}

SphereCase MakeSphereCase(const std::uint8_t* bytes, std::size_t size)
{
  ByteSource source(bytes, size);
  SphereCase drawn;
  std::vector<Point3>& points = drawn.Points;
  const std::uint32_t count = 1 + source.Draw(source.Once(8) ? 200 : 24);
  const std::uint32_t kind = source.Draw(5);
  const double spreads[] = { 1.0, 1.0, 0.1, 1e-3, 1e-7 };
  const double spread = spreads[source.Draw(5)];
  const int step = 1 + static_cast<int>(source.Draw(15)), part = source.Once(2) ? 4 : 36;
  std::mt19937 random = source.MakeRandom();
  const std::vector<PointFamily> families = ListPointFamilies();
  const PointFamily& family = families[source.Draw(static_cast<std::uint32_t>(families.size()))];
  while (points.size() < count)
  {
    if (kind == 0)
    {
      points.push_back(DrawLatticePoint(source));
    }
    else if (kind == 1)
    {
      points.push_back(DrawGridPoint(source, step, part));
    }
    else if (kind == 2)
    {
      const FourPoints four = family.Draw(random);
      points.insert(points.end(), four.begin(), four.end());
    }
    else
    {
      points.push_back(DrawDirection(random, spread));
    }
    if (source.Once(8)) // a point that nearly coincides with another one
    {
      Point3 near = points[source.Draw(static_cast<std::uint32_t>(points.size()))];
      near[source.Draw(3)] *= 1.0 + 0x1p-52 * source.Draw(3);
      points.push_back(near);
    }
  }
  if (source.Once(8))
  {
    points[source.Draw(static_cast<std::uint32_t>(points.size()))][source.Draw(3)] = NAN;
  }
  drawn.AreAnywhere = kind == 2;
  drawn.AreFloats = kind != 2 && source.Once(3);
  for (Point3& p : points)
  {
    for (double& x : p)
    {
      x = drawn.AreFloats ? float(x) : x;
      drawn.Floats.push_back(float(x));
    }
  }
  if (source.Once(2))
  {
    DrawSegments(source, drawn);
  }
  return drawn;
}

/// Places at points, between two of them, and opposite to these.
std::vector<Point3> ListSomePlaces(const std::vector<Point3>& points)
{
  constexpr std::size_t Most = 6;
  std::vector<Point3> places;
  for (std::size_t i = 0; i < points.size() && places.size() < Most; i += 1 + points.size() / 4)
  {
    const Point3 &p = points[i], &q = points[(7 * i + 1) % points.size()];
    places.push_back(p);
    places.push_back({ p[0] + q[0], p[1] + q[1], p[2] + q[2] });
    places.push_back({ -p[0], -q[1], q[2] - p[2] });
  }
  return places;
}

struct SphereResult : SegmentResult
{
  std::vector<std::int32_t> Found; ///< The triangles of some places.
  std::vector<double> Linear, Natural; ///< Values there; that of a point is its number.
};

SphereResult Triangulate(const SphereCase& drawn, int threads, ProjectionKind projection)
{
  const PointOptions options = WithThreads(threads, With(&PointOptions::Projection, projection));
  SphereResult result{ TriangulateOnSphere(drawn.View(), options), {}, {}, {} };
  FlipSession session(drawn.View(), options);
  session.Advance();
  const std::vector<Point3> places = ListSomePlaces(drawn.Points);
  std::vector<double> values(drawn.Points.size());
  std::iota(values.begin(), values.end(), 0.0);
  PlaceQuery query;
  query.Places = PlaneArray(places.data()->data(), static_cast<std::int64_t>(places.size()), 3);
  result.Found = Locate(session, query);
  query.Method = InterpolationKind::Linear;
  result.Linear = Interpolate(session, query, values, values.size());
  query.Method = InterpolationKind::Natural;
  result.Natural = Interpolate(session, query, values, values.size());
  return result;
}

/// All triangles face outside, all points are on their inner sides, and their number is right.
void ExpectHull(const std::vector<Point3>& points, const SegmentResult& result)
{
  const PointCounts& counts = result.Report.FromPoints;
  EXPECT_EQ(2 * counts.Used - 4, result.Report.Triangles);
  EXPECT_EQ(2, result.Report.EulerCharacteristic);
  for (const std::int32_t neighbor : result.Neighbors)
  {
    EXPECT_LE(0, neighbor);
  }
  for (std::size_t i = 0; i < result.Triangles.size(); i += 3)
  {
    const Point3 &a = points[result.Triangles[i]], &b = points[result.Triangles[i + 1]],
                 &c = points[result.Triangles[i + 2]];
    for (const Point3& p : points)
    {
      if (std::isfinite(p[0] + p[1] + p[2]))
      {
        EXPECT_LE(0, RationalOrientation3D(a, b, c, p));
      }
    }
  }
}

/// A place is in the lowest of the triangles that have it and face away from the origin.
void ExpectPlaces(const std::vector<Point3>& points, const SphereResult& result)
{
  const std::vector<Point3> places = ListSomePlaces(points);
  const Point3 origin{};
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    const Point3& place = places[i];
    const bool isFinite = std::all_of(
      place.begin(), place.end(), [](double coordinate) { return std::isfinite(coordinate); });
    bool isFound = place == origin || !isFinite;
    std::int32_t expected = -1;
    for (std::size_t t = 0; t < result.Triangles.size() && !isFound; t += 3)
    {
      const Point3 &a = points[result.Triangles[t]], &b = points[result.Triangles[t + 1]],
                   &c = points[result.Triangles[t + 2]];
      isFound = RationalOrientation3D(a, b, place, origin) >= 0 &&
        RationalOrientation3D(b, c, place, origin) >= 0 &&
        RationalOrientation3D(c, a, place, origin) >= 0 &&
        RationalOrientation3D(a, b, c, origin) > 0;
      expected = isFound ? static_cast<std::int32_t>(t / 3) : -1;
    }
    EXPECT_EQ(expected, result.Found[i]);
  }
}

/// A linear value is a mean of those of the triangle's corners. A natural one leaves the range of
/// all values by at most 1/64 of it: weights may be negative beside segments, and where points are
/// not on a sphere. Outside there is none.
void ExpectMeans(std::size_t numberOfPoints, const SphereResult& result)
{
  constexpr double Tolerance = 1e-9;
  const double most = static_cast<double>(numberOfPoints) - 1.0;
  for (std::size_t i = 0; i < result.Found.size(); ++i)
  {
    if (result.Found[i] < 0)
    {
      EXPECT_TRUE(std::isnan(result.Linear[i]));
      EXPECT_TRUE(std::isnan(result.Natural[i]));
      continue;
    }
    const auto corners = result.Triangles.begin() + 3 * std::ptrdiff_t(result.Found[i]);
    const auto [least, greatest] = std::minmax_element(corners, corners + 3);
    EXPECT_LE(*least - Tolerance, result.Linear[i]);
    EXPECT_GE(*greatest + Tolerance, result.Linear[i]);
    EXPECT_LE(-most / 64.0 - Tolerance, result.Natural[i]);
    EXPECT_GE(most + most / 64.0 + Tolerance, result.Natural[i]);
  }
}

/// All points lie in one plane but for rounding, or there are fewer than four places.
void ExpectFlat(const std::vector<Point3>& points)
{
  // Coordinates are at most 9, and differ from those of a lattice by at most two units in the last
  // place: 2^-48. That moves a corner of a parallelepiped with sides of at most 32 by twice as
  // much.
  constexpr double LargestVolume = 32.0 * 32.0 * 0x1p-47;
  std::vector<Point3> finite;
  std::copy_if(points.begin(), points.end(), std::back_inserter(finite),
    [](const Point3& p) { return std::isfinite(p[0] + p[1] + p[2]); });
  std::sort(finite.begin(), finite.end());
  finite.erase(std::unique(finite.begin(), finite.end()), finite.end());
  for (std::size_t i = 0; i + 3 < finite.size(); ++i)
  {
    const auto offset = [&](int k)
    {
      const Point3 &p = finite[i + k], &q = finite[i + 3];
      return Vector3{ p[0] - q[0], p[1] - q[1], p[2] - q[2] };
    };
    EXPECT_LT(std::fabs(Dot(offset(0), Cross(offset(1), offset(2)))), LargestVolume);
  }
}

/// An open mesh has the triangles of the hull that face away from the origin. Points in one plane
/// have no hull, but triangles in that plane, unless it passes through the origin.
void ExpectOpen(
  const std::vector<Point3>& points, const SphereResult& hull, const SphereResult& open)
{
  const Point3 origin{};
  const auto face = [&](const std::int32_t* ids)
  { return RationalOrientation3D(points[ids[0]], points[ids[1]], points[ids[2]], origin) > 0; };
  if (hull.Report.Triangles > 0)
  {
    std::vector<std::int32_t> facing;
    for (std::size_t i = 0; i < hull.Triangles.size(); i += 3)
    {
      if (face(&hull.Triangles[i]))
      {
        facing.insert(facing.end(), &hull.Triangles[i], &hull.Triangles[i] + 3);
      }
    }
    EXPECT_EQ(ListTrianglePlaces(points, facing), ListTrianglePlaces(points, open.Triangles));
    return;
  }
  for (std::size_t i = 0; i < open.Triangles.size(); i += 3)
  {
    const std::int32_t* ids = &open.Triangles[i];
    EXPECT_TRUE(face(ids));
    for (const Point3& p : points)
    {
      if (std::isfinite(p[0] + p[1] + p[2]))
      {
        EXPECT_LE(0, RationalOrientation3D(points[ids[0]], points[ids[1]], points[ids[2]], p));
      }
    }
  }
}

/// Whether three points span a parallelepiped with the origin, and it is not a tiny one.
bool SpanSpace(const std::vector<Point3>& points)
{
  constexpr double SmallestVolume = 1e-3;
  const auto finite = std::count_if(points.begin(), points.end(),
    [](const Point3& p) { return std::isfinite(p[0] + p[1] + p[2]); });
  if (finite != static_cast<std::ptrdiff_t>(points.size()) || finite > 40)
  {
    return false; // not looked at
  }
  const auto get = [&](std::size_t i) {
    return Vector3{ points[i][0], points[i][1], points[i][2] };
  };
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    for (std::size_t k = 0; k < i; ++k)
    {
      for (std::size_t m = 0; m < k; ++m)
      {
        if (std::fabs(Dot(get(i), Cross(get(k), get(m)))) > SmallestVolume)
        {
          return true;
        }
      }
    }
  }
  return false;
}

/// The values are the same, also where they are not numbers.
void ExpectSameBits(const std::vector<double>& expected, const std::vector<double>& values)
{
  ASSERT_EQ(expected.size(), values.size());
  EXPECT_EQ(0, std::memcmp(expected.data(), values.data(), sizeof(double) * values.size()));
}

SphereCase Reverse(const SphereCase& drawn)
{
  SphereCase reversed = drawn;
  std::reverse(reversed.Points.begin(), reversed.Points.end());
  for (std::size_t i = 0; i < reversed.Floats.size(); ++i)
  {
    reversed.Floats[i] = float(reversed.Points[i / 3][i % 3]);
  }
  for (std::int64_t& end : reversed.Segments)
  {
    end = static_cast<std::int64_t>(drawn.Points.size()) - 1 - end;
  }
  return reversed;
}

/// The result is the same on one thread and on several and for points in another order.
SphereResult ExpectSame(const SphereCase& drawn, ProjectionKind projection)
{
  SphereResult result = Triangulate(drawn, 1, projection);
  const SphereResult other = Triangulate(drawn, 3, projection);
  EXPECT_EQ(result.Triangles, other.Triangles);
  EXPECT_EQ(result.Used, other.Used);
  EXPECT_EQ(result.Edges, other.Edges);
  EXPECT_EQ(result.Found, other.Found);
  ExpectSameBits(result.Linear, other.Linear);
  ExpectSameBits(result.Natural, other.Natural);
  ExpectSameStatistics(result.Report, other.Report);
  const SphereCase reversed = Reverse(drawn);
  EXPECT_EQ(ListTrianglePlaces(drawn.Points, result.Triangles),
    ListTrianglePlaces(reversed.Points, Triangulate(reversed, 1, projection).Triangles));
  return result;
}

/// Reports a failure of GoogleTest for each promise that is broken. The triangles are the convex
/// hull. With segments, which need all triangles to face away from the origin, they are Delaunay
/// but for these.
void JudgeSphereCase(const SphereCase& drawn)
{
  SphereCase without = drawn;
  without.Segments.clear();
  const SphereResult hull = ExpectSame(without, ProjectionKind::Sphere);
  if (hull.Report.Triangles > 0)
  {
    ExpectHull(drawn.Points, hull);
    ExpectPlaces(drawn.Points, hull);
    ExpectMeans(drawn.Points.size(), hull);
  }
  else if (!drawn.AreAnywhere)
  {
    ExpectFlat(drawn.Points);
  }
  const SphereResult open = ExpectSame(without, ProjectionKind::OpenSphere);
  ExpectOpen(drawn.Points, hull, open);
  if (!drawn.AreAnywhere && SpanSpace(drawn.Points))
  {
    EXPECT_LT(0, open.Report.Triangles);
  }
  if (!drawn.Segments.empty())
  {
    const SphereResult result = ExpectSame(drawn, ProjectionKind::OpenSphere);
    ExpectDelaunayOnSphere(drawn.Points, result);
    ExpectSegmentsOnSphere(drawn.Points, drawn.Segments, result);
    ExpectPlaces(drawn.Points, result);
    ExpectMeans(drawn.Points.size(), result);
    EXPECT_EQ(0, result.Report.NonDelaunayAfter);
    const std::int64_t made = result.Report.Triangles + result.Report.FromPoints.LargeTriangles;
    EXPECT_EQ(open.Report.Triangles + open.Report.FromPoints.LargeTriangles, made);
  }
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
  JudgeSphereCase(MakeSphereCase(bytes, size));
}

void PrintTarget(const std::uint8_t* bytes, std::size_t size)
{
  const SphereCase drawn = MakeSphereCase(bytes, size);
  std::cout.precision(17);
  std::cout << (drawn.AreFloats ? "floats\n" : "doubles\n");
  for (const Point3& p : drawn.Points)
  {
    std::cout << "point " << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
  }
  for (std::size_t i = 0; i < drawn.Segments.size(); i += 2)
  {
    std::cout << "segment " << drawn.Segments[i] << ' ' << drawn.Segments[i + 1] << '\n';
  }
}
