// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FlipError.h"
#include "PointTriangulation.h"
#include "Predicates.h"
#include "QueryTestSupport.h"
#include "SphereTestSupport.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

/// @file
/// What a triangulation on a sphere answers: the triangles of places, and values there.

namespace delaunayflip
{
namespace
{

double Multiply(const Point3& a, const Point3& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Point3 Scale(double factor, const Point3& a)
{
  return { factor * a[0], factor * a[1], factor * a[2] };
}

Point3 Add(const Point3& a, const Point3& b) { return { a[0] + b[0], a[1] + b[1], a[2] + b[2] }; }

Point3 Normalize(const Point3& a) { return Scale(1.0 / std::sqrt(Multiply(a, a)), a); }

double FindDistance(const Point3& a, const Point3& b)
{
  const Point3 offset = Add(a, Scale(-1.0, b));
  return std::sqrt(Multiply(offset, offset));
}

double Smooth(const Point3& p) { return std::exp(p[0]) + p[1] * p[2] - p[2]; }

std::vector<double> ListValues(const std::vector<Point3>& points, double (*function)(const Point3&))
{
  std::vector<double> values(points.size());
  std::transform(points.begin(), points.end(), values.begin(), function);
  return values;
}

PointOptions Projected(ProjectionKind projection = ProjectionKind::Sphere, int threads = 0)
{
  return WithThreads(threads, With(&PointOptions::Projection, projection));
}

/// Segments and rings of a triangulation.
struct SphereLines
{
  std::vector<std::int64_t> Segments;
  std::vector<std::int32_t> Rings;

  /// Adds segments from each of these points to the next one.
  void Add(const std::vector<std::int64_t>& ids, std::int32_t ring = -1)
  {
    for (std::size_t i = 0; i + 1 < ids.size(); ++i)
    {
      this->Segments.insert(this->Segments.end(), { ids[i], ids[i + 1] });
      this->Rings.push_back(ring);
    }
  }
};

/// A session, what it makes, and answers to queries.
class AskedSphere
{
public:
  explicit AskedSphere(const std::vector<Point3>& points, const PointOptions& options = Projected(),
    const SphereLines& lines = SphereLines())
    : Points(points),
      Lines(lines),
      Session(FlipPoints(this->MakeInput(), options)),
      Triangles(StoreTriangles(Session))
  {
  }

  std::vector<std::int32_t> Locate(const std::vector<Point3>& places) const
  {
    PlaceQuery query;
    query.Places = View(places);
    return delaunayflip::Locate(this->Session, query);
  }

  std::vector<double> Interpolate(const std::vector<double>& values,
    const std::vector<Point3>& places, InterpolationKind method,
    OutsideKind outside = OutsideKind::NotANumber) const
  {
    PlaceQuery query;
    query.Places = View(places);
    query.Method = method;
    query.Outside = outside;
    return delaunayflip::Interpolate(this->Session, query, values, this->Points.size());
  }

  /// By exact orientation, of all triangles the first that has the place.
  std::int32_t FindByHand(const Point3& place) const
  {
    const auto findSide = [](const Point3& a, const Point3& b, const Point3& c)
    {
      const double origin[3] = {};
      return Orientation3D(a.data(), b.data(), c.data(), origin);
    };
    for (std::size_t t = 0; t < this->Triangles.size(); t += 3)
    {
      const Point3 corners[3] = { this->Points[this->Triangles[t]],
        this->Points[this->Triangles[t + 1]], this->Points[this->Triangles[t + 2]] };
      bool isInside = findSide(corners[0], corners[1], corners[2]) > 0;
      for (int i = 0; i < 3 && isInside; ++i)
      {
        isInside = findSide(corners[i], corners[(i + 1) % 3], place) >= 0;
      }
      if (isInside)
      {
        return static_cast<std::int32_t>(t / 3);
      }
    }
    return -1;
  }

  static PlaneArray View(const std::vector<Point3>& places)
  {
    return PlaneArray(places.data()->data(), static_cast<std::int64_t>(places.size()), 3);
  }

  std::vector<std::int32_t> StoreNeighbors() const
  {
    std::vector<std::int32_t> neighbors(this->Triangles.size());
    this->Session.StoreNeighbors(neighbors.data());
    return neighbors;
  }

  std::vector<Point3> Points;
  SphereLines Lines;
  FlipSession Session;
  std::vector<std::int32_t> Triangles;

private:
  /// All rings are holes.
  PointInput MakeInput() const
  {
    PointInput input;
    input.Points = View(this->Points);
    input.Segments = this->Lines.Segments.data();
    input.NumberOfSegments = static_cast<std::int64_t>(this->Lines.Rings.size());
    input.Rings = this->Lines.Rings.data();
    input.FirstHole = 0;
    return input;
  }
};

/// Places of every kind: anywhere, at vertices, on edges, nearly so, and at their antipodes.
std::vector<Point3> DrawPlaces(const AskedSphere& asked, int count)
{
  std::mt19937 random(3);
  std::vector<Point3> places = MakeRandomPoints<double>(count, 11);
  const auto pick = [&] { return asked.Points[DrawIndex(random, asked.Points.size())]; };
  for (int i = 0; i < count; ++i)
  {
    const Point3 a = pick(), b = pick();
    places.push_back(a);
    places.push_back(Add(a, b));
    places.push_back(Scale(-1.0, a));
  }
  for (std::size_t t = 0; t < asked.Triangles.size() && t < 3 * std::size_t(count); t += 3)
  {
    const Point3& a = asked.Points[asked.Triangles[t]];
    places.push_back(Add(a, asked.Points[asked.Triangles[t + 1]]));
    places.push_back(Add(Scale(0.75, a), Scale(0.25, asked.Points[asked.Triangles[t + 2]])));
  }
  for (const double size : { 1.0, -1.0, 1e-300, 1e300 })
  {
    places.insert(
      places.end(), { { size, 0, 0 }, { 0, size, 0 }, { 0, 0, size }, { size, size, 0 } });
  }
  return places;
}

class SphereAskTest : public testing::TestWithParam<SphereFamily>
{
protected:
  std::vector<Point3> Points = GetParam().Make();
};

TEST_P(SphereAskTest, FindsTheLowestTriangle)
{
  for (const ProjectionKind projection : { ProjectionKind::Sphere, ProjectionKind::OpenSphere })
  {
    const AskedSphere asked(this->Points, Projected(projection));
    const std::vector<Point3> places = DrawPlaces(asked, 100);
    const std::vector<std::int32_t> found = asked.Locate(places);
    for (std::size_t i = 0; i < places.size(); ++i)
    {
      ASSERT_EQ(asked.FindByHand(places[i]), found[i]) << i;
    }
  }
}

/// The value where the ray to the place meets the flat triangle, for a linear function.
TEST_P(SphereAskTest, InterpolatesLinearly)
{
  const Point3 slopes = { 2.0, -3.0, 0.5 };
  std::vector<Point3> directions(this->Points.size());
  std::transform(this->Points.begin(), this->Points.end(), directions.begin(), Normalize);
  std::vector<double> values;
  for (const Point3& direction : directions)
  {
    values.insert(values.end(), { Multiply(slopes, direction), 1.0 });
  }
  const AskedSphere asked(this->Points);
  const std::vector<Point3> places = MakeRandomPoints<double>(200, 12);
  const std::vector<std::int32_t> found = asked.Locate(places);
  const auto results = asked.Interpolate(values, places, InterpolationKind::Linear);
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    if (found[i] < 0)
    {
      EXPECT_TRUE(std::isnan(results[2 * i]));
      continue;
    }
    const std::int32_t* ids = &asked.Triangles[3 * found[i]];
    const Point3& a = directions[ids[0]];
    const Point3 u = Add(directions[ids[1]], Scale(-1.0, a));
    const Point3 v = Add(directions[ids[2]], Scale(-1.0, a));
    const Point3 normal = { u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
      u[0] * v[1] - u[1] * v[0] };
    const double reach = Multiply(normal, a) / Multiply(normal, places[i]);
    EXPECT_NEAR(Multiply(slopes, Scale(reach, places[i])), results[2 * i], 1e-9);
    EXPECT_NEAR(1.0, results[2 * i + 1], 1e-15);
  }
}

TEST_P(SphereAskTest, HasTheValuesOfPoints)
{
  const AskedSphere asked(this->Points);
  std::vector<std::int64_t> used(this->Points.size());
  asked.Session.StoreUsedPoints(used.data());
  const std::vector<double> values = ListValues(this->Points, Smooth);
  for (const auto method : { InterpolationKind::Linear, InterpolationKind::Natural })
  {
    const std::vector<double> results = asked.Interpolate(values, this->Points, method);
    for (std::size_t i = 0; i < used.size(); ++i)
    {
      const bool isAtVertex = used[i] >= 0 && asked.FindByHand(this->Points[i]) >= 0;
      if (isAtVertex)
      {
        EXPECT_EQ(values[used[i]], results[i]) << i;
      }
    }
  }
}

TEST_P(SphereAskTest, IsTheSameOnThreads)
{
  const AskedSphere one(this->Points, Projected(ProjectionKind::OpenSphere, 1));
  const std::vector<Point3> places = MakeRandomPoints<double>(50000, 13);
  const std::vector<double> values = ListValues(this->Points, Smooth);
  const auto expected =
    one.Interpolate(values, places, InterpolationKind::Natural, OutsideKind::Nearest);
  for (const int threads : { 2, 3 })
  {
    const AskedSphere several(this->Points, Projected(ProjectionKind::OpenSphere, threads));
    EXPECT_EQ(one.Locate(places), several.Locate(places));
    EXPECT_EQ(expected,
      several.Interpolate(values, places, InterpolationKind::Natural, OutsideKind::Nearest));
  }
}

INSTANTIATE_TEST_SUITE_P(All, SphereAskTest, testing::ValuesIn(ListSphereFamilies()),
  [](const testing::TestParamInfo<SphereFamily>& family) { return family.param.Name; });

/// Projects all points from a place's antipode, and asks for natural neighbours in that plane.
double AskInPlane(
  const std::vector<Point3>& points, const std::vector<double>& values, const Point3& place)
{
  const Point3 axis = Normalize(place);
  const Point3 first =
    Normalize(Add({ 0.3, 0.5, 0.9 }, Scale(-Multiply({ 0.3, 0.5, 0.9 }, axis), axis)));
  const Point3 second = { axis[1] * first[2] - axis[2] * first[1],
    axis[2] * first[0] - axis[0] * first[2], axis[0] * first[1] - axis[1] * first[0] };
  std::vector<double> plane;
  for (const Point3& point : points)
  {
    const double factor = 2.0 / (1.0 + Multiply(point, axis));
    plane.push_back(factor * Multiply(point, first));
    plane.push_back(factor * Multiply(point, second));
  }
  PointInput input;
  input.Points = PlaneArray(plane.data(), static_cast<std::int64_t>(points.size()), 2);
  const FlipSession session = FlipPoints(input, PointOptions());
  const double origin[] = { 0.0, 0.0 };
  double result = 0.0;
  PlaceQuery query;
  query.Places = PlaneArray(origin, 1, 2);
  query.Values = values.data();
  query.Results = &result;
  query.Method = InterpolationKind::Natural;
  EXPECT_TRUE(session.Ask(query));
  return result;
}

TEST(SphereAsk, HasTheNaturalNeighborsOfTheTangentPlane)
{
  const AskedSphere asked(MakeRandomPoints<double>(300, 1));
  const std::vector<double> values = ListValues(asked.Points, Smooth);
  const std::vector<Point3> places = MakeRandomPoints<double>(200, 2);
  const auto results = asked.Interpolate(values, places, InterpolationKind::Natural);
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    EXPECT_NEAR(AskInPlane(asked.Points, values, places[i]), results[i], 1e-10) << i;
  }
}

/// The triangles of points that are not on a sphere are not Delaunay as seen from a place, so
/// natural weights may be negative. Values may leave the range of all by 1/64 of it.
TEST(SphereAsk, StaysInRangeOfPointsThatAreNotOnASphere)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> draw(0.0, 1.0);
  std::vector<Point3> points;
  std::vector<double> values;
  for (int i = 0; i < 100; ++i)
  {
    points.push_back({ draw(random), draw(random), draw(random) });
    values.push_back(i % 2);
  }
  const AskedSphere asked(points, Projected(ProjectionKind::OpenSphere));
  const std::vector<Point3> places = MakeRandomPoints<double>(20000, 6);
  for (const double value : asked.Interpolate(values, places, InterpolationKind::Natural))
  {
    const bool isInRange = value >= -1.0 / 64.0 && value <= 1.0 + 1.0 / 64.0;
    ASSERT_TRUE(isInRange || std::isnan(value)) << value;
  }
}

