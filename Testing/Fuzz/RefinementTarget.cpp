// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ByteSource.h"
#include "DividedSquare.h"
#include "FuzzTarget.h"
#include "PointTestSupport.h"
#include "PrintDrawing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <map>
#include <set>
#include <vector>

/// @file
/// Refinement of outlines with holes, sharp corners and segments that nearly touch, as a target for
/// fuzzers. It is judged by what it promises, not by how it works.

namespace delaunayflip
{
namespace
{

constexpr double TooShort = 3e-12; // 1024 roundings of the coordinates; see RefinementStep::IsShort

/// Up to this angle in degrees, refinement ends long before the limit. Above, it may never end, or
/// make ever shorter edges at a corner until they are too short to be split. Two nested rings that
/// are 0.03 apart need 20,000 points for 30 degrees, and there may be four.
constexpr double LargestSafeAngle = 30.0;
constexpr std::int64_t PointLimit = 100000, UnsafeLimit = 3000;
/// Above LargestSafeAngle, triangles that are far smaller than the features there are left.
constexpr double ShortForUnsafe = 0.2;

struct RefinementCase
{
  Drawing Input;
  std::vector<RegionSeed> Regions;
  PointOptions Options;

  PointInput View() const
  {
    PointInput input = this->Input.View();
    input.Regions = this->Regions.data();
    input.NumberOfRegions = static_cast<std::int64_t>(this->Regions.size());
    return input;
  }
};

/// Makes the drawings of cases.
class CaseMaker
{
public:
  CaseMaker(const std::uint8_t* bytes, std::size_t size)
    : Source(bytes, size)
  {
  }

  RefinementCase Make()
  {
    this->AddOutline();
    this->AddNestedRings();
    for (std::uint32_t left = this->Source.Draw(3); left > 0; --left)
    {
      this->AddFan();
    }
    for (std::uint32_t left = this->Source.Draw(3); left > 0; --left)
    {
      this->AddNearSegments();
    }
    for (std::uint32_t left = this->Source.Draw(this->Source.Once(4) ? 60 : 8); left > 0; --left)
    {
      this->AddPoint(this->DrawPlace());
    }
    for (std::uint32_t left = this->Source.Draw(5); left > 0; --left)
    {
      this->AddSegment(this->AddPoint(this->DrawPlace()), this->AddPoint(this->DrawPlace()));
    }
    this->DrawGoals();
    return this->Made;
  }

private:
  /// A place that is on a coarse grid in half of the cases.
  Place DrawPlace()
  {
    const double step = this->Source.Once(2) ? 1.0 : 0.01;
    const auto count = static_cast<std::uint32_t>(18.0 / step);
    const double x = step * this->Source.Draw(count);
    return { x - 9.0, step * this->Source.Draw(count) - 9.0 };
  }

  std::int64_t AddPoint(const Place& place)
  {
    this->Made.Input.Points.push_back(place);
    return static_cast<std::int64_t>(this->Made.Input.Points.size()) - 1;
  }

  void AddSegment(std::int64_t from, std::int64_t to)
  {
    this->Made.Input.Segments.push_back({ from, to });
    this->Made.Input.Rings.push_back(-1);
  }

  /// A square, a square with points on its sides, or a star with sharp corners.
  void AddOutline()
  {
    Places corners = { { -10, -10 }, { 10, -10 }, { 10, 10 }, { -10, 10 } };
    if (this->Source.Once(6))
    {
      const double angle = 0.01 * this->Source.Draw(157);
      corners = MakeDividedSquare(angle, 2 + static_cast<int>(this->Source.Draw(4)));
      const double width = 20.0;
      for (Place& corner : corners)
      {
        corner = { width * corner[0], width * corner[1] - 0.5 * width };
      }
    }
    else if (this->Source.Once(2))
    {
      const std::uint32_t count = 3 + this->Source.Draw(12);
      corners.clear();
      for (std::uint32_t i = 0; i < count; ++i)
      {
        const double angle = 2.0 * M_PI * i / count, radius = 2.0 + 0.1 * this->Source.Draw(120);
        corners.push_back({ radius * std::cos(angle), radius * std::sin(angle) });
      }
    }
    this->Made.Input.AddRing(corners);
  }

