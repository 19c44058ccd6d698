// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "GrowTestSupport.h"
#include "LoadedMesh.h"
#include "PointSets.h"
#include "PointTestSupport.h"
#include "RandomInputs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

/// @file
/// Points that are inserted into a triangulation of others.

namespace delaunayflip
{
namespace
{

/// A triangulation of the first points, into which the others are inserted, some at a time.
class Grown
{
public:
  Grown(const Places& points, std::size_t first, std::size_t step, const FlipOptions& options)
  {
    const BuildProgress progress{ ProgressObserver() };
    const Places start(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(first));
    this->Mesh = LoadOnThreads(View(start), options, progress);
    this->Mesh->GetLoop().Converge();
    for (std::size_t i = first; i < points.size(); i += step)
    {
      std::vector<double> some;
      for (std::size_t k = i; k < std::min(points.size(), i + step); ++k)
      {
        some.insert(some.end(), { points[k][0], points[k][1] });
      }
      this->Flips += this->Mesh->InsertPoints(some, false).Flips;
      this->Mesh->Audit();
      EXPECT_EQ(0, this->Mesh->GetLoop().GetFound().Bad);
    }
    this->Triangles.resize(3 * this->Mesh->GetInputReport().Triangles);
    this->Mesh->StoreTriangles(
      MutableTriangleArray(this->Triangles.data(), this->Mesh->GetInputReport().Triangles));
    this->UsedPoints.resize(points.size());
    this->Mesh->StoreUsedPoints(
      0, static_cast<std::int64_t>(this->UsedPoints.size()), this->UsedPoints.data());
  }