/// Values around stations that are near each other, and beside them, where there are three other
/// points on the whole sphere.
/// @param size of the network, in radians.
std::vector<double> InterpolateInNetwork(double size)
{
  const Point3 center = Normalize({ 0.3, -0.5, 0.8 });
  const Point3 first = Normalize({ center[1], -center[0], 0.0 });
  const Point3 second = { center[1] * first[2] - center[2] * first[1],
    center[2] * first[0] - center[0] * first[2], center[0] * first[1] - center[1] * first[0] };
  const auto place = [&](double u, double v)
  { return Normalize(Add(center, Add(Scale(size * u, first), Scale(size * v, second)))); };
  std::mt19937 random(18);
  std::vector<Point3> points, places;
  std::vector<double> values;
  for (int i = 0; i < 20; ++i)
  {
    const double u = DrawIndex(random, 1000), v = DrawIndex(random, 1000);
    points.push_back(place(0.001 * u, 0.001 * v));
    values.push_back(i % 7);
  }
  for (const Point3& far : { Point3{ 0.8, 0.3, 0.1 }, Point3{ -0.5, -0.8, 0.3 },
         Point3{ -0.3, 0.5, -0.8 }, Point3{ -0.4, 0.7, 0.2 } })
  {
    points.push_back(Normalize(far));
    values.push_back(3.0);
  }
  for (int i = 0; i < 1600; ++i)
  {
    places.push_back(place(-1.01 + 0.08 * (i % 40), -1.03 + 0.08 * (i / 40)));
  }
  const AskedSphere asked(points);
  return asked.Interpolate(values, places, InterpolationKind::Natural);
}

