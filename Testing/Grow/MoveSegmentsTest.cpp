// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "MoveTestSupport.h"

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

/// @file
/// Segments, outlines and holes of points that move.

namespace delaunayflip
{
namespace
{

/// Segments move with their points. One that crosses an earlier one is refused until it fits again.
TEST(Move, Segments)
{
  std::mt19937 random(7);
  Drawing drawing;
  drawing.Points = DrawPlaces(random, 200);
  drawing.AddRing({ { 0.2, 0.2 }, { 0.8, 0.3 }, { 0.5, 0.8 } });
  for (std::int64_t i = 0; i < 20; ++i)
  {
    drawing.Segments.push_back({ i, 20 + i });
    drawing.Rings.push_back(-1);
  }
  drawing.Segments.erase(drawing.Segments.begin() + 3, drawing.Segments.begin() + 15);
  drawing.Rings.erase(drawing.Rings.begin() + 3, drawing.Rings.begin() + 15);
  drawing.Segments[3] = { 200, 201 };
  Moving moving(drawing);
  for (int frame = 0; frame < CountFrames(20); ++frame)
  {
    Places next = moving.Now.Points;
    for (std::size_t i = 0; i < 200; ++i)
    {
      next[i][0] += DrawStep(random, 0.01);
    }
    try
    {
      moving.GoTo(next);
    }
    catch (const InvalidMesh&) // the ring is crossed
    {
      EXPECT_THROW(Triangulate(moving.Now), InvalidMesh);
    }
    ASSERT_FALSE(HasFailure()) << frame;
  }
}

/// Points with short segments between them, of which none crosses another.
Drawing DrawWithSegments(std::mt19937& random, int count)
{
  Drawing drawing = ToDrawing(DrawPlaces(random, count));
  const Triangulation made = Triangulate(drawing);
  for (std::size_t i = 0; i < made.Triangles.size(); i += 3)
  {
    if (DrawIndex(random, 4) == 0)
    {
      drawing.Segments.push_back({ made.Triangles[i], made.Triangles[i + 1] });
      drawing.Rings.push_back(-1);
    }
  }
  return drawing;
}

void AddCircle(Drawing& drawing, double radius, int corners)
{
  Places ring;
  for (int i = 0; i < corners; ++i)
  {
    const double angle = 2.0 * M_PI * i / corners;
    ring.push_back({ 0.5 + radius * std::cos(angle), 0.5 + radius * std::sin(angle) });
  }
  drawing.AddRing(ring);
}

/// While steps are small, the mesh is kept, also where the boundary changes at segments.
TEST(MoveSegments, StayInPlace)
{
  std::mt19937 random(21);
  for (const double share : { 0.001, 0.01, 0.05, 0.3 })
  {
    SCOPED_TRACE(share);
    Moving moving(DrawWithSegments(random, 1000));
    const double size = share * FindSpacing(moving.Now.Points);
    for (int frame = 0; frame < CountFrames(20); ++frame)
    {
      Places next = moving.Now.Points;
      Shake(random, size, next);
      moving.GoTo(next);
      ASSERT_FALSE(HasFailure()) << frame;
    }
    if (share < 0.005)
    {
      EXPECT_LT(0.7 * moving.Frames, moving.InPlace);
    }
    RecordProperty("InPlace" + std::to_string(share),
      std::to_string(moving.InPlace) + " of " + std::to_string(moving.Frames));
  }
}

/// Triangles outside of an outline, in a hole, and large ones are removed anew in each frame.
TEST(MoveSegments, OutlinesAndHoles)
{
  std::mt19937 random(22);
  for (const double alpha : { 0.0, 0.05 })
  {
    Drawing drawing = ToDrawing(DrawPlaces(random, 600));
    AddCircle(drawing, 0.45, 60);
    drawing.FirstHole = 1;
    AddCircle(drawing, 0.1, 20);
    drawing.Seeds = { 0.18, 0.5 };
    drawing.Segments.push_back({ 0, 1 });
    drawing.Segments.push_back({ 1, 2 });
    drawing.Segments.push_back({ 2, 0 });
    drawing.Rings.resize(drawing.Segments.size(), -1);
    drawing.Points[0] = { 0.15, 0.45 };
    drawing.Points[1] = { 0.25, 0.5 };
    drawing.Points[2] = { 0.15, 0.55 };
    PointOptions options;
    options.Alpha = alpha;
    Moving moving(drawing, options);
    for (int frame = 0; frame < CountFrames(30); ++frame)
    {
      Places next = moving.Now.Points;
      Shake(random, 5e-5, next);
      moving.GoTo(next);
      ASSERT_FALSE(HasFailure()) << frame;
      EXPECT_LT(0, moving.Sessions[0].GetReport().FromPoints.OutsideTriangles);
      EXPECT_EQ(alpha > 0.0, moving.Sessions[0].GetReport().FromPoints.LargeTriangles > 0);
    }
    EXPECT_LT(0.3 * moving.Frames, moving.InPlace);
  }
}

/// A point on a segment keeps it in two edges only as long as it is on it.
TEST(MoveSegments, PointsOnSegments)
{
  Drawing drawing;
  drawing.Points = { { 0, 0 }, { 8, 0 }, { 4, 0 }, { 1, 3 }, { 7, 3 }, { 1, -3 }, { 7, -3 } };
  drawing.Segments = { { 0, 1 } };
  drawing.Rings = { -1 };
  Moving moving(drawing);
  const auto go = [&](const Place& place, int inPlace)
  {
    Places next = moving.Now.Points;
    next[2] = place;
    moving.GoTo(next);
    EXPECT_EQ(inPlace, moving.InPlace) << place[0] << ' ' << place[1];
  };
  go({ 4.5, 0 }, 1);
  EXPECT_EQ(2, moving.Sessions[0].GetReport().FromPoints.SegmentEdges);
  go({ 4.5, 0.25 }, 1);
  EXPECT_EQ(1, moving.Sessions[0].GetReport().FromPoints.SegmentEdges);
  go({ 4.5, 0.5 }, 2);
  go({ 4.5, -0.25 }, 2); // through the segment
  go({ 4.5, -0.5 }, 3);
}

/// Points that end no segment are removed in place.
TEST(MoveSegments, PointsGo)
{
  std::mt19937 random(23);
  Drawing drawing = DrawWithSegments(random, 500);
  AddCircle(drawing, 0.8, 12);
  Moving moving(drawing);
  for (int frame = 0; frame < CountFrames(100); ++frame)
  {
    const auto id = static_cast<std::int64_t>(DrawIndex(random, 500));
    for (FlipSession& session : moving.Sessions)
    {
      EXPECT_TRUE(session.Remove(&id, 1));
    }
    moving.Now.Points[id] = { NAN, NAN };
    moving.Expect();
    ASSERT_FALSE(HasFailure()) << frame;
    Shake(random, 1e-5, moving.Now.Points);
    moving.GoTo(moving.Now.Points);
    ASSERT_FALSE(HasFailure()) << frame;
  }
  EXPECT_LT(0.5 * moving.Frames, moving.InPlace);
}

/// A removed point is not called one that is not finite.
TEST(MoveSegments, EndsGo)
{
  Drawing drawing;
  drawing.Points = { { 0.3, 0.4 }, { 0.5, 0.6 }, { 0.6, 0.4 } };
  drawing.Segments = { { 0, 1 }, { 1, 2 } };
  drawing.Rings = { -1, -1 };
  drawing.AddRing({ { 0.0, 0.0 }, { 1.0, 0.0 }, { 1.0, 1.0 }, { 0.0, 1.0 } });
  FlipSession session(drawing.View(), PointOptions());
  session.Advance();
  const std::int64_t end = 0, corner = 3;
  EXPECT_TRUE(session.Remove(&end, 1));
  const std::string defects = DescribeDefects(session.GetReport().Defects);
  EXPECT_NE(std::string::npos, defects.find("1 segment that ends at a removed point (first: 0-1)"))
    << defects;
  EXPECT_EQ(std::string::npos, defects.find("finite")) << defects;
  EXPECT_EQ(1, session.GetReport().FromPoints.RefusedSegments);
  const Triples before = Normalize(StoreTriangles(session));
  try
  {
    session.Remove(&corner, 1);
    ADD_FAILURE() << "the ring is not closed";
  }
  catch (const InvalidMesh& error)
  {
    EXPECT_NE(std::string::npos, std::string(error.what()).find("an end was removed"))
      << error.what();
  }
  session.Advance();
  EXPECT_EQ(before, Normalize(StoreTriangles(session)));
}

/// Many points that end no segment are removed in place at once, also next to segments.
TEST(MoveSegments, ManyPointsGo)
{
  std::mt19937 random(25);
  Drawing drawing = DrawWithSegments(random, 3000);
  AddCircle(drawing, 0.8, 12);
  std::vector<bool> isEnd(drawing.Points.size());
  for (const auto& segment : drawing.Segments)
  {
    isEnd[segment[0]] = isEnd[segment[1]] = true;
  }
  Moving moving(drawing);
  for (int frame = 0; frame < 3; ++frame)
  {
    std::vector<std::int64_t> ids;
    for (std::size_t i = 0; i < 3000 && ids.size() < 150; ++i)
    {
      if (!isEnd[i] && std::isfinite(moving.Now.Points[i][0]))
      {
        ids.push_back(static_cast<std::int64_t>(i));
      }
    }
    EXPECT_LT(100, ids.size());
    for (FlipSession& session : moving.Sessions)
    {
      EXPECT_TRUE(session.Remove(ids.data(), static_cast<std::int64_t>(ids.size())));
    }
    for (const std::int64_t id : ids)
    {
      moving.Now.Points[id] = { NAN, NAN };
    }
    moving.Expect();
    ASSERT_FALSE(HasFailure()) << frame;
    EXPECT_EQ(moving.Frames, moving.InPlace);
  }
}

/// Points are inserted between segments in place, and on segments by beginning anew. Holes and
/// large triangles are removed again.
TEST(MoveSegments, PointsCome)
{
  std::mt19937 random(26);
  for (const double alpha : { 0.0, 0.04 })
  {
    Drawing drawing = ToDrawing(DrawPlaces(random, 1000));
    AddCircle(drawing, 0.45, 60);
    drawing.FirstHole = 1;
    AddCircle(drawing, 0.0625, 4);
    PointOptions options;
    options.Alpha = alpha;
    Moving moving(drawing, options);
    for (int frame = 0; frame < 8; ++frame)
    {
      Places more = DrawPlaces(random, 40);
      for (Place& place : more)
      {
        place = { 0.6 + 0.15 * place[0], 0.3 + 0.2 * place[1] };
      }
      const bool isOnSegment = frame == 0;
      if (isOnSegment) // the middle of a side of the hole
      {
        more.push_back({ 0.5 + 0.03125, 0.5 + 0.03125 });
      }
      for (FlipSession& session : moving.Sessions)
      {
        EXPECT_TRUE(session.Insert(View(more)));
      }
      moving.Now.Points.insert(moving.Now.Points.end(), more.begin(), more.end());
      moving.Expect();
      ASSERT_FALSE(HasFailure()) << frame;
      if (alpha == 0.0)
      {
        const FlipReport& report = moving.Sessions[0].GetReport();
        EXPECT_NE(isOnSegment, report.FromPoints.MoveRounds > 0) << frame;
      }
      Shake(random, 1e-5, moving.Now.Points);
      moving.GoTo(moving.Now.Points);
      ASSERT_FALSE(HasFailure()) << frame;
    }
  }
}

/// If a seed is on a segment, the same triangle beside it has the seed in any order of triangles.
TEST(MoveSegments, SeedsOnSegments)
{
  std::mt19937 random(5);
  Drawing drawing = ToDrawing(DrawPlaces(random, 60));
  drawing.AddRing({ { 0.25, 0.25 }, { 0.75, 0.25 }, { 0.75, 0.75 }, { 0.25, 0.75 } });
  drawing.Rings.assign(drawing.Segments.size(), -1); // breaklines
  drawing.Seeds = { 0.25, 0.5 };
  Moving moving(drawing);
  for (int frame = 0; frame < CountFrames(100); ++frame)
  {
    Places next = moving.Now.Points;
    for (std::size_t i = 0; i < 60; ++i)
    {
      next[i][0] += DrawStep(random, 0.005);
      next[i][1] += DrawStep(random, 0.005);
    }
    moving.GoTo(next);
    ASSERT_FALSE(HasFailure()) << frame;
  }
  EXPECT_GT(moving.InPlace, 0);
}

/// Labels of regions follow.
TEST(MoveSegments, Regions)
{
  std::mt19937 random(24);
  Drawing drawing = ToDrawing(DrawPlaces(random, 300));
  AddCircle(drawing, 0.3, 40);
  const RegionSeed seeds[] = { { 0.5, 0.5, 7 }, { 0.01, 0.01, 9 } };
  const auto withSeeds = [&]
  {
    PointInput input = drawing.View();
    input.FirstHole = 0;
    input.Regions = seeds;
    input.NumberOfRegions = 2;
    return input;
  };
  const auto list = [](const FlipSession& session)
  {
    std::vector<std::int32_t> labels(session.CountTriangles());
    session.StoreRegions(labels.data());
    std::vector<std::array<std::int32_t, 4>> listed;
    const std::vector<std::int32_t> ids = StoreTriangles(session);
    for (std::size_t t = 0; t < labels.size(); ++t)
    {
      std::array<std::int32_t, 3> triangle = { ids[3 * t], ids[3 * t + 1], ids[3 * t + 2] };
      std::sort(triangle.begin(), triangle.end());
      listed.push_back({ triangle[0], triangle[1], triangle[2], labels[t] });
    }
    std::sort(listed.begin(), listed.end());
    return listed;
  };
  FlipSession session(withSeeds(), PointOptions());
  session.Advance();
  for (int frame = 0; frame < 10; ++frame)
  {
    Shake(random, 1e-4, drawing.Points);
    EXPECT_TRUE(session.Move({ View(drawing.Points) }));
    EXPECT_LT(0, session.GetReport().FromPoints.MoveRounds);
    ASSERT_EQ(list(FlipPoints(withSeeds(), PointOptions())), list(session));
  }
}

}
}