  /// Squares within each other, the outer one perhaps near the square outline.
  void AddNestedRings()
  {
    const double gaps[] = { 3.0, 1.0, 0.3, 0.1, 0.03 };
    double half = 10.0;
    for (std::uint32_t left = this->Source.Draw(4); left > 0; --left)
    {
      half -= gaps[this->Source.Draw(5)];
      this->Made.Input.AddRing(
        { { -half, -half }, { half, -half }, { half, half }, { -half, half } });
    }
    this->Made.Options.RingRule = static_cast<RingRuleKind>(this->Source.Draw(3));
    this->Made.Input.FirstHole = this->Source.Once(3) ? 1 : INT32_MAX;
  }

  /// Segments that meet at small angles, down to half a degree.
  void AddFan()
  {
    const double angles[] = { 0.0087, 0.0175, 0.05, 0.2, 0.6 };
    const Place place = this->DrawPlace();
    const std::int64_t corner = this->AddPoint(place);
    double angle = 0.1 * this->Source.Draw(63);
    for (std::uint32_t left = 2 + this->Source.Draw(4); left > 0; --left)
    {
      const double length = 0.5 + 0.1 * this->Source.Draw(60);
      const Place end = { place[0] + length * std::cos(angle),
        place[1] + length * std::sin(angle) };
      this->AddSegment(corner, this->AddPoint(end));
      angle += angles[this->Source.Draw(5)];
    }
  }

  /// A segment, and another one that ends very near it, or runs beside it. Along segments beside
  /// each other, there are as many points as their length over their distance.
  void AddNearSegments()
  {
    const double gaps[] = { 1e-2, 1e-4, 1e-7, 1e-10 };
    const Place from = this->DrawPlace();
    const double gap = gaps[this->Source.Draw(4)], x = from[0], y = from[1];
    this->AddSegment(this->AddPoint(from), this->AddPoint({ x + 3.0, y }));
    const double height = gap == 1e-2 && this->Source.Once(4) ? gap : 2.0;
    this->AddSegment(this->AddPoint({ x + 1.3, y + gap }),
      this->AddPoint({ x + this->Source.Draw(4), y + height }));
  }

  void DrawGoals()
  {
    PointOptions& options = this->Made.Options;
    const double angles[] = { 0.0, 15.0, 20.0, 25.0, 30.0, 33.0 };
    const double areas[] = { 0.0, 0.0, 0.5, 3.0 }, edges[] = { 0.0, 0.0, 0.0, 1.5 };
    options.SplitCrossings = this->Source.Once(2);
    options.MinimumAngle = angles[this->Source.Draw(6)];
    options.MaximumArea = areas[this->Source.Draw(4)];
    options.MaximumEdge = edges[this->Source.Draw(4)];
    options.KeepBoundary = this->Source.Once(6);
    options.PointLimit = options.MinimumAngle > LargestSafeAngle ? UnsafeLimit : PointLimit;
    for (std::int32_t label = static_cast<std::int32_t>(this->Source.Draw(4)); label > 0; --label)
    {
      const Place place = this->DrawPlace();
      const double area = this->Source.Once(2) ? 0.0 : 0.2;
      this->Made.Regions.push_back({ place[0], place[1], label, area });
    }
  }

  ByteSource Source;
  RefinementCase Made;
};

/// A mesh with all its points.
struct Outcome
{
  Places Points;
  Triangulation Mesh;
  std::vector<std::int32_t> Regions;
  std::vector<std::int64_t> SegmentsOfEdges;

  Outcome(const PointInput& input, const PointOptions& options)
    : Mesh(Triangulate(input, options))
  {
    const FlipSession session = FlipPoints(input, options);
    this->Regions.resize(this->Mesh.Report.Triangles);
    session.StoreRegions(this->Regions.data());
    this->SegmentsOfEdges = session.ListSegmentsOfEdges();
    for (std::int64_t i = 0; i < input.Points.Count; ++i)
    {
      this->Points.push_back({ input.Points.Get(i, 0), input.Points.Get(i, 1) });
    }
    for (const AddedPoint& added : this->Mesh.Added)
    {
      this->Points.push_back({ added.X, added.Y });
    }
  }

  double GetLength(std::int64_t a, std::int64_t b) const
  {
    return std::hypot(
      this->Points[b][0] - this->Points[a][0], this->Points[b][1] - this->Points[a][1]);
  }