/// The smaller the network is, the less its curvature matters, and the farther away are the others.
/// In networks that are still smaller, rounding moves points off the sphere as much as curvature
/// does.
TEST(SphereAsk, FarPointsLeaveNaturalNeighbors)
{
  const std::vector<double> expected = InterpolateInNetwork(1e-4);
  for (const double size : { 1e-5, 1e-6 })
  {
    const std::vector<double> found = InterpolateInNetwork(size);
    for (std::size_t i = 0; i < found.size(); ++i)
    {
      ASSERT_NEAR(expected[i], found[i], 0.02) << size << ' ' << i;
    }
  }
}

/// On an edge, and where all longitudes meet, there are many triangles around a place.
TEST(SphereAsk, InterpolatesInGrids)
{
  std::vector<Point3> points;
  for (int latitude = -90; latitude <= 90; latitude += 3)
  {
    for (int longitude = -180; longitude <= 180; longitude += 3)
    {
      points.emplace_back();
      PlaceOnSphere(longitude, latitude, points.back().data());
    }
  }
  const AskedSphere asked(points);
  const std::vector<double> values = ListValues(points, Smooth);
  std::vector<Point3> places;
  for (const double latitude : { 89.999, 89.0, 88.5, 87.0, 45.0, 1.5, 0.0, -33.3, -88.0, -90.0 })
  {
    for (double longitude = -180.0; longitude <= 180.0; longitude += 0.75)
    {
      places.emplace_back();
      PlaceOnSphere(longitude, latitude, places.back().data());
    }
  }
  const auto linear = asked.Interpolate(values, places, InterpolationKind::Linear);
  const auto natural = asked.Interpolate(values, places, InterpolationKind::Natural);
  double ofLinear = 0.0, ofNatural = 0.0;
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    ofLinear = std::max(ofLinear, std::fabs(linear[i] - Smooth(places[i])));
    ofNatural = std::max(ofNatural, std::fabs(natural[i] - Smooth(places[i])));
  }
  EXPECT_LT(ofLinear, 3e-3);
  EXPECT_LT(ofNatural, 2e-3);
}

