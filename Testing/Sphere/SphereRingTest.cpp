// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FilteredPredicates.h"
#include "FlipError.h"
#include "PointTriangulation.h"
#include "RandomNumbers.h"
#include "SphereSegmentAudit.h"
#include "SphereTestSupport.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>

/// @file
/// Outlines, holes and hole seeds in triangulations of points on a sphere.

namespace delaunayflip
{
namespace
{

constexpr double Pi = 3.14159265358979323846;

/// Points, and rings between points that are added behind them.
struct RingCase
{
  std::vector<Point3> Points = MakeRandomPoints<double>(400, 21);
  std::vector<std::int64_t> Segments;
  std::vector<std::int32_t> Rings;
  std::vector<double> Seeds;
  std::int32_t FirstHole = INT32_MAX;
  PointOptions Options = With(&PointOptions::Projection, ProjectionKind::Sphere);

  /// Adds a ring of longitudes and latitudes.
  void Add(const std::vector<std::array<double, 2>>& ring)
  {
    const std::int32_t number = this->Rings.empty() ? 0 : this->Rings.back() + 1;
    const auto first = static_cast<std::int64_t>(this->Points.size());
    const auto count = static_cast<std::int64_t>(ring.size());
    for (std::int64_t i = 0; i < count; ++i)
    {
      Point3 place{};
      PlaceOnSphere(ring[i][0], ring[i][1], place.data());
      this->Points.push_back(place);
      this->Segments.insert(this->Segments.end(), { first + i, first + (i + 1) % count });
      this->Rings.push_back(number);
    }
  }

  void AddSeed(double longitude, double latitude)
  {
    double place[3];
    PlaceOnSphere(longitude, latitude, place);
    for (const double coordinate : place)
    {
      this->Seeds.push_back(coordinate);
    }
  }

  SegmentResult Triangulate() const
  {
    PointInput input;
    input.Points =
      PlaneArray(this->Points.data()->data(), static_cast<std::int64_t>(this->Points.size()), 3);
    input.Segments = this->Segments.data();
    input.NumberOfSegments = static_cast<std::int64_t>(this->Rings.size());
    input.Rings = this->Rings.data();
    input.FirstHole = this->FirstHole;
    input.HoleSeeds = this->Seeds.data();
    input.NumberOfHoleSeeds = static_cast<std::int64_t>(this->Seeds.size()) / 3;
    return TriangulateOnSphere(input, this->Options);
  }

