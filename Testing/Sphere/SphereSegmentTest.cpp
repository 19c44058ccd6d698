// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FlipError.h"
#include "PointTriangulation.h"
#include "RandomNumbers.h"
#include "SphereSegmentAudit.h"
#include "SphereTestSupport.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

/// @file
/// Segments along great circles in triangulations of points on a sphere.

namespace delaunayflip
{
namespace
{

PointOptions Projected(ProjectionKind projection, int threads = 1)
{
  return WithThreads(threads, With(&PointOptions::Projection, projection));
}

SegmentResult Triangulate(const std::vector<Point3>& points,
  const std::vector<std::int64_t>& segments, const PointOptions& options)
{
  PointInput input;
  input.Points = PlaneArray(points.data()->data(), static_cast<std::int64_t>(points.size()), 3);
  input.Segments = segments.data();
  input.NumberOfSegments = static_cast<std::int64_t>(segments.size()) / 2;
  return TriangulateOnSphere(input, options);
}

/// Segments between random points that are near each other, or anywhere. None has opposite ends.
std::vector<std::int64_t> DrawSegments(const std::vector<Point3>& points, int count, unsigned seed)
{
  std::mt19937 random(seed);
  std::vector<std::int64_t> segments;
  for (int i = 0; i < count; ++i)
  {
    const std::size_t from = random() % points.size();
    std::size_t to = random() % points.size();
    const auto distance = [&](std::size_t k)
    {
      return std::hypot(points[k][0] - points[from][0], points[k][1] - points[from][1],
        points[k][2] - points[from][2]);
    };
    const int attempts = i % 4 == 0 ? 1 : 12;
    for (int k = 0; k < attempts; ++k)
    {
      const std::size_t other = random() % points.size();
      to = other != from && distance(other) < distance(to) ? other : to;
    }
    const Point3 &a = points[from], &b = points[to];
    const double sum = std::hypot(a[0] + b[0], a[1] + b[1], a[2] + b[2]);
    if (sum > 1e-3 * std::hypot(a[0], a[1], a[2]))
    {
      segments.insert(segments.end(), { std::int64_t(from), std::int64_t(to) });
    }
  }
  return segments;
}

class SphereSegmentTest : public testing::TestWithParam<SphereFamily>
{
protected:
  ProjectionKind GetProjection() const
  {
    return GetParam().IsPart ? ProjectionKind::OpenSphere : ProjectionKind::Sphere;
  }