/// Compares what is taken outside with all edges of the boundary.
void ExpectNearestOnBoundary(const AskedSphere& asked)
{
  const std::vector<std::int32_t> neighbors = asked.StoreNeighbors();
  const std::vector<Point3>& points = asked.Points;
  std::vector<double> coordinates;
  for (const Point3& point : points)
  {
    coordinates.insert(coordinates.end(), point.begin(), point.end());
  }
  std::vector<Point3> places = MakeRandomPoints<double>(100, 4);
  places.push_back({ NAN, 0.0, 0.0 });
  const auto found = asked.Locate(places);
  const auto results =
    asked.Interpolate(coordinates, places, InterpolationKind::Natural, OutsideKind::Nearest);
  EXPECT_TRUE(std::isnan(results[3 * places.size() - 1]));
  for (std::size_t i = 0; i + 1 < places.size(); ++i)
  {
    if (found[i] >= 0)
    {
      continue;
    }
    double least = INFINITY;
    for (std::size_t corner = 0; corner < neighbors.size(); ++corner)
    {
      const std::size_t t = corner - corner % 3;
      const Point3& from = points[asked.Triangles[t + (corner + 1) % 3]];
      const Point3& to = points[asked.Triangles[t + (corner + 2) % 3]];
      for (int step = 0; step <= 1000 && neighbors[corner] < 0; ++step)
      {
        const double share = step / 1000.0;
        const Point3 near = Normalize(Add(Scale(1.0 - share, from), Scale(share, to)));
        least = std::min(least, FindDistance(near, places[i]));
      }
    }
    const Point3 nearest = Normalize({ results[3 * i], results[3 * i + 1], results[3 * i + 2] });
    EXPECT_LT(FindDistance(nearest, places[i]), least + 1e-12);
    EXPECT_NEAR(least, FindDistance(nearest, places[i]), 1e-4);
  }
}