  /// The area of what is left, by the angles at the corners of triangles.
  double FindArea(const SegmentResult& result) const
  {
    double area = 0.0;
    for (std::size_t i = 0; i < result.Triangles.size(); i += 3)
    {
      area -= Pi;
      for (int slot = 0; slot < 3; ++slot)
      {
        const auto get = [&](int k)
        {
          const Point3& p = this->Points[result.Triangles[i + (slot + k) % 3]];
          return Vector3{ p[0], p[1], p[2] };
        };
        const Vector3 right = Cross(get(0), get(1)), left = Cross(get(0), get(2));
        area += std::atan2(Length(Cross(right, left)), Dot(right, left));
      }
    }
    return area;
  }
};

/// A ring along a parallel, eastwards: what is north of it is to its left.
std::vector<std::array<double, 2>> MakeParallel(double latitude, int count = 24)
{
  std::vector<std::array<double, 2>> ring;
  for (int i = 0; i < count; ++i)
  {
    ring.push_back({ -180.0 + 360.0 * i / count, latitude });
  }
  return ring;
}

/// The area to the north of such a ring.
double FindCap(double latitude, int count = 24)
{
  // The triangle between the pole and two corners has two equal angles.
  const double step = 2.0 * Pi / count, side = (90.0 - latitude) * Pi / 180.0;
  const double base = std::atan2(1.0, std::cos(side) * std::tan(step / 2.0));
  return count * (step + 2.0 * base - Pi);
}

constexpr double Tolerance = 1e-12;

TEST(SphereRings, EncloseTheirSmallerSide)
{
  for (const bool isReversed : { false, true })
  {
    for (const double latitude : { 40.0, -70.0, 0.0 })
    {
      std::vector<std::array<double, 2>> ring = MakeParallel(latitude);
      if (isReversed)
      {
        std::reverse(ring.begin(), ring.end());
      }
      RingCase drawn;
      drawn.Add(ring);
      const SegmentResult kept = drawn.Triangulate();
      const double area = FindCap(std::fabs(latitude));
      EXPECT_NEAR(area, drawn.FindArea(kept), Tolerance) << latitude;
      EXPECT_EQ(24, kept.Report.Edges.Boundary);
      EXPECT_EQ(1, kept.Report.EulerCharacteristic);
      EXPECT_EQ(24, kept.Report.FromPoints.SegmentEdges);
      ExpectDelaunayOnSphere(drawn.Points, kept);
      // If both sides are equal, the left one is inside.
      const bool isNorth = latitude > 0.0 || (latitude == 0.0 && !isReversed);
      double north = 0.0;
      for (const std::int32_t id : kept.Triangles)
      {
        north += drawn.Points[id][2] - std::sin(latitude * Pi / 180.0);
      }
      EXPECT_EQ(isNorth, north > 0.0);
      drawn.FirstHole = 0;
      const SegmentResult others = drawn.Triangulate();
      EXPECT_NEAR(4.0 * Pi - area, drawn.FindArea(others), Tolerance);
      EXPECT_EQ(kept.Report.Triangles, others.Report.FromPoints.OutsideTriangles);
      EXPECT_EQ(kept.Report.FromPoints.OutsideTriangles, others.Report.Triangles);
    }
  }
}

/// A corner just north of the equator makes the north smaller by more than what counts as a tie.
TEST(SphereRings, EncloseTheSmallerOfTwoSidesThatAreNearlyEqual)
{
  RingCase drawn;
  drawn.Points = { { 0.0, 0.0, -1.0 } };
  drawn.Segments = { 1, 3, 3, 2, 2, 1 }; // westwards: the south is to the left
  drawn.Rings = { 0, 0, 0 };
  const double halfRoot = std::sqrt(0.75), height = 1e-9;
  for (const double y : { 0.0, halfRoot, -halfRoot })
  {
    drawn.Points.push_back({ y == 0.0 ? 1.0 : -0.5, y, height });
  }
  const SegmentResult kept = drawn.Triangulate();
  ASSERT_EQ(1, kept.Report.Triangles);
  EXPECT_EQ(0, std::count(kept.Triangles.begin(), kept.Triangles.end(), 0));
  for (Point3& p : drawn.Points)
  {
    p[2] = -p[2];
  }
  EXPECT_EQ(1, drawn.Triangulate().Report.Triangles);
}

TEST(SphereRings, EncloseTheirLeftSideByOrientation)
{
  RingCase drawn;
  drawn.Options.RingRule = RingRuleKind::Orientation;
  drawn.Add(MakeParallel(-50.0)); // most of the sphere is to the left
  EXPECT_NEAR(4.0 * Pi - FindCap(50.0), drawn.FindArea(drawn.Triangulate()), Tolerance);
  std::vector<std::array<double, 2>> lake = MakeParallel(60.0);
  std::reverse(lake.begin(), lake.end());
  drawn.Add(lake);
  const double band = 4.0 * Pi - FindCap(50.0) - FindCap(60.0);
  EXPECT_NEAR(band, drawn.FindArea(drawn.Triangulate()), Tolerance);
  drawn.FirstHole = 1; // a hole is the smaller side
  EXPECT_NEAR(band, drawn.FindArea(drawn.Triangulate()), Tolerance);
  drawn.Options.RingRule = RingRuleKind::EvenOdd;
  EXPECT_NEAR(FindCap(50.0), drawn.FindArea(drawn.Triangulate()), Tolerance);
}

TEST(SphereRings, MayBeWithinEachOther)
{
  RingCase drawn;
  drawn.Add(MakeParallel(30.0));
  drawn.Add(MakeParallel(50.0));
  drawn.Add(MakeParallel(70.0));
  drawn.Add(MakeParallel(-60.0));
  const double odd = FindCap(30.0) - FindCap(50.0) + FindCap(70.0) + FindCap(60.0);
  const SegmentResult kept = drawn.Triangulate();
  EXPECT_NEAR(odd, drawn.FindArea(kept), Tolerance);
  EXPECT_EQ(4 * 24, kept.Report.Edges.Boundary);
  drawn.Options.RingRule = RingRuleKind::NonZero;
  EXPECT_NEAR(FindCap(30.0) + FindCap(60.0), drawn.FindArea(drawn.Triangulate()), Tolerance);
}

/// A polygon of a map that ends at 180 degrees and at a pole, as those of Antarctica do.
TEST(SphereRings, CloseAcrossTheAntimeridianAndAPole)
{
  RingCase drawn;
  std::vector<std::array<double, 2>> ring = MakeParallel(-60.0);
  ring.insert(
    ring.end(), { { 180, -60 }, { 180, -75 }, { 180, -90 }, { -180, -90 }, { -180, -75 } });
  drawn.Add(ring);
  const SegmentResult kept = drawn.Triangulate();
  EXPECT_NEAR(FindCap(60.0), drawn.FindArea(kept), Tolerance);
  EXPECT_EQ(24, kept.Report.Edges.Boundary);
  EXPECT_EQ(0, kept.Report.FromPoints.LeftOutRings);
}

TEST(SphereRings, WithoutAnAreaOrRepeatedAreLeftOut)
{
  RingCase drawn;
  drawn.Add(MakeParallel(50.0));
  drawn.Add({ { 0, 10 }, { 20, 20 } });
  drawn.Add({ { 180, -30 }, { 180, -60 }, { -180, -60 }, { -180, -30 } });
  std::vector<std::array<double, 2>> again = MakeParallel(50.0);
  std::reverse(again.begin(), again.end());
  drawn.Add(again);
  drawn.Add({ { 70, 10 }, { 70, 10 }, { 70, 10 } }); // no segment of it becomes an edge
  const SegmentResult kept = drawn.Triangulate();
  EXPECT_NEAR(FindCap(50.0), drawn.FindArea(kept), Tolerance);
  EXPECT_EQ(4, kept.Report.FromPoints.LeftOutRings);
  const std::vector<Defect>& defects = kept.Report.Defects;
  const auto find = [&](DefectKind kind)
  {
    return std::find_if(
      defects.begin(), defects.end(), [&](const Defect& one) { return one.Kind == kind; });
  };
  ASSERT_NE(defects.end(), find(DefectKind::RingsWithoutArea));
  EXPECT_EQ((std::vector<std::int64_t>{ 1, 2, 4 }), find(DefectKind::RingsWithoutArea)->FirstIds);
  ASSERT_NE(defects.end(), find(DefectKind::RingsRepeated));
  EXPECT_EQ((std::vector<std::int64_t>{ 3 }), find(DefectKind::RingsRepeated)->FirstIds);
}

TEST(SphereRings, DoNotDependOnTheOrderOfPointsOrOnThreads)
{
  RingCase drawn;
  drawn.Add(MakeParallel(20.0));
  drawn.Add({ { 30, 60 }, { 80, 50 }, { 50, 85 } });
  drawn.Add({ { 150, -40 }, { -160, -50 }, { -170, 10 }, { 160, 5 } });
  const SegmentResult expected = drawn.Triangulate();
  RingCase shuffled = drawn;
  std::vector<std::int64_t> order(drawn.Points.size());
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    order[i] = static_cast<std::int64_t>(i);
  }
  std::mt19937 random(3);
  Shuffle(order.begin(), order.end(), random);
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    shuffled.Points[order[i]] = drawn.Points[i];
  }
  for (std::int64_t& end : shuffled.Segments)
  {
    end = order[end];
  }
  shuffled.Options.NumberOfThreads = 7;
  EXPECT_EQ(ListTrianglePlaces(drawn.Points, expected.Triangles),
    ListTrianglePlaces(shuffled.Points, shuffled.Triangulate().Triangles));
  EXPECT_EQ(expected.Report.Triangles + expected.Report.FromPoints.OutsideTriangles,
    2 * static_cast<std::int64_t>(drawn.Points.size()) - 4);
}

