// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "DividedSquare.h"
#include "FlipError.h"
#include "InputChecks.h"
#include "PointSets.h"
#include "PointTestSupport.h"
#include "RandomInputs.h"
#include "RandomNumbers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <vector>

/// @file
/// Refinement: goals, segments, regions, limits.

namespace delaunayflip
{
namespace
{

constexpr double DegreesPerRadian = 57.295779513082321;

/// A result of refinement with all its points.
struct Refined
{
  Places Points;
  Triangulation Result;
  std::vector<std::int32_t> Regions;
  std::vector<std::int64_t> SegmentsOfEdges;
  double SmallestAngle = 180.0, LargestArea = 0.0, Area = 0.0, LongestEdge = 0.0;
  std::int64_t Bad = 0; ///< Triangles with an angle below the goal.

  double GetLength(std::int64_t a, std::int64_t b) const
  {
    return std::hypot(
      this->Points[b][0] - this->Points[a][0], this->Points[b][1] - this->Points[a][1]);
  }

  double GetAngle(std::size_t i) const
  {
    const std::size_t first = i - i % 3;
    const Place& a = this->Points[this->Result.Triangles[i]];
    const Place& b = this->Points[this->Result.Triangles[first + (i + 1) % 3]];
    const Place& c = this->Points[this->Result.Triangles[first + (i + 2) % 3]];
    const long double u1 = (long double)(b[0]) - a[0], v1 = (long double)(b[1]) - a[1];
    const long double u2 = (long double)(c[0]) - a[0], v2 = (long double)(c[1]) - a[1];
    return static_cast<double>(std::atan2(u1 * v2 - v1 * u2, u1 * u2 + v1 * v2)) * DegreesPerRadian;
  }

  double GetArea(std::size_t t) const
  {
    const std::int32_t* ids = &this->Result.Triangles[3 * t];
    const Place &a = this->Points[ids[0]], &b = this->Points[ids[1]], &c = this->Points[ids[2]];
    return 0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
  }