TEST(SphereAsk, FindsTheNearestPlaceOnTheBoundary)
{
  std::vector<Point3> points = MakeRandomPoints<double>(400, 3);
  points.erase(
    std::remove_if(points.begin(), points.end(), [](const Point3& p) { return p[2] < 0.5; }),
    points.end());
  ExpectNearestOnBoundary(AskedSphere(points, Projected(ProjectionKind::OpenSphere)));
}

/// A continent with a coast of many edges, which is a hole, a bay that a segment closes, and a
/// segment far away.
AskedSphere MakeOcean()
{
  constexpr int Corners = 300;
  std::vector<Point3> points = MakeRandomPoints<double>(800, 17);
  SphereLines lines;
  std::vector<std::int64_t> coast;
  for (int i = 0; i < Corners; ++i)
  {
    const double angle = 2.0 * 3.14159265358979 * i / Corners;
    const double reach = 0.8 + 0.3 * std::cos(3.0 * angle) + 0.02 * (i % 2);
    coast.push_back(static_cast<std::int64_t>(points.size()));
    points.push_back(Normalize({ 1.0, reach * std::cos(angle), reach * std::sin(angle) }));
  }
  const std::int64_t bay[] = { coast[21], coast[79] };
  coast.push_back(coast.front());
  lines.Add(coast, 0);
  lines.Add({ bay[0], bay[1] });
  lines.Add({ 0, 1, 2 });
  return AskedSphere(points, Projected(), lines);
}

TEST(SphereAsk, FindsPlacesBesideHoles)
{
  const AskedSphere asked = MakeOcean();
  const std::vector<Point3> places = DrawPlaces(asked, 200);
  const std::vector<std::int32_t> found = asked.Locate(places);
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    ASSERT_EQ(asked.FindByHand(places[i]), found[i]) << i;
  }
  EXPECT_GT(std::count(found.begin(), found.end(), -1), 20);
  EXPECT_EQ(-1, asked.Locate({ { 1.0, 0.0, 0.0 } })[0]);
  EXPECT_GT(asked.Session.GetReport().FromPoints.OutsideTriangles, 300);
  EXPECT_EQ(0, asked.Session.GetReport().FromPoints.RefusedSegments);
}

TEST(SphereAsk, FindsTheNearestCoast) { ExpectNearestOnBoundary(MakeOcean()); }

/// A point in a plane.
struct PlanePair
{
  double U, V;
};

double Cross(const PlanePair& a, const PlanePair& b) { return a.U * b.V - a.V * b.U; }

PlanePair Subtract(const PlanePair& a, const PlanePair& b) { return { a.U - b.U, a.V - b.V }; }

PlanePair FindCircumcentre(const PlanePair& a, const PlanePair& b, const PlanePair& c)
{
  const PlanePair u = Subtract(b, a), v = Subtract(c, a);
  const double uu = u.U * u.U + u.V * u.V, vv = v.U * v.U + v.V * v.V;
  const double factor = 0.5 / Cross(u, v);
  return { a.U + factor * (v.V * uu - u.V * vv), a.V + factor * (u.U * vv - v.U * uu) };
}