  std::unique_ptr<LoadedMesh> Mesh;
  std::int64_t Flips = 0;
  std::vector<std::int32_t> Triangles;
  std::vector<std::int64_t> UsedPoints;
};

/// Expects what a triangulation of all points has.
void ExpectAsFromAll(const Places& points, std::size_t first, std::size_t step)
{
  const Grown grown(points, first, step, WithThreads(1));
  const Grown other(points, first, step, WithThreads(3));
  EXPECT_EQ(grown.Triangles, other.Triangles);
  const Triangulation expected = Triangulate(points);
  EXPECT_EQ(Normalize(expected.Triangles), Normalize(grown.Triangles));
  EXPECT_EQ(expected.UsedPoints, grown.UsedPoints);
  const FlipReport& report = grown.Mesh->GetInputReport();
  EXPECT_EQ(expected.Report.Triangles, report.Triangles);
  EXPECT_EQ(expected.Report.Edges.Edges, report.Edges.Edges);
  EXPECT_EQ(expected.Report.FromPoints.Repeated, report.FromPoints.Repeated);
}

/// Four corners around all, and then points.
Places Enclose(const Places& points)
{
  double size = 1.0;
  for (const Place& point : points)
  {
    size = std::max({ size, std::fabs(point[0]), std::fabs(point[1]) });
  }
  Places all = { { -2 * size, -3 * size }, { 3 * size, -2 * size }, { 2 * size, 3 * size },
    { -3 * size, 2 * size } };
  all.insert(all.end(), points.begin(), points.end());
  return all;
}

TEST(Grow, AsATriangulationOfAllPoints)
{
  for (const PointSet& set : ListPointSets())
  {
    SCOPED_TRACE(set.Name);
    const Places all = Enclose(MakePlaces(set, 3000 / Reduction));
    ExpectAsFromAll(all, all.size() / 2, all.size());
    ExpectAsFromAll(all, 4, all.size() / 3);
  }
}

/// Most places are at points, on edges or on the hull.
TEST(Grow, OnEdgesAndVertices)
{
  std::mt19937 random(3);
  for (int size = 2; size < 20; ++size)
  {
    Places points = { { 0.0, 0.0 }, { 1.0 * size, 0.0 }, { 1.0 * size, 1.0 * size },
      { 0.0, 1.0 * size } };
    for (int i = 0; i < 4 * size * size; ++i)
    {
      points.push_back({ 0.5 * static_cast<double>(DrawIndex(random, 2 * size + 1)),
        0.5 * static_cast<double>(DrawIndex(random, 2 * size + 1)) });
    }
    ExpectAsFromAll(points, 4, points.size());
    ExpectAsFromAll(points, 4 + DrawIndex(random, points.size() - 4), 1 + DrawIndex(random, 50));
  }
}

/// Compares a session with points inserted with one of all points.
void ExpectAsFromAll(const FlipSession& session, const Drawing& all, const PointOptions& options)
{
  const Triangulation expected = Triangulate(all, options);
  const FlipReport& report = session.GetReport();
  const std::int64_t count = report.Triangles;
  EXPECT_EQ(static_cast<std::int64_t>(all.Points.size()), report.Points);
  std::vector<std::int32_t> triangles(3 * count), neighbors(3 * count);
  session.StoreTriangles(MutableTriangleArray(triangles.data(), count));
  session.StoreNeighbors(neighbors.data());
  EXPECT_EQ(Normalize(expected.Triangles), Normalize(triangles));
  std::vector<std::int64_t> used(all.Points.size());
  session.StoreUsedPoints(used.data());
  EXPECT_EQ(expected.UsedPoints, used);
  EXPECT_EQ(StopReasonKind::Converged, report.StopReason);
  EXPECT_NEAR(expected.Report.MinimumAngleAfter, report.MinimumAngleAfter, 1e-12);
  EXPECT_EQ(expected.Report.FromPoints.Used, report.FromPoints.Used);
  EXPECT_EQ(expected.Report.FromPoints.Repeated, report.FromPoints.Repeated);
  EXPECT_EQ(expected.Report.FromPoints.NotFinite, report.FromPoints.NotFinite);
  EXPECT_EQ(expected.Report.Edges.Edges, report.Edges.Edges);
  EXPECT_EQ(expected.Report.Edges.Boundary, report.Edges.Boundary);
  ASSERT_EQ(expected.Report.Defects.size(), report.Defects.size());
  // The session can be asked, with values for all points.
  std::vector<double> values, results(1, 0.0);
  for (const Place& point : all.Points)
  {
    values.push_back(point[0]);
  }
  const double place[] = { 0.4, 0.3 };
  PlaceQuery query;
  query.Places = PlaneArray(place, 1, 2);
  query.Values = values.data();
  query.Results = results.data();
  query.Method = InterpolationKind::Natural;
  EXPECT_TRUE(session.Ask(query));
  EXPECT_NEAR(0.4, results[0], 1e-12);
}

Place DrawPlace(std::mt19937& random, int grid)
{
  return { static_cast<double>(DrawIndex(random, grid + 1)) / grid,
    static_cast<double>(DrawIndex(random, grid + 1)) / grid };
}

/// In place, outside of the hull, not finite, with segments, and as floats.
TEST(Grow, SessionsTakeMorePoints)
{
  std::mt19937 random(4);
  for (const bool hasRing : { false, true })
  {
    for (const double alpha : { 0.0, 0.2 })
    {
      Drawing drawing;
      drawing.Points = { { 0.0, 0.0 }, { 1.0, 0.0 }, { 1.0, 1.0 }, { 0.0, 1.0 } };
      if (hasRing)
      {
        drawing.AddRing({ { 0.1, 0.1 }, { 0.9, 0.2 }, { 0.5, 0.9 } });
      }
      const Places corners = drawing.Points;
      PointOptions options;
      options.Alpha = alpha;
      FlipSession session(drawing.View(), options);
      session.Advance();
      for (int batch = 0; batch < 12; ++batch)
      {
        Places more;
        for (int i = 0; i < (batch == 5 ? 400 : 60); ++i)
        {
          more.push_back(DrawPlace(random, batch % 2 == 0 ? 1000 : 10));
        }
        if (batch == 3)
        {
          more.push_back({ 1.5, -0.5 });
          more.push_back({ NAN, 0.0 });
        }
        EXPECT_TRUE(session.Insert(View(more)));
        Drawing all = drawing;
        all.Points.insert(all.Points.end(), more.begin(), more.end());
        ExpectAsFromAll(session, all, options);
        drawing.Points = all.Points;
        // The session still reads the segments of the first drawing.
      }
    }
  }
}

/// The report is that of the last insertion, in place or anew.
TEST(Grow, AnInsertionHasItsOwnReport)
{
  std::mt19937 random(8);
  Places points = { { 0.0, 0.0 }, { 1.0, 0.0 }, { 1.0, 1.0 }, { 0.0, 1.0 } };
  for (int i = 0; i < 2000; ++i)
  {
    points.push_back(DrawPlace(random, 1 << 20));
  }
  FlipSession session(PointInput{ View(points) }, PointOptions());
  session.Advance();
  const std::int64_t all = session.GetReport().TotalFlips;
  EXPECT_FALSE(session.GetReport().Iterations.empty());
  const Places inside = { { 0.3, 0.6 }, { 0.7, 0.6 }, points[5] }, outside = { { 2.0, 2.0 } };
  EXPECT_TRUE(session.Insert(View(inside)));
  EXPECT_EQ(1, session.GetReport().FromPoints.MoveRounds);
  EXPECT_LT(0, session.GetReport().TotalFlips);
  EXPECT_GT(40, session.GetReport().TotalFlips);
  EXPECT_TRUE(session.GetReport().Iterations.empty());
  const Places again = { points[6] };
  EXPECT_TRUE(session.Insert(View(again)));
  EXPECT_EQ(1, session.GetReport().FromPoints.MoveRounds);
  EXPECT_EQ(0, session.GetReport().TotalFlips);
  EXPECT_TRUE(session.Insert(View(outside)));
  EXPECT_EQ(0, session.GetReport().FromPoints.MoveRounds);
  EXPECT_LT(all / 2, session.GetReport().TotalFlips);
}

TEST(Grow, ASessionOfFloatsRoundsMorePoints)
{
  std::mt19937 random(5);
  std::vector<float> coordinates = { 0.0F, 0.0F, 1.0F, 0.0F, 1.0F, 1.0F, 0.0F, 1.0F };
  PointInput input;
  input.Points = PlaneArray(coordinates.data(), 4, 2);
  FlipSession session(input, PointOptions());
  session.Advance();
  std::vector<double> more;
  for (int i = 0; i < 2000; ++i)
  {
    more.push_back(DrawIndex(random, 1 << 28) / double(1 << 28));
  }
  for (std::size_t first = 0; first < more.size(); first += 100)
  {
    EXPECT_TRUE(session.Insert(PlaneArray(more.data() + first, 50, 2)));
  }
  std::vector<float> all = coordinates;
  all.insert(all.end(), more.begin(), more.end());
  const Triangulation expected = Triangulate(PointInput{ PlaneArray(all.data(), 1004, 2) });
  EXPECT_EQ(Normalize(expected.Triangles), Normalize(StoreTriangles(session)));
}

TEST(Grow, AnObserverMayStop)
{
  std::mt19937 random(6);
  Places points;
  for (int i = 0; i < 1000; ++i)
  {
    points.push_back(DrawPlace(random, 1 << 20));
  }
  FlipSession session(PointInput{ View(points) }, PointOptions());
  session.Advance();
  const Places outside = { { 3.0, 3.0 } };
  EXPECT_FALSE(session.Insert(View(outside), [](double) { return false; }));
  session.Advance();
  points.push_back(outside.front());
  EXPECT_EQ(Normalize(Triangulate(points).Triangles), Normalize(StoreTriangles(session)));
}

/// Expects in arrays what GetAddedPoints returns.
void ExpectSameInArrays(const FlipSession& session, int components)
{
  const PointCounts& counts = session.GetReport().FromPoints;
  const std::int64_t size = counts.Crossings + counts.RefinementPoints;
  std::vector<double> places(components * size), weights(3 * size);
  std::vector<std::int64_t> ids(3 * size), segments(size);
  AddedPointArrays arrays;
  arrays.Places = places.data();
  arrays.Components = components;
  arrays.Ids = ids.data();
  arrays.Weights = weights.data();
  arrays.Segments = segments.data();
  session.StoreAddedPoints(arrays); // before the list is made
  const std::vector<AddedPoint>& points = session.GetAddedPoints();
  ASSERT_EQ(size, static_cast<std::int64_t>(points.size()));
  for (std::int64_t i = 0; i < size; ++i)
  {
    const AddedPoint& point = points[i];
    const double* place = &places[components * i];
    EXPECT_EQ(point.X, place[0]);
    EXPECT_EQ(point.Y, place[1]);
    EXPECT_EQ(components > 2 ? point.Z : place[1], place[components - 1]);
    EXPECT_EQ((std::array<std::int64_t, 3>{ point.From, point.To, point.Third }),
      (std::array<std::int64_t, 3>{ ids[3 * i], ids[3 * i + 1], ids[3 * i + 2] }));
    EXPECT_EQ(1.0 - point.Share - point.ThirdShare, weights[3 * i]);
    EXPECT_EQ(point.Share, weights[3 * i + 1]);
    EXPECT_EQ(point.ThirdShare, weights[3 * i + 2]);
    EXPECT_EQ(point.Segment, segments[i]);
  }
  session.StoreAddedPoints({}); // null: nothing is wanted
}

TEST(AddedPoints, HaveTheSameMembersInArrays)
{
  Drawing cross;
  cross.Points = { { 0, 0 }, { 7, 5 }, { 7, 0 }, { 0, 5 }, { 3, 4 } };
  cross.Segments = { { 0, 1 }, { 2, 3 } };
  PointOptions options;
  options.SplitCrossings = true;
  options.MinimumAngle = 30.0;
  const FlipSession session = FlipPoints(cross.View(), options);
  EXPECT_EQ(1, session.GetReport().FromPoints.Crossings);
  EXPECT_LT(0, session.GetReport().FromPoints.RefinementPoints);
  ExpectSameInArrays(session, 2);
  EXPECT_EQ(session.GetAddedPoints().size() + cross.Points.size(),
    static_cast<std::size_t>(session.GetReport().FromPoints.Used));

  const std::vector<double> points = { 0, 0, 1, 9, 0, 2, 9, 1, 3, 0, 1, 4 };
  const std::vector<std::int32_t> triangles = { 0, 1, 2, 0, 2, 3 };
  TriangleMesh mesh;
  mesh.Points = PointArray(points.data(), 4);
  mesh.Triangles = TriangleArray(triangles.data(), 2);
  FlipOptions goals;
  goals.Geometry = GeometryKind::PlanarXY;
  goals.MinimumAngle = 30.0;
  FlipSession strip(mesh, goals);
  strip.Advance();
  EXPECT_LT(0, strip.GetReport().FromPoints.RefinementPoints);
  ExpectSameInArrays(strip, 3);
}

}
}