TEST(SphereRings, MayBeInAnOpenMesh)
{
  RingCase drawn;
  for (Point3& p : drawn.Points)
  {
    p[2] = std::fabs(p[2]); // still of length 1
  }
  drawn.Add(MakeParallel(40.0));
  EXPECT_THROW(drawn.Triangulate(), InvalidOptions);
  drawn.Options.Projection = ProjectionKind::OpenSphere;
  EXPECT_NEAR(FindCap(40.0), drawn.FindArea(drawn.Triangulate()), Tolerance);
  drawn.FirstHole = 0;
  const SegmentResult around = drawn.Triangulate();
  EXPECT_EQ(0, around.Report.EulerCharacteristic);
  drawn.AddSeed(0.0, -45.0);
  drawn.AddSeed(0.0, 20.0);
  const SegmentResult nothing = drawn.Triangulate();
  EXPECT_EQ(0, nothing.Report.Triangles);
  EXPECT_EQ(0, nothing.Report.FromPoints.Inside);
  EXPECT_EQ(DefectKind::NothingLeft, nothing.Report.Defects.back().Kind);
}

TEST(SphereRings, SeedsRemoveWhatIsAroundThem)
{
  RingCase drawn;
  drawn.Add(MakeParallel(40.0));
  drawn.Add(MakeParallel(-40.0));
  std::fill(drawn.Rings.begin(), drawn.Rings.end(), -1); // segments of no ring
  drawn.AddSeed(10.0, 20.0);
  EXPECT_NEAR(2.0 * FindCap(40.0), drawn.FindArea(drawn.Triangulate()), Tolerance);
  drawn.AddSeed(77.0, 88.0);
  const SegmentResult kept = drawn.Triangulate();
  EXPECT_NEAR(FindCap(40.0), drawn.FindArea(kept), Tolerance);
  EXPECT_EQ(24, kept.Report.FromPoints.SegmentEdges);
  for (const std::int32_t id : kept.Triangles)
  {
    EXPECT_GT(-0.6, drawn.Points[id][2]);
  }
  drawn.Seeds.resize(9, 0.0);
  EXPECT_THROW(drawn.Triangulate(), InvalidOptions);
  drawn.Seeds.back() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(drawn.Triangulate(), InvalidOptions);
}

TEST(SphereRings, MustBeClosedAndCrossNothing)
{
  RingCase open;
  open.Add(MakeParallel(40.0));
  open.Rings.back() = -1;
  EXPECT_THROW(open.Triangulate(), InvalidMesh);
  RingCase crossed;
  crossed.Add({ { 0, 0 }, { 40, 0 }, { 40, 40 } });
  crossed.Add({ { 30, -10 }, { 30, 50 }, { -30, 20 } });
  try
  {
    crossed.Triangulate();
    FAIL();
  }
  catch (const InvalidMesh& error)
  {
    EXPECT_NE(std::string::npos, std::string(error.what()).find("ring 1")) << error.what();
    EXPECT_NE(std::string::npos, std::string(error.what()).find("segment 0")) << error.what();
  }
}

}
}