/// Natural neighbours by Watson's sum over the triangles that an insertion of the place would
/// replace without crossing a segment, in the plane that touches the sphere there.
class WatsonSum
{
public:
  WatsonSum(const AskedSphere& asked, const Point3& place)
    : Asked(asked),
      Axis(place),
      First(Normalize(Add({ 0.3, 0.5, 0.9 }, Scale(-Multiply({ 0.3, 0.5, 0.9 }, place), place))))
  {
    const std::vector<std::int64_t> edges = asked.Session.ListSegmentEdges();
    for (std::size_t i = 0; i < edges.size(); i += 2)
    {
      this->Segments.insert({ edges[i], edges[i + 1] });
      this->Segments.insert({ edges[i + 1], edges[i] });
    }
  }

  double Sum(std::int32_t triangle, const std::vector<double>& values)
  {
    const std::vector<std::int32_t> neighbors = this->Asked.StoreNeighbors();
    std::vector<std::int32_t> cavity = { triangle };
    double sum = 0.0, weights = 0.0;
    for (std::size_t i = 0; i < cavity.size(); ++i)
    {
      const std::int32_t* ids = &this->Asked.Triangles[3 * cavity[i]];
      const PlanePair corners[3] = { this->Project(ids[0]), this->Project(ids[1]),
        this->Project(ids[2]) };
      const PlanePair centre = FindCircumcentre(corners[0], corners[1], corners[2]);
      for (int k = 0; k < 3; ++k)
      {
        const int next = (k + 1) % 3, last = (k + 2) % 3;
        const PlanePair a = FindCircumcentre({ 0.0, 0.0 }, corners[last], corners[k]);
        const PlanePair b = FindCircumcentre({ 0.0, 0.0 }, corners[k], corners[next]);
        const double weight = Cross(Subtract(a, centre), Subtract(b, centre));
        weights += weight;
        sum += weight * values[ids[k]];
        const std::int32_t across = neighbors[3 * cavity[i] + k];
        const bool isNew = across >= 0 && this->Segments.count({ ids[next], ids[last] }) == 0 &&
          std::count(cavity.begin(), cavity.end(), across) == 0;
        if (isNew && this->IsInCircle(across))
        {
          cavity.push_back(across);
        }
      }
    }
    return sum / weights;
  }

private:
  PlanePair Project(std::int32_t id) const
  {
    const Point3 second = { this->Axis[1] * this->First[2] - this->Axis[2] * this->First[1],
      this->Axis[2] * this->First[0] - this->Axis[0] * this->First[2],
      this->Axis[0] * this->First[1] - this->Axis[1] * this->First[0] };
    const Point3& point = this->Asked.Points[id];
    const double factor = 2.0 / (1.0 + Multiply(point, this->Axis));
    return { factor * Multiply(point, this->First), factor * Multiply(point, second) };
  }

  /// Beside a long segment, the circumcircle of a triangle may have the place's antipode inside. In
  /// the plane the triangle is then clockwise, and what is outside of the circle is inside of it on
  /// the sphere.
  bool IsInCircle(std::int32_t triangle) const
  {
    const std::int32_t* ids = &this->Asked.Triangles[3 * triangle];
    const PlanePair a = this->Project(ids[0]), b = this->Project(ids[1]), c = this->Project(ids[2]);
    const PlanePair centre = FindCircumcentre(a, b, c);
    const PlanePair radius = Subtract(a, centre);
    const bool isInside =
      centre.U * centre.U + centre.V * centre.V < radius.U * radius.U + radius.V * radius.V;
    return isInside == (Cross(Subtract(b, a), Subtract(c, a)) > 0.0);
  }

  const AskedSphere& Asked;
  const Point3 Axis, First;
  std::set<std::pair<std::int64_t, std::int64_t>> Segments;
};