  double GetArea(std::size_t t) const
  {
    const std::int32_t* ids = &this->Mesh.Triangles[3 * t];
    const Place &a = this->Points[ids[0]], &b = this->Points[ids[1]], &c = this->Points[ids[2]];
    return 0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
  }

  /// In degrees, at a corner.
  double GetAngle(std::int64_t at, std::int64_t from, std::int64_t to) const
  {
    const Place &a = this->Points[at], &b = this->Points[from], &c = this->Points[to];
    const long double u1 = (long double)(b[0]) - a[0], v1 = (long double)(b[1]) - a[1];
    const long double u2 = (long double)(c[0]) - a[0], v2 = (long double)(c[1]) - a[1];
    return static_cast<double>(
      std::fabs(std::atan2(u1 * v2 - v1 * u2, u1 * u2 + v1 * v2)) * 180.0L / M_PI);
  }

  /// Whether a boundary edge is in the circumcircle of a triangle or touches it, within rounding.
  bool IsNearBoundary(std::size_t t) const
  {
    constexpr long double Rounding = 1e-6L;
    const std::int32_t* ids = &this->Mesh.Triangles[3 * t];
    const Place &a = this->Points[ids[0]], &b = this->Points[ids[1]], &c = this->Points[ids[2]];
    const long double u1 = (long double)(b[0]) - a[0], v1 = (long double)(b[1]) - a[1];
    const long double u2 = (long double)(c[0]) - a[0], v2 = (long double)(c[1]) - a[1];
    const long double p = u1 * u1 + v1 * v1, q = u2 * u2 + v2 * v2;
    const long double twice = 2.0L * (u1 * v2 - v1 * u2);
    const long double u = (p * v2 - q * v1) / twice, v = (q * u1 - p * u2) / twice;
    const long double most = std::hypot(u, v) * (1.0L + Rounding);
    for (std::size_t i = 0; i < this->Mesh.Neighbors.size(); ++i)
    {
      if (this->Mesh.Neighbors[i] >= 0)
      {
        continue;
      }
      const Place& from = this->Points[this->Mesh.Triangles[i - i % 3 + (i + 1) % 3]];
      const Place& to = this->Points[this->Mesh.Triangles[i - i % 3 + (i + 2) % 3]];
      const long double s = from[0] - a[0] - u, r = from[1] - a[1] - v;
      const long double x = (long double)(to[0]) - from[0], y = (long double)(to[1]) - from[1];
      const long double share = std::clamp(-(s * x + r * y) / (x * x + y * y), 0.0L, 1.0L);
      if (std::hypot(s + share * x, r + share * y) <= most)
      {
        return true;
      }
    }
    return false;
  }

  std::map<std::int32_t, double> SumAreas() const
  {
    std::map<std::int32_t, double> areas;
    for (std::size_t t = 0; t < this->Regions.size(); ++t)
    {
      areas[this->Regions[t]] += this->GetArea(t);
    }
    return areas;
  }

  /// By segment, the length of its edges.
  std::map<std::int64_t, double> SumLengths() const
  {
    std::map<std::int64_t, double> lengths;
    for (std::size_t i = 0; i < this->Mesh.Edges.size(); ++i)
    {
      lengths[this->SegmentsOfEdges[i]] +=
        this->GetLength(this->Mesh.Edges[i][0], this->Mesh.Edges[i][1]);
    }
    return lengths;
  }
};

template <typename Key>
void ExpectSameSums(const std::map<Key, double>& before, const std::map<Key, double>& after)
{
  EXPECT_EQ(before.size(), after.size());
  for (const auto& [key, sum] : before)
  {
    const auto found = after.find(key);
    ASSERT_NE(after.end(), found) << key;
    EXPECT_NEAR(sum, found->second, 1e-9 * std::max(1.0, std::fabs(sum))) << key;
  }
}

/// Finds segments that meet at a small angle. Ends that are too near each other count as one,
/// because a segment may pass within a rounding of a corner. Then it meets the segments there.
class SharpCorners
{
public:
  /// @param before the mesh before refinement. @param after the refined one.
  SharpCorners(const Outcome& before, const Outcome& after)
    : Before(before)
  {
    for (std::size_t i = 0; i < before.Mesh.Edges.size(); ++i)
    {
      const std::int64_t ends[2] = { this->FindCorner(before.Mesh.Edges[i][0]),
        this->FindCorner(before.Mesh.Edges[i][1]) };
      for (const int end : { 0, 1 })
      {
        if (ends[0] != ends[1])
        {
          this->EdgesAt[ends[end]].push_back({ before.SegmentsOfEdges[i], ends[1 - end] });
        }
      }
    }
    for (std::size_t i = 0; i < after.Mesh.Edges.size(); ++i)
    {
      this->SegmentsAt[after.Mesh.Edges[i][0]].insert(after.SegmentsOfEdges[i]);
      this->SegmentsAt[after.Mesh.Edges[i][1]].insert(after.SegmentsOfEdges[i]);
    }
  }