  std::vector<Point3> Points = GetParam().Make();
  std::vector<std::int64_t> Segments = DrawSegments(this->Points, 150, 3);
};

TEST_P(SphereSegmentTest, KeepsSegmentsAndIsDelaunayElsewhere)
{
  const SegmentResult result =
    Triangulate(this->Points, this->Segments, Projected(this->GetProjection()));
  ExpectDelaunayOnSphere(this->Points, result);
  ExpectSegmentsOnSphere(this->Points, this->Segments, result);
  const SegmentResult without = Triangulate(this->Points, {}, Projected(this->GetProjection()));
  const FlipReport& report = result.Report;
  EXPECT_EQ(without.Report.Triangles, report.Triangles);
  EXPECT_EQ(without.Report.EulerCharacteristic, report.EulerCharacteristic);
  EXPECT_EQ(without.Used, result.Used);
  EXPECT_EQ(without.Report.Edges.Boundary, report.Edges.Boundary);
  EXPECT_EQ(static_cast<std::int64_t>(result.Edges.size()) / 2, report.FromPoints.SegmentEdges);
  EXPECT_EQ(report.FromPoints.SegmentEdges, report.Edges.Constraint);
  EXPECT_LE(report.Edges.Fixed, report.Edges.Boundary + report.Edges.Constraint);
  EXPECT_EQ(0, report.NonDelaunayAfter);
  EXPECT_LT(without.Report.TotalFlips, report.TotalFlips);
  EXPECT_EQ(report.TotalFlips,
    std::accumulate(report.Iterations.begin(), report.Iterations.end(), std::int64_t(0),
      [](std::int64_t sum, const IterationRecord& row) { return sum + row.Flipped; }));
}

TEST_P(SphereSegmentTest, CountsAllFlipsOfEachTriangle)
{
  PointInput input;
  input.Points =
    PlaneArray(this->Points.data()->data(), static_cast<std::int64_t>(this->Points.size()), 3);
  input.Segments = this->Segments.data();
  input.NumberOfSegments = static_cast<std::int64_t>(this->Segments.size()) / 2;
  FlipSession session(input, Projected(this->GetProjection()));
  session.Advance();
  const FlipReport& report = session.GetReport();
  std::vector<std::int32_t> counts(report.Triangles);
  session.StoreFlipCounts(counts.data());
  const auto sum = std::accumulate(counts.begin(), counts.end(), std::int64_t(0));
  if (report.FromPoints.LargeTriangles == 0)
  {
    EXPECT_EQ(2 * report.TotalFlips, sum);
  }
  else // those of triangles that were left out are missing
  {
    EXPECT_GE(2 * report.TotalFlips, sum);
  }
}

TEST_P(SphereSegmentTest, DependsOnThePlacesAndTheSegmentsAlone)
{
  const PointOptions options = Projected(this->GetProjection());
  const SegmentResult expected = Triangulate(this->Points, this->Segments, options);
  std::vector<std::int64_t> order(this->Points.size());
  std::iota(order.begin(), order.end(), 0);
  std::mt19937 random(5);
  Shuffle(order.begin(), order.end(), random);
  std::vector<Point3> points(this->Points.size());
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    points[order[i]] = this->Points[i];
  }
  std::vector<std::int64_t> segments;
  for (const std::int64_t end : this->Segments)
  {
    segments.push_back(order[end]);
  }
  const SegmentResult shuffled = Triangulate(points, segments, options);
  EXPECT_EQ(ListTrianglePlaces(this->Points, expected.Triangles),
    ListTrianglePlaces(points, shuffled.Triangles));
  for (std::size_t i = 0; i < segments.size(); i += 2)
  {
    std::swap(segments[i], segments[i + 1]);
  }
  EXPECT_EQ(shuffled.Triangles.size(), Triangulate(points, segments, options).Triangles.size());
  EXPECT_EQ(ListTrianglePlaces(points, shuffled.Triangles),
    ListTrianglePlaces(points, Triangulate(points, segments, options).Triangles));
}

TEST_P(SphereSegmentTest, IsTheSameOnThreads)
{
  const SegmentResult one =
    Triangulate(this->Points, this->Segments, Projected(this->GetProjection()));
  for (const int threads : { 3, 16 })
  {
    const SegmentResult several =
      Triangulate(this->Points, this->Segments, Projected(this->GetProjection(), threads));
    EXPECT_EQ(one.Triangles, several.Triangles);
    EXPECT_EQ(one.Edges, several.Edges);
    ExpectSameStatistics(one.Report, several.Report);
  }
}

INSTANTIATE_TEST_SUITE_P(Families, SphereSegmentTest, testing::ValuesIn(ListSphereFamilies()),
  [](const auto& each) { return std::string(each.param.Name); });

//------------------------------------------------------------------------------
const std::vector<Point3>& Octahedron()
{
  static const std::vector<Point3> points =
    PlaceAll({ { 0, 0 }, { 90, 0 }, { 180, 0 }, { 270, 0 }, { 0, 90 }, { 0, -90 } });
  return points;
}

TEST(SphereSegments, PassThroughPoints)
{
  std::vector<Point3> points = Octahedron();
  const std::vector<Point3> more = PlaceAll({ { -60, 0 }, { 60, 0 }, { 30, 0 }, { -30, 5 } });
  points.insert(points.end(), more.begin(), more.end());
  const SegmentResult result =
    Triangulate(points, { 6, 7, 1, 7, 6, 0 }, Projected(ProjectionKind::Sphere));
  EXPECT_EQ((std::vector<std::int64_t>{ 6, 0, 0, 8, 8, 7, 1, 7 }), result.Edges);
  EXPECT_EQ((std::vector<std::int64_t>{ 0, 0, 0, 1 }), result.SegmentsOfEdges);
  EXPECT_EQ(0, result.Report.FromPoints.RefusedSegments);
  EXPECT_EQ(3, result.Report.InsertedConstraints);
}

TEST(SphereSegments, AreRefusedWhereTheyCrossEarlierOnes)
{
  std::vector<Point3> points = Octahedron();
  const std::vector<Point3> more = PlaceAll({ { 20, 20 }, { 40, 40 }, { 40, 20 }, { 20, 40 } });
  points.insert(points.end(), more.begin(), more.end());
  points.push_back({ 0.1, 0.1, 0.1 });
  const SegmentResult result =
    Triangulate(points, { 0, 4, 6, 7, 9, 8, 0, 1, 10, 0, 6, 6 }, Projected(ProjectionKind::Sphere));
  EXPECT_EQ(2, result.Report.FromPoints.RefusedSegments);
  ASSERT_EQ(3u, result.Report.Defects.size());
  const Defect& defect = result.Report.Defects[1];
  EXPECT_EQ(DefectKind::SegmentsCross, defect.Kind);
  EXPECT_EQ((std::vector<std::int64_t>{ 9, 8 }), defect.FirstIds);
  EXPECT_EQ(1, defect.Crossed[0].Number);
  EXPECT_EQ(DefectKind::SegmentsInside, result.Report.Defects[2].Kind);
  EXPECT_EQ((std::vector<std::int64_t>{ 10, 0 }), result.Report.Defects[2].FirstIds);
  ExpectDelaunayOnSphere(points, result);
}

TEST(SphereSegments, NeedEndsThatAreNotOpposite)
{
  const std::vector<Point3> points = PlaceAll(
    { { 10, 20 }, { 190, -20 }, { 100, 0 }, { 280, 0 }, { 10, -70 }, { 190, 70 }, { 11, 21 } });
  const PointOptions options = Projected(ProjectionKind::Sphere);
  EXPECT_NO_THROW(Triangulate(points, { 0, 2, 6, 1 }, options));
  try
  {
    Triangulate(points, { 0, 2, 0, 1 }, options);
    FAIL();
  }
  catch (const InvalidMesh& error)
  {
    EXPECT_NE(std::string::npos,
      std::string(error.what()).find("segment 1 from point 0 to point 1 has ends on opposite"))
      << error.what();
  }
  EXPECT_THROW(Triangulate(points, { 0, 7 }, options), InvalidMesh);
}

TEST(SphereSegments, NeedAnOpenMeshOnAPartOfTheSphere)
{
  const std::vector<Point3> points = MakeRandomPoints<double>(50, 2);
  std::vector<Point3> part = points;
  for (Point3& p : part)
  {
    p[2] = std::fabs(p[2]) + 0.01;
  }
  const std::vector<std::int64_t> segments = DrawSegments(part, 10, 1);
  EXPECT_THROW(Triangulate(part, segments, Projected(ProjectionKind::Sphere)), InvalidOptions);
  const SegmentResult open = Triangulate(part, segments, Projected(ProjectionKind::OpenSphere));
  ExpectDelaunayOnSphere(part, open);
  ExpectSegmentsOnSphere(part, segments, open);
}

}
}