TEST(SphereAsk, StopsAtSegments)
{
  const AskedSphere asked = MakeOcean();
  const std::vector<double> values = ListValues(asked.Points, Smooth);
  std::vector<Point3> places = MakeRandomPoints<double>(300, 2);
  std::mt19937 random(4);
  for (int i = 0; i < 300; ++i) // near the coast
  {
    const Point3& point = asked.Points[800 + DrawIndex(random, 300)];
    places.push_back(Normalize(Add(point, Scale(0.03, places[i]))));
  }
  const std::vector<std::int32_t> found = asked.Locate(places);
  const auto results = asked.Interpolate(values, places, InterpolationKind::Natural);
  const auto linear = asked.Interpolate(values, places, InterpolationKind::Linear);
  double most = 0.0;
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    EXPECT_EQ(found[i] < 0, std::isnan(results[i]));
    if (found[i] >= 0)
    {
      EXPECT_NEAR(WatsonSum(asked, places[i]).Sum(found[i], values), results[i], 1e-8) << i;
      most = std::max(most, std::fabs(linear[i] - results[i]));
    }
  }
  EXPECT_GT(most, 1e-3);
}

TEST(SphereAsk, TakesLongitudesAndLatitudes)
{
  const AskedSphere asked(MakeRandomPoints<double>(500, 5));
  const std::vector<double> values = ListValues(asked.Points, Smooth);
  PlaceQuery query;
  query.Raster = { { -180.0, 90.0 }, { 22.5, -15.0 }, 17, 13 };
  std::vector<double> raster(query.CountPlaces()), degrees(query.CountPlaces());
  query.Values = values.data();
  query.Results = raster.data();
  EXPECT_TRUE(asked.Session.Ask(query));
  std::vector<float> angles; // exact in single precision
  std::vector<Point3> places;
  for (std::int64_t i = 0; i < query.CountPlaces(); ++i)
  {
    const double longitude = query.Raster.Get(i, 0), latitude = query.Raster.Get(i, 1);
    angles.insert(angles.end(), { float(longitude), float(latitude) });
    places.emplace_back();
    PlaceOnSphere(longitude, latitude, places.back().data());
  }
  query.Raster = PlaceRaster();
  query.Places = PlaneArray(angles.data(), static_cast<std::int64_t>(places.size()), 2);
  query.Degrees = true;
  query.Results = degrees.data();
  EXPECT_TRUE(asked.Session.Ask(query));
  EXPECT_EQ(raster, degrees);
  EXPECT_EQ(raster, asked.Interpolate(values, places, InterpolationKind::Linear));
  for (std::size_t row = 0; row < 13; ++row)
  {
    EXPECT_EQ(raster[17 * row], raster[17 * row + 16]); // -180 and 180 degrees
  }
}

TEST(SphereAsk, RefusesWhatHasNoMeaning)
{
  const AskedSphere asked(MakeRandomPoints<double>(20, 7));
  std::int32_t triangle = 0;
  const double place[] = { 1.0, 2.0, 3.0 };
  PlaceQuery query;
  query.Triangles = &triangle;
  query.Places = PlaneArray(place, 1, 2);
  EXPECT_THROW(asked.Session.Ask(query), InvalidOptions);
  query.Degrees = true;
  EXPECT_TRUE(asked.Session.Ask(query));
  EXPECT_GE(triangle, 0);
  PointInput plane;
  plane.Points = PlaneArray(place, 1, 2);
  EXPECT_THROW(FlipPoints(plane, PointOptions()).Ask(query), InvalidOptions);
  query.Degrees = false;
  query.Places = PlaneArray(place, 1, 3);
  EXPECT_FALSE(asked.Session.Ask(query, [](double) { return false; }));
  const Point3 zero{};
  EXPECT_EQ(-1, asked.Locate({ zero })[0]);
  EXPECT_EQ(-1, asked.Locate({ { std::numeric_limits<double>::infinity(), 0.0, 0.0 } })[0]);
}

TEST(SphereAsk, IsOutsideWithoutTriangles)
{
  PointInput input;
  const double points[] = { 1, 0, 0, 0, 1, 0, 0, 0, 1 };
  input.Points = PlaneArray(points, 3, 3);
  FlipSession session(input, Projected());
  std::int32_t triangle = 0;
  PlaceQuery query;
  query.Triangles = &triangle;
  query.Places = PlaneArray(points, 1, 3);
  EXPECT_TRUE(session.Ask(query)); // before it has run
  EXPECT_EQ(-1, triangle);
  session.Advance();
  triangle = 0;
  EXPECT_TRUE(session.Ask(query));
  EXPECT_EQ(-1, triangle);
}

}
}