  void Measure(double angle)
  {
    constexpr double Rounding = 1e-9;
    for (std::size_t t = 0; t < this->Result.Triangles.size() / 3; ++t)
    {
      double smallest = 180.0;
      for (std::size_t i = 3 * t; i < 3 * t + 3; ++i)
      {
        smallest = std::min(smallest, this->GetAngle(i));
        this->LongestEdge = std::max(this->LongestEdge,
          this->GetLength(this->Result.Triangles[i], this->Result.Triangles[3 * t + (i + 1) % 3]));
      }
      this->SmallestAngle = std::min(this->SmallestAngle, smallest);
      this->Bad += smallest < angle - Rounding ? 1 : 0;
      this->LargestArea = std::max(this->LargestArea, this->GetArea(t));
      this->Area += this->GetArea(t);
    }
  }
};

Refined Refine(const PointInput& input, const PointOptions& options)
{
  Refined refined;
  const FlipSession session = FlipPoints(input, options);
  refined.Result = Triangulate(input, options);
  for (std::int64_t i = 0; i < input.Points.Count; ++i)
  {
    refined.Points.push_back({ input.Points.Get(i, 0), input.Points.Get(i, 1) });
  }
  for (const AddedPoint& added : refined.Result.Added)
  {
    refined.Points.push_back({ added.X, added.Y });
  }
  refined.Regions.resize(refined.Result.Report.Triangles);
  session.StoreRegions(refined.Regions.data());
  refined.SegmentsOfEdges = session.ListSegmentsOfEdges();
  refined.Measure(options.MinimumAngle);
  return refined;
}

/// A point that is added is where its shares say, within rounding.
void ExpectRightShares(const Refined& refined, std::size_t given)
{
  double size = 0.0;
  for (const Place& point : refined.Points)
  {
    size = std::max({ size, std::fabs(point[0]), std::fabs(point[1]) });
  }
  for (std::size_t i = 0; i < refined.Result.Added.size(); ++i)
  {
    const AddedPoint& added = refined.Result.Added[i];
    const double first = 1.0 - added.Share - added.ThirdShare;
    for (int axis = 0; axis < 2; ++axis)
    {
      double sum = first * refined.Points[added.From][axis];
      sum += added.Share * refined.Points[added.To][axis];
      sum += added.Third < 0 ? 0.0 : added.ThirdShare * refined.Points[added.Third][axis];
      ASSERT_NEAR(refined.Points[given + i][axis], sum, 1e-7 * size) << i;
    }
  }
}

/// Every segment that is not refused is covered by its edges, in its direction.
void ExpectCovered(const Drawing& drawing, const Refined& refined)
{
  ASSERT_EQ(refined.Result.Edges.size(), refined.SegmentsOfEdges.size());
  std::map<std::int64_t, double> covered;
  for (std::size_t i = 0; i < refined.Result.Edges.size(); ++i)
  {
    const auto& [from, to] = refined.Result.Edges[i];
    covered[refined.SegmentsOfEdges[i]] += refined.GetLength(from, to);
    const auto& segment = drawing.Segments[refined.SegmentsOfEdges[i]];
    const Place &a = refined.Points[segment[0]], &b = refined.Points[segment[1]];
    const Place &p = refined.Points[from], &q = refined.Points[to];
    EXPECT_LT(0.0, (b[0] - a[0]) * (q[0] - p[0]) + (b[1] - a[1]) * (q[1] - p[1]));
  }
  for (const auto& [number, length] : covered)
  {
    const auto& segment = drawing.Segments[number];
    const double expected = refined.GetLength(segment[0], segment[1]);
    EXPECT_NEAR(expected, length, 1e-9 * expected) << number;
  }
}

/// Judges all that refinement promises. @returns the result.
Refined ExpectRefined(const Drawing& drawing, const PointOptions& options)
{
  Refined refined = Refine(drawing.View(), WithThreads(1, options));
  const Triangulation other = Triangulate(drawing, WithThreads(3, options));
  EXPECT_EQ(refined.Result.Triangles, other.Triangles);
  EXPECT_EQ(refined.Result.Edges, other.Edges);
  ExpectSameStatistics(refined.Result.Report, other.Report);
  ExpectConstrainedDelaunay(refined.Points, refined.Result);
  ExpectRightShares(refined, drawing.Points.size());
  const PointCounts& counts = refined.Result.Report.FromPoints;
  EXPECT_LE(refined.Bad, counts.UnrefinedTriangles);
  EXPECT_EQ(0, counts.ReachedPointLimit);
  EXPECT_EQ(StopReasonKind::Converged, refined.Result.Report.StopReason);
  PointOptions without = options;
  without.MinimumAngle = 0.0;
  without.MaximumArea = 0.0;
  without.MaximumEdge = 0.0;
  const Refined before = Refine(Drawing(drawing).View(), WithThreads(1, without));
  EXPECT_NEAR(before.Area, refined.Area, 1e-9 * before.Area);
  return refined;
}

/// A coast with bays, and an island in it.
Drawing MakeCoast(int corners)
{
  Drawing coast;
  std::mt19937 random(5);
  std::vector<double> radii(corners, 1.0);
  for (int wave = 1; wave < 40; ++wave)
  {
    const double height =
      std::uniform_real_distribution<>(-0.3, 0.3)(random) * std::pow(wave, -1.3);
    const double phase = std::uniform_real_distribution<>(0.0, 6.28)(random);
    for (int i = 0; i < corners; ++i)
    {
      radii[i] += height * std::cos(wave * (i * 2 * M_PI / corners) + phase);
    }
  }
  Places ring, island;
  for (int i = 0; i < corners; ++i)
  {
    const double angle = i * 2 * M_PI / corners, radius = std::max(radii[i], 0.3);
    ring.push_back({ 1000 + radius * std::cos(angle), 500 + radius * std::sin(angle) });
  }
  for (int i = 0; i < 7; ++i)
  {
    island.push_back({ 1000 + 0.1 * std::cos(i * 0.9), 500 + 0.2 * std::sin(i * 0.9) });
  }
  coast.AddRing(ring);
  coast.AddRing(island);
  coast.FirstHole = 1;
  return coast;
}

TEST(Refine, CoastsGetTheAngle)
{
  for (const double angle : { 20.0, 28.0, 32.0 })
  {
    SCOPED_TRACE(angle);
    PointOptions options;
    options.MinimumAngle = angle;
    const Drawing coast = MakeCoast(600 / Reduction);
    const Refined refined = ExpectRefined(coast, options);
    ExpectCovered(coast, refined);
    EXPECT_EQ(0, refined.Bad);
    EXPECT_LT(0, refined.Result.Report.FromPoints.RefinementPoints);
  }
}

TEST(Refine, PointSetsGetTheAngle)
{
  for (const PointSet& set : ListPointSets())
  {
    SCOPED_TRACE(set.Name);
    Drawing drawing;
    drawing.Points = MakePlaces(set, 300 / Reduction);
    PointOptions options;
    options.MinimumAngle = 25.0;
    options.PointLimit = 100000;
    const Refined refined = Refine(drawing.View(), WithThreads(1, options));
    const PointCounts& counts = refined.Result.Report.FromPoints;
    EXPECT_LE(refined.Bad, counts.UnrefinedTriangles);
    ExpectConstrainedDelaunay(refined.Points, refined.Result);
  }
}

/// If only two segments meet at a small angle, all triangles reach the goal except the one at the
/// corner. Below a degree, those along the segments are left, too.
TEST(Refine, SharpCornersEnd)
{
  for (const double corner : { 50.0, 20.0, 5.0, 1.5, 0.1 })
  {
    SCOPED_TRACE(corner);
    Drawing wedge;
    const double radians = corner / DegreesPerRadian;
    wedge.AddRing({ { 0, 0 }, { 1, 0 }, { 1.3 * std::cos(radians), 1.3 * std::sin(radians) } });
    PointOptions options;
    options.MinimumAngle = 25.0;
    const Refined refined = ExpectRefined(wedge, options);
    ExpectCovered(wedge, refined);
    // Between the sides at equal distances, angles are a little below that of the corner.
    EXPECT_LE(0.85 * std::min(corner, 25.0), refined.SmallestAngle);
    EXPECT_GT(500, refined.Result.Report.FromPoints.Used);
    EXPECT_EQ(corner<25.0, refined.Bad> 0);
    std::int64_t badAtCorners = 0;
    for (std::size_t i = 0; i < refined.Result.Triangles.size(); ++i)
    {
      const bool isCorner = refined.Result.Triangles[i] < 3;
      badAtCorners += isCorner && refined.GetAngle(i) < options.MinimumAngle ? 1 : 0;
    }
    EXPECT_EQ(corner > 1.0, badAtCorners == refined.Bad);
  }
}

/// Segments that meet at small angles of different sizes would need smaller and smaller triangles
/// beside each other.
TEST(Refine, FansOfSegmentsEnd)
{
  std::mt19937 random(3);
  Drawing fan;
  fan.Points.push_back({ 0, 0 });
  double angle = 0.0;
  for (std::int64_t i = 1; i < 20; ++i)
  {
    angle += std::uniform_real_distribution<>(0.02, 0.6)(random);
    const double length = std::uniform_real_distribution<>(1.0, 3.0)(random);
    fan.Points.push_back({ length * std::cos(angle), length * std::sin(angle) });
    fan.Segments.push_back({ 0, i });
    fan.Rings.push_back(-1);
  }
  PointOptions options;
  options.MinimumAngle = 28.0;
  const Refined refined = ExpectRefined(fan, options);
  EXPECT_GT(2000, refined.Result.Report.FromPoints.Used);
}

Drawing MakeSquare(double side)
{
  Drawing square;
  square.AddRing({ { 0, 0 }, { side, 0 }, { side, side }, { 0, side } });
  return square;
}

TEST(Refine, SizesAreKept)
{
  PointOptions options;
  options.MaximumArea = 0.01;
  const Refined byArea = ExpectRefined(MakeSquare(2.0), options);
  EXPECT_GE(0.01, byArea.LargestArea);
  EXPECT_LT(400, byArea.Result.Report.Triangles);
  EXPECT_GT(1600, byArea.Result.Report.Triangles);

  options = PointOptions();
  options.MaximumEdge = 0.25;
  options.MinimumAngle = 20.0;
  const Refined byEdge = ExpectRefined(MakeSquare(2.0), options);
  EXPECT_GE(0.25, byEdge.LongestEdge);
  EXPECT_GT(2000, byEdge.Result.Report.Triangles);

  const Drawing square = MakeSquare(2.0);
  const double sizes[] = { 0.05, 1.0, 1.0, 1.0 };
  PointInput input = square.View();
  input.Sizes = sizes;
  options = PointOptions();
  options.MinimumAngle = 25.0;
  const Refined bySize = Refine(input, options);
  double longest[2] = { 0.0, 0.0 }; // near the first corner, and near the second
  for (std::size_t i = 0; i < bySize.Result.Triangles.size(); ++i)
  {
    const std::int64_t a = bySize.Result.Triangles[i];
    const std::int64_t b = bySize.Result.Triangles[i - i % 3 + (i + 1) % 3];
    for (int corner = 0; corner < 2; ++corner)
    {
      if (a == corner)
      {
        longest[corner] = std::max(longest[corner], bySize.GetLength(a, b));
      }
    }
  }
  EXPECT_GT(0.2, longest[0]);
  EXPECT_LT(0.2, longest[1]);

  const double none[] = { NAN, NAN, NAN, NAN };
  input.Sizes = none;
  EXPECT_EQ(0, Refine(input, PointOptions()).Result.Report.FromPoints.RefinementPoints);
}

/// A wall divides a square. Each side has its label and area.
TEST(Refine, RegionsHaveLabelsAndAreas)
{
  Drawing square = MakeSquare(2.0);
  square.Points.push_back({ 1, 0 });
  square.Points.push_back({ 1, 2 });
  square.Segments.push_back({ 4, 5 });
  square.Rings.push_back(-1);
  const RegionSeed seeds[] = { { 0.5, 1.0, 7, 0.01 }, { 1.5, 1.0, -3, 0.0 }, { 5.0, 5.0, 9, 0.0 } };
  PointInput input = square.View();
  input.Regions = seeds;
  input.NumberOfRegions = 3;
  for (const double angle : { 0.0, 20.0 })
  {
    PointOptions options;
    options.MinimumAngle = angle;
    const Refined refined = Refine(input, options);
    std::map<std::int32_t, double> largest, area;
    for (std::size_t t = 0; t < refined.Regions.size(); ++t)
    {
      const std::int32_t* ids = &refined.Result.Triangles[3 * t];
      const double x =
        refined.Points[ids[0]][0] + refined.Points[ids[1]][0] + refined.Points[ids[2]][0];
      ASSERT_EQ(x < 3.0 ? 7 : -3, refined.Regions[t]);
      double& most = largest[refined.Regions[t]];
      most = std::max(most, refined.GetArea(t));
      area[refined.Regions[t]] += refined.GetArea(t);
    }
    EXPECT_GE(0.01, largest[7]);
    EXPECT_LT(0.01, largest[-3]);
    EXPECT_NEAR(2.0, area[7], 1e-9);
    EXPECT_NEAR(2.0, area[-3], 1e-9);
    const std::vector<Defect>& defects = refined.Result.Report.Defects;
    const auto outside = std::find_if(defects.begin(), defects.end(),
      [](const Defect& one) { return one.Kind == DefectKind::RegionSeedsOutside; });
    ASSERT_NE(defects.end(), outside);
    EXPECT_EQ(1, outside->Count);
    EXPECT_EQ(std::vector<std::int64_t>{ 2 }, outside->FirstIds);
  }
}

/// If several seeds are in one part, the first counts. The others are named if they differ from it.
TEST(Refine, SaysWhichSeedsAreNotUsed)
{
  const Drawing square = MakeSquare(2.0);
  const RegionSeed seeds[] = { { 0.5, 1.0, 7, 0.0 }, { 1.5, 1.0, 7, 0.0 }, { 1.0, 0.5, 8, 0.0 },
    { 1.0, 1.5, 7, 0.01 } };
  PointInput input = square.View();
  input.Regions = seeds;
  input.NumberOfRegions = 2;
  EXPECT_EQ("", DescribeDefects(Refine(input, PointOptions()).Result.Report.Defects));
  input.NumberOfRegions = 4;
  const std::string words = DescribeDefects(Refine(input, PointOptions()).Result.Report.Defects);
  EXPECT_EQ(0U, words.find("2 region seeds in the same part as earlier ones, not used"));
  EXPECT_NE(std::string::npos, words.find("(first: 2, 3)"));
}

TEST(Refine, SaysWhichOptionsHaveNoEffect)
{
  const Drawing square = MakeSquare(2.0);
  const auto describe = [&](const PointOptions& options)
  { return DescribeDefects(Refine(square.View(), options).Result.Report.Defects); };
  PointOptions options;
  options.KeepBoundary = true;
  options.PointLimit = 1000;
  EXPECT_EQ("2 options without effect, because without a goal nothing is refined: KeepBoundary, "
            "PointLimit",
    describe(options));
  options.KeepBoundary = false;
  EXPECT_EQ("1 option without effect, because without a goal nothing is refined: PointLimit",
    describe(options));
  options.MaximumArea = 1.0;
  EXPECT_EQ("", describe(options));
}

TEST(Refine, TheBoundaryIsKept)
{
  const Drawing coast = MakeCoast(300 / Reduction);
  PointOptions options;
  options.MinimumAngle = 25.0;
  options.MaximumArea = 0.001;
  options.KeepBoundary = true;
  const Refined refined = ExpectRefined(coast, options);
  EXPECT_EQ(coast.Segments.size(), refined.Result.Edges.size());
  EXPECT_LT(100, refined.Result.Report.FromPoints.RefinementPoints);
}

/// Triangles inside get small, though the boundary is coarse. Triangles at its edges get thin.
TEST(Refine, ACoarseBoundaryIsKept)
{
  const Drawing square = MakeSquare(10.0);
  PointOptions options;
  options.KeepBoundary = true;
  options.MinimumAngle = 20.0;
  options.MaximumArea = 1.0;
  const Refined byArea = ExpectRefined(square, options);
  EXPECT_GE(1.0, byArea.LargestArea);
  EXPECT_EQ(4U, byArea.Result.Edges.size());
  EXPECT_GT(1000, byArea.Result.Report.FromPoints.RefinementPoints);
  EXPECT_LT(50, byArea.Result.Report.FromPoints.RefinementPoints);

  options.MaximumArea = 0.0;
  options.MaximumEdge = 2.0;
  const Refined byEdge = ExpectRefined(square, options);
  EXPECT_LT(20, byEdge.Result.Report.FromPoints.RefinementPoints);
  EXPECT_GT(1000, byEdge.Result.Report.FromPoints.RefinementPoints);
  EXPECT_EQ(4U, byEdge.Result.Edges.size());
}

/// The limit and an observer end with a valid mesh; after the observer, the run goes on.
/// Points outside of the outline do not matter, wherever they are.
TEST(Refine, PointsOutsideDoNotMatter)
{
  Drawing square = MakeSquare(2.0);
  PointOptions options;
  options.MaximumArea = 0.1;
  const Triangulation expected = Triangulate(square, options);
  for (const double far : { 1e19, 1e200 })
  {
    Drawing other = square;
    other.Points.push_back({ far, 0.0 });
    const Triangulation refined = Triangulate(other, options);
    EXPECT_EQ(expected.Triangles.size(), refined.Triangles.size()) << far;
    EXPECT_EQ(0, refined.Report.FromPoints.UnrefinedTriangles) << far;
  }
}

/// Points that are added get numbers of 32 bits, as do their triangles and edges.
TEST(Refine, StaysWithinItsNumbers)
{
  for (const std::int64_t points : { 4, 300000000 })
  {
    const std::int64_t triangles = 2 * points - 5, more = CountPointsThatFit(triangles, points);
    EXPECT_LT(50000000, more);
    EXPECT_NO_THROW(CheckMeshSize(triangles + 2 * more, points + more));
    EXPECT_THROW(CheckMeshSize(triangles + 2 * more + 2, points + more + 1), MeshTooLarge);
  }
  EXPECT_EQ(0, CountPointsThatFit(10, (std::int64_t(1) << 32) - 2));
  EXPECT_EQ(0, CountPointsThatFit(std::int64_t(1) << 31, 10));
}

TEST(Refine, EndsEarly)
{
  const Drawing coast = MakeCoast(600 / Reduction);
  PointOptions options = WithThreads(2, PointOptions());
  options.MinimumAngle = 30.0;
  const Triangulation whole = Triangulate(coast, options);
  const std::int64_t most = whole.Report.FromPoints.Used * 3 / 4;
  PointOptions limited = options;
  limited.PointLimit = most;
  const Refined few = Refine(coast.View(), limited);
  EXPECT_EQ(1, few.Result.Report.FromPoints.ReachedPointLimit);
  EXPECT_EQ(most, few.Result.Report.FromPoints.Used); // not counting points outside of the coast
  EXPECT_EQ(few.Result.Triangles, Triangulate(coast, WithThreads(3, limited)).Triangles);
  EXPECT_EQ(few.Bad, few.Result.Report.FromPoints.UnrefinedTriangles);
  ExpectConstrainedDelaunay(few.Points, few.Result);

  FlipSession session(coast.View(), options);
  int calls = 0;
  while (session.Advance(-1, {}, [&](double) { return ++calls % 5 != 0; }))
  {
  }
  int repetitions = 0;
  while (session.GetReport().StopReason == StopReasonKind::Aborted && ++repetitions < 1000)
  {
    std::vector<std::int32_t> ids = StoreTriangles(session);
    EXPECT_EQ(ids.size(), 3 * static_cast<std::size_t>(session.GetReport().Triangles));
    session.Advance(-1, {}, [&](double) { return ++calls % 5 != 0; });
  }
  EXPECT_EQ(whole.Triangles, StoreTriangles(session));
}

TEST(Refine, SinglePrecision)
{
  const Drawing coast = MakeCoast(300 / Reduction);
  std::vector<float> xy;
  for (const Place& point : coast.Points)
  {
    xy.push_back(static_cast<float>(point[0] - 1000));
    xy.push_back(static_cast<float>(point[1] - 500));
  }
  PointInput input = coast.View();
  input.Points = PlaneArray(xy.data(), static_cast<std::int64_t>(coast.Points.size()), 2);
  PointOptions options;
  options.MinimumAngle = 25.0;
  const Refined refined = Refine(input, options);
  ExpectConstrainedDelaunay(refined.Points, refined.Result);
  EXPECT_EQ(0, refined.Bad);
  for (const Place& point : refined.Points)
  {
    EXPECT_EQ(point[0], static_cast<double>(static_cast<float>(point[0])));
  }
}

/// Squares of such lengths are no doubles. The triangles are counted.
TEST(Refine, DistancesThatCannotBeSquared)
{
  for (const double scale : { 1e-310, 1e160 })
  {
    const Drawing square = MakeSquare(scale);
    PointOptions options;
    options.MinimumAngle = 25.0;
    const Triangulation refined = Triangulate(square, options);
    EXPECT_EQ(2, refined.Report.FromPoints.UnrefinedTriangles) << scale;
    EXPECT_EQ(6U, refined.Triangles.size()) << scale;
  }
}

/// Squares of the segments are no doubles, but those of small triangles are.
TEST(Refine, SegmentsThatCannotBeSquared)
{
  Drawing drawing = MakeSquare(1e155);
  std::mt19937 random(2);
  for (int i = 0; i < 12; ++i)
  {
    drawing.Points.push_back({ DrawReal(random, 0.0, 1e155), DrawReal(random, 0.0, 1e155) });
  }
  PointOptions options;
  options.MinimumAngle = 25.0;
  options.PointLimit = 1000;
  const Refined refined = Refine(drawing.View(), options);
  EXPECT_LT(0, refined.Result.Report.FromPoints.RefinementPoints);
  ExpectRightShares(refined, drawing.Points.size());
}

/// Segments that are far shorter than the largest coordinate are not split: their middles would all
/// be rounded to 0.
TEST(Refine, DistancesOfVeryDifferentSizes)
{
  Drawing drawing;
  drawing.Points = { { 3e-94, 1e16 }, { 0, 8e-32 }, { -1e-144, 0 }, { -2e247, 0 },
    { -8e-28, -5e-228 }, { -2e-26, -6e4 } };
  PointOptions options;
  options.MinimumAngle = 15.0;
  options.PointLimit = 1000;
  const Refined refined = Refine(drawing.View(), options);
  const std::set<Place> places(refined.Points.begin(), refined.Points.end());
  EXPECT_EQ(refined.Points.size(), places.size());
}

/// Segments pass beside points within rounding, as they are given or because they are split where
/// they cross others. They become edges through these points; else their parts could pass them on
/// the other side, and could not be split where triangles would turn over.
TEST(Refine, PointsWithinRoundingOfSegments)
{
  const auto addSegment = [](Drawing& drawing, const Place& from, const Place& to)
  {
    const auto first = static_cast<std::int64_t>(drawing.Points.size());
    drawing.Points.insert(drawing.Points.end(), { from, to });
    drawing.Segments.push_back({ first, first + 1 });
    drawing.Rings.push_back(-1);
  };
  Drawing square;
  square.AddRing({ { -10, -10 }, { 10, -10 }, { 10, 10 }, { -10, 10 } });
  PointOptions options;
  options.MinimumAngle = 30.0;
  options.MaximumEdge = 1.5;

  Drawing beside = square;
  addSegment(beside, { 3, -2 }, { 6, -2 });
  addSegment(beside, { 6.92, -3.1499999999999995 }, { 2, 3 });
  ASSERT_NE(0, Turn(beside.Points, 6, 7, 5));
  const Refined given = ExpectRefined(beside, options);
  EXPECT_GE(1.5, given.LongestEdge);
  EXPECT_EQ(0, given.Bad);
  EXPECT_GT(2000, given.Result.Report.FromPoints.RefinementPoints);

  Drawing crossing = square;
  addSegment(crossing, { 3, -2 }, { 0, -2 });
  addSegment(crossing, { 7, -5 }, { -5, 4 });
  addSegment(crossing, { 5, -4 }, { -2, 6 });
  addSegment(crossing, { 2, 0 }, { 1.3, -1.9999999999 });
  ASSERT_EQ(0, Turn(crossing.Points, 6, 7, 4));
  PointOptions splits;
  splits.SplitCrossings = true;
  const Refined before = Refine(crossing.View(), splits);
  bool isThrough = false;
  for (std::size_t i = 0; i < before.Result.Edges.size(); ++i)
  {
    const auto& [from, to] = before.Result.Edges[i];
    isThrough = isThrough || (before.SegmentsOfEdges[i] == 5 && (from == 4 || to == 4));
  }
  EXPECT_TRUE(isThrough);

  options.MinimumAngle = 0.0;
  options.SplitCrossings = true;
  const Refined split = ExpectRefined(crossing, options);
  EXPECT_GE(1.5, split.LongestEdge);
  EXPECT_GT(2000, split.Result.Report.FromPoints.RefinementPoints);
}

/// A corner is one rounding beyond another segment, so triangles there cannot get good angles,
/// however many points are added.
TEST(Refine, CornersWithinRoundingOfCrossingsEnd)
{
  Drawing drawing;
  drawing.AddRing({ { -10, -10 }, { 10, -10 }, { 10, 10 }, { -10, 10 } });
  drawing.Points.insert(drawing.Points.end(),
    { { 9.6, -9.6 }, { 9.6, 9.6 }, { 3.5596747752497691, 2.5862551100868818 },
      { std::nextafter(9.6, 10.0), 0.0 }, { 3.3978713763747788, -2.4686980596283883 } });
  drawing.Segments.insert(drawing.Segments.end(), { { 4, 5 }, { 6, 7 }, { 7, 8 } });
  drawing.Rings.insert(drawing.Rings.end(), 3, -1);
  PointOptions options;
  options.MinimumAngle = 30.0;
  options.SplitCrossings = true;
  options.PointLimit = 5000;
  const Refined refined = ExpectRefined(drawing, options);
  EXPECT_GT(1000, refined.Result.Report.FromPoints.RefinementPoints);
  EXPECT_GT(20, refined.Result.Report.FromPoints.UnrefinedTriangles);
}

/// Points that divide a slanted edge of an outline are within rounding of the hull. Segments there
/// must not split those of the hull, and the other way round, until they are as short.
TEST(Refine, PointsAlongTheHullEnd)
{
  for (const bool hasSegments : { true, false })
  {
    Places corners = { { 0.0, 10.0 } };
    for (int i = 0; i <= 20; ++i)
    {
      corners.push_back({ 0.7 * i, 0.1 * i });
    }
    Drawing drawing;
    drawing.Points = corners;
    const auto count = static_cast<std::int64_t>(corners.size());
    for (std::int64_t i = 0; i < count && hasSegments; ++i)
    {
      drawing.Segments.push_back({ i, (i + 1) % count });
      drawing.Rings.push_back(-1);
    }
    PointOptions options;
    options.MinimumAngle = 25.0;
    options.PointLimit = 5000;
    const Refined refined = ExpectRefined(drawing, options);
    EXPECT_GT(100, refined.Result.Report.FromPoints.RefinementPoints);
    EXPECT_GT(50, refined.Result.Report.FromPoints.UnrefinedTriangles);
  }
}

/// Points that divide a slanted side of an outline may be a rounding inside of it. Between the
/// sides of the outline and the hull there are no places then, but all triangles get better.
TEST(Refine, OutlinesWithinRoundingOfTheHull)
{
  PointOptions options;
  options.MinimumAngle = 25.0;
  options.MaximumEdge = 0.05;
  for (int i = 0; i < 20 / Reduction; ++i)
  {
    SCOPED_TRACE(i);
    const Places ring = MakeDividedSquare(0.013 + 0.076 * i, 2 + i % 4);
    Drawing square;
    square.AddRing(ring);
    const Refined refined = ExpectRefined(square, options);
    ExpectCovered(square, refined);
    EXPECT_EQ(0, refined.Result.Report.FromPoints.UnrefinedTriangles);
    EXPECT_EQ(0, refined.Bad);
    EXPECT_GE(options.MaximumEdge, refined.LongestEdge);
    EXPECT_NEAR(1.0, refined.Area, 1e-12);

    std::vector<float> xy;
    for (const Place& corner : ring)
    {
      xy.insert(xy.end(), { float(corner[0]), float(corner[1]) });
    }
    PointInput input = square.View();
    input.Points = PlaneArray(xy.data(), static_cast<std::int64_t>(ring.size()), 2);
    const Refined ofFloats = Refine(input, options);
    ExpectConstrainedDelaunay(ofFloats.Points, ofFloats.Result);
    EXPECT_EQ(0, ofFloats.Bad);
    EXPECT_NEAR(1.0, ofFloats.Area, 1e-5);
  }
}

/// The angle at one corner is a little more than three times the goal, and that at another a little
/// more than twice. Triangles that fill these corners are not found.
TEST(Refine, CornersHardlyLargerThanTheGoalEnd)
{
  Drawing drawing;
  drawing.AddRing({ { 0, 0 }, { 1.2, 0 }, { 1.4, 1.2 }, { -0.2, 0.8 } });
  for (const double angle : { 31.0, 32.0, 33.0 })
  {
    SCOPED_TRACE(angle);
    PointOptions options;
    options.MinimumAngle = angle;
    const Refined refined = ExpectRefined(drawing, options);
    double shortest = INFINITY;
    for (std::size_t i = 0; i < refined.Result.Triangles.size(); ++i)
    {
      const std::size_t next = i - i % 3 + (i + 1) % 3;
      shortest = std::min(
        shortest, refined.GetLength(refined.Result.Triangles[i], refined.Result.Triangles[next]));
    }
    EXPECT_GT(200, refined.Result.Report.Triangles);
    EXPECT_LT(1e-3, shortest);
    EXPECT_EQ(1, refined.Result.Report.FromPoints.UnrefinedTriangles);
  }
}

/// Random segments that cross, meet and touch, with sharp corners between them.
TEST(Refine, RandomSegments)
{
  std::mt19937 random(11);
  for (int run = 0; run < 300 / Reduction; ++run)
  {
    SCOPED_TRACE(run);
    Drawing drawing;
    drawing.Points = DrawOnGrid(random, 4 + DrawIndex(random, 30), 12, 12);
    for (std::size_t left = DrawIndex(random, 15); left > 0; --left)
    {
      drawing.Segments.push_back(
        { static_cast<std::int64_t>(DrawIndex(random, drawing.Points.size())),
          static_cast<std::int64_t>(DrawIndex(random, drawing.Points.size())) });
      drawing.Rings.push_back(-1);
    }
    PointOptions options;
    options.SplitCrossings = DrawIndex(random, 2) == 0;
    options.MinimumAngle = 10.0 + static_cast<double>(DrawIndex(random, 20));
    options.KeepBoundary = DrawIndex(random, 4) == 0;
    options.MaximumArea = DrawIndex(random, 3) == 0 ? 0.5 : 0.0;
    ExpectRefined(drawing, options);
  }
}

}
}