  /// Whether an edge connects segments that meet at less than 60 degrees, or just that.
  bool AreConnected(std::int64_t from, std::int64_t to) const
  {
    constexpr double Sharp = 60.0 + 1e-7;
    for (const auto& [corner, edges] : this->EdgesAt)
    {
      for (const SegmentEnd& a : edges)
      {
        for (const SegmentEnd& b : edges)
        {
          const bool areConnected = &a != &b && this->IsAt(from, a.Segment) &&
            this->IsAt(to, b.Segment) && this->Before.GetAngle(corner, a.Other, b.Other) < Sharp;
          if (areConnected)
          {
            return true;
          }
        }
      }
    }
    return false;
  }

private:
  struct SegmentEnd
  {
    std::int64_t Segment, Other;
  };

  /// The first point that is too near to this one, or this one.
  std::int64_t FindCorner(std::int64_t point) const
  {
    std::int64_t corner = 0;
    while (corner < point && this->Before.GetLength(corner, point) >= TooShort)
    {
      ++corner;
    }
    return corner;
  }

  bool IsAt(std::int64_t vertex, std::int64_t segment) const
  {
    const auto found = this->SegmentsAt.find(vertex);
    return found != this->SegmentsAt.end() && found->second.count(segment) > 0;
  }

  const Outcome& Before;
  std::map<std::int64_t, std::vector<SegmentEnd>> EdgesAt; ///< By point, before.
  std::map<std::int64_t, std::set<std::int64_t>> SegmentsAt; ///< By point, after.
};

/// Every triangle reaches the goals, unless its shortest edge connects segments that meet at a
/// small angle. If the boundary is kept, angles and edges near it need not.
void ExpectGoals(const RefinementCase& drawn, const Outcome& before, const Outcome& after)
{
  constexpr double Rounding = 1e-7;
  const SharpCorners corners(before, after);
  const PointOptions& options = drawn.Options;
  std::map<std::int32_t, double> areas; // by label; each seed has its own
  for (const RegionSeed& seed : drawn.Regions)
  {
    areas[seed.Label] = seed.MaximumArea;
  }
  const double edge = options.MaximumEdge > 0.0 ? options.MaximumEdge : INFINITY;
  const double tooShort = options.MinimumAngle > LargestSafeAngle ? ShortForUnsafe : TooShort;
  std::int64_t bad = 0;
  for (std::size_t t = 0; t < after.Regions.size(); ++t)
  {
    const std::int32_t* ids = &after.Mesh.Triangles[3 * t];
    double shortest = INFINITY, longest = 0.0, smallest = 180.0;
    std::array<std::int32_t, 2> ends{};
    for (int i = 0; i < 3; ++i)
    {
      const std::int32_t a = ids[i], b = ids[(i + 1) % 3], c = ids[(i + 2) % 3];
      const double length = after.GetLength(a, b);
      smallest = std::min(smallest, after.GetAngle(a, b, c));
      longest = std::max(longest, length);
      if (length < shortest)
      {
        shortest = length;
        ends = { a, b };
      }
    }
    const bool isSharp = smallest < options.MinimumAngle - Rounding;
    const bool isLong = longest > edge * (1.0 + Rounding);
    bad += isSharp ? 1 : 0;
    for (const double area : { options.MaximumArea, areas[after.Regions[t]] })
    {
      EXPECT_TRUE(area == 0.0 || after.GetArea(t) <= area * (1.0 + Rounding))
        << "area " << after.GetArea(t) << " with label " << after.Regions[t];
    }
    if ((isSharp || isLong) && !(options.KeepBoundary && after.IsNearBoundary(t)))
    {
      EXPECT_FALSE(isLong) << "edge " << longest;
      EXPECT_TRUE(!isSharp || shortest < tooShort || corners.AreConnected(ends[0], ends[1]))
        << "angle " << smallest << " of " << ids[0] << ' ' << ids[1] << ' ' << ids[2]
        << ", shortest " << shortest << ", at " << after.Points[ids[0]][0] << ' '
        << after.Points[ids[0]][1];
    }
  }
  EXPECT_LE(bad, after.Mesh.Report.FromPoints.UnrefinedTriangles);
}

/// A triangulation of the points and edges of the outcome has its triangles, and others where it
/// has holes.
void ExpectFixed(const Outcome& after)
{
  Drawing drawing;
  drawing.Points = after.Points;
  drawing.Segments = after.Mesh.Edges;
  const Triangulation again = Triangulate(drawing, WithThreads(1, PointOptions()));
  const auto all = ByPlaces(again.Triangles, after.Points);
  const auto own = ByPlaces(after.Mesh.Triangles, after.Points);
  EXPECT_TRUE(std::includes(all.begin(), all.end(), own.begin(), own.end()));
}

/// Reports a failure of GoogleTest for each promise that is broken.
void JudgeCase(const RefinementCase& drawn)
{
  PointOptions without = WithThreads(1, drawn.Options);
  without.MinimumAngle = without.MaximumArea = without.MaximumEdge = 0.0;
  RefinementCase plain = drawn;
  for (RegionSeed& seed : plain.Regions)
  {
    seed.MaximumArea = 0.0;
  }
  try
  {
    Triangulate(plain.View(), without);
  }
  catch (const InvalidMesh&)
  {
    return; // rings that cross a segment
  }
  // Before refinement, segments are split at points within rounding of them. So it begins, and the
  // limit allows no point.
  PointOptions begun = without;
  begun.MaximumArea = 1e-3;
  begun.PointLimit = 1;
  const Outcome before(plain.View(), begun);
  const Outcome after(drawn.View(), WithThreads(1, drawn.Options));
  const Triangulation other = Triangulate(drawn.View(), WithThreads(3, drawn.Options));
  EXPECT_EQ(after.Mesh.Triangles, other.Triangles);
  EXPECT_EQ(after.Mesh.Edges, other.Edges);
  ExpectSameStatistics(after.Mesh.Report, other.Report);
  EXPECT_EQ(StopReasonKind::Converged, after.Mesh.Report.StopReason);
  const bool hasEnded = after.Mesh.Report.FromPoints.ReachedPointLimit == 0;
  EXPECT_TRUE(hasEnded || drawn.Options.MinimumAngle > LargestSafeAngle);
  Triangulation kept = after.Mesh;
  const EdgeMap edges = CollectEdges(ViewTriangles(kept.Triangles));
  const auto isGone = [&](const auto& edge) { return edges.count(Sorted(edge[0], edge[1])) == 0; };
  if (after.Mesh.Report.FromPoints.OutsideTriangles > 0)
  {
    kept.Edges.erase(
      std::remove_if(kept.Edges.begin(), kept.Edges.end(), isGone), kept.Edges.end());
  }
  ExpectConstrainedDelaunay(after.Points, kept);
  ExpectSameSums(before.SumAreas(), after.SumAreas());
  ExpectSameSums(before.SumLengths(), after.SumLengths());
  if (hasEnded)
  {
    ExpectGoals(drawn, before, after);
  }
  ExpectFixed(after);
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
  JudgeCase(CaseMaker(bytes, size).Make());
}

void PrintTarget(const std::uint8_t* bytes, std::size_t size)
{
  const RefinementCase drawn = CaseMaker(bytes, size).Make();
  PrintDrawing(drawn.Input);
  for (const RegionSeed& seed : drawn.Regions)
  {
    std::cout << "region " << seed.X << ' ' << seed.Y << ' ' << seed.Label << ' '
              << seed.MaximumArea << '\n';
  }
  const PointOptions& options = drawn.Options;
  std::cout << "split " << options.SplitCrossings << ", ring rule "
            << static_cast<int>(options.RingRule) << ", first hole " << drawn.Input.FirstHole
            << ", minimum angle " << options.MinimumAngle << ", maximum area "
            << options.MaximumArea << ", maximum edge " << options.MaximumEdge << ", keep boundary "
            << options.KeepBoundary << '\n';
}
