// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PointTestSupport.h"
#include "RandomInputs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <set>
#include <utility>
#include <vector>

/// @file
/// Triangles that are cut off, compared with those that a walk from triangle to triangle leaves.

namespace delaunayflip
{
namespace
{

/// Rings in the cells of a grid, breaklines, hole seeds and points, all with whole coordinates.
struct CutCase
{
  Drawing Given;
  std::vector<Places> Rings;
  PointOptions Options;
};

constexpr int CellSize = 64, Cells = 4;

/// A ring around the center of a cell. Those of holes are inside those of the outline.
Places DrawRing(std::mt19937& random, int cell, double largest)
{
  const double u = (cell % Cells + 0.5) * CellSize, v = (cell / Cells + 0.5) * CellSize;
  const int corners = 3 + DrawIndex(random, 6);
  const bool isClockwise = DrawIndex(random, 2) == 0;
  Places ring;
  for (int i = 0; i < corners; ++i)
  {
    const double angle = (isClockwise ? -1.0 : 1.0) * 6.28 * i / corners;
    const double radius = largest * (0.8 + 0.2 * DrawIndex(random, 2));
    ring.push_back(
      { std::round(u + radius * std::cos(angle)), std::round(v + radius * std::sin(angle)) });
  }
  return ring;
}

CutCase DrawCase(unsigned seed, std::size_t points)
{
  std::mt19937 random(seed);
  CutCase drawn;
  Drawing& drawing = drawn.Given;
  drawing.Points = DrawOnGrid(random, points, Cells * CellSize, Cells * CellSize);
  const int outlines = DrawIndex(random, 3);
  const bool hasHoles = DrawIndex(random, 2) == 0;
  // First rings of the outline, then holes.
  for (int set = 0; set < 2; ++set)
  {
    drawing.FirstHole = static_cast<std::int32_t>(drawn.Rings.size());
    for (int cell = 0; cell < Cells * Cells; ++cell)
    {
      const bool isDrawn = DrawIndex(random, 3) == 0 && (set == 1 ? hasHoles : outlines > 0);
      if (isDrawn)
      {
        drawn.Rings.push_back(DrawRing(random, cell, set == 0 ? 30.0 : 10.0));
      }
    }
    if (set == 0 && outlines == 2)
    {
      const double end = Cells * CellSize + 1.0;
      drawn.Rings.push_back({ { -1.0, -1.0 }, { end, -1.0 }, { end, end }, { -1.0, end } });
    }
  }
  for (const Places& ring : drawn.Rings)
  {
    drawing.AddRing(ring);
  }
  for (int i = DrawIndex(random, 20); i > 0; --i)
  {
    const auto all = static_cast<int>(drawing.Points.size());
    drawing.Segments.push_back({ DrawIndex(random, all), DrawIndex(random, all) });
    drawing.Rings.push_back(-1);
  }
  for (int i = DrawIndex(random, 3); i > 0; --i)
  {
    drawing.Seeds.push_back(DrawIndex(random, Cells * CellSize));
    drawing.Seeds.push_back(DrawIndex(random, Cells * CellSize));
  }
  drawn.Options.RingRule = static_cast<RingRuleKind>(DrawIndex(random, 3));
  drawn.Options.LongestEdge = DrawIndex(random, 3) == 0 ? 20.5 : 0.0;
  drawn.Options.NumberOfThreads = 1 + DrawIndex(random, 3);
  return drawn;
}

/// How often a ring winds around a place, counter-clockwise. Coordinates are three times those of
/// the ring, so that they are whole for a centroid.
int CountTurns(const Places& ring, const Place& place)
{
  int turns = 0;
  for (std::size_t i = 0; i < ring.size(); ++i)
  {
    const Place &from = ring[i], &to = ring[(i + 1) % ring.size()];
    const bool isUp = 3.0 * from[1] <= place[1] && 3.0 * to[1] > place[1];
    const bool isDown = 3.0 * from[1] > place[1] && 3.0 * to[1] <= place[1];
    const double side = (3.0 * to[0] - 3.0 * from[0]) * (place[1] - 3.0 * from[1]) -
      (3.0 * to[1] - 3.0 * from[1]) * (place[0] - 3.0 * from[0]);
    turns += isUp && side > 0.0 ? 1 : 0;
    turns -= isDown && side < 0.0 ? 1 : 0;
  }
  return turns;
}

bool IsInside(int turns, RingRuleKind rule)
{
  return rule == RingRuleKind::EvenOdd ? turns % 2 != 0 : turns != 0;
}

/// Which triangles of the whole triangulation are removed, by a search of each triangle.
class Walk
{
public:
  Walk(const CutCase& drawn, const Triangulation& whole)
    : Drawn(drawn),
      Points(drawn.Given.Points),
      Whole(whole),
      IsRemoved(whole.Triangles.size() / 3, false)
  {
    for (const auto& edge : whole.Edges)
    {
      this->Segments.insert(std::minmax(edge[0], edge[1]));
    }
    this->RemoveOutside();
    this->RemoveAroundSeeds();
    this->RemoveLarge();
  }

  const std::vector<bool>& Get() const { return this->IsRemoved; }

private:
  void RemoveOutside()
  {
    const auto firstHole = static_cast<std::size_t>(this->Drawn.Given.FirstHole);
    const RingRuleKind rule = this->Drawn.Options.RingRule;
    bool anyIsCounterClockwise = false;
    for (std::size_t i = 0; i < firstHole; ++i)
    {
      const Places& ring = this->Drawn.Rings[i];
      double area = 0.0;
      for (std::size_t k = 0; k < ring.size(); ++k)
      {
        const Place& next = ring[(k + 1) % ring.size()];
        area += ring[k][0] * next[1] - ring[k][1] * next[0];
      }
      anyIsCounterClockwise = anyIsCounterClockwise || area > 0.0;
    }
    for (std::size_t t = 0; t < this->IsRemoved.size(); ++t)
    {
      Place centroid = { 0.0, 0.0 };
      for (std::size_t k = 3 * t; k < 3 * t + 3; ++k)
      {
        centroid[0] += this->Points[this->Whole.Triangles[k]][0];
        centroid[1] += this->Points[this->Whole.Triangles[k]][1];
      }
      int ofOutline = 0, ofHoles = 0;
      for (std::size_t i = 0; i < this->Drawn.Rings.size(); ++i)
      {
        (i < firstHole ? ofOutline : ofHoles) += CountTurns(this->Drawn.Rings[i], centroid);
      }
      bool isOutside = !IsInside(ofOutline, rule);
      if (rule == RingRuleKind::Orientation)
      {
        isOutside = ofOutline < 0 || (ofOutline == 0 && anyIsCounterClockwise);
      }
      this->IsRemoved[t] = IsInside(ofHoles, rule) || (firstHole > 0 && isOutside);
    }
  }

  bool HasSegment(std::size_t corner) const
  {
    const std::size_t first = corner - corner % 3;
    const std::int64_t a = this->Whole.Triangles[first + (corner + 1) % 3];
    const std::int64_t b = this->Whole.Triangles[first + (corner + 2) % 3];
    return this->Segments.count(std::minmax(a, b)) > 0;
  }

  void RemoveAroundSeeds()
  {
    const std::vector<double>& seeds = this->Drawn.Given.Seeds;
    std::vector<std::size_t> stack;
    for (std::size_t i = 0; i < seeds.size(); i += 2)
    {
      const std::size_t found = this->FindTriangle({ seeds[i], seeds[i + 1] });
      if (found < this->IsRemoved.size())
      {
        stack.push_back(found);
      }
    }
    std::set<std::size_t> seen;
    while (!stack.empty())
    {
      const std::size_t triangle = stack.back();
      stack.pop_back();
      if (!seen.insert(triangle).second)
      {
        continue;
      }
      this->IsRemoved[triangle] = true;
      for (std::size_t corner = 3 * triangle; corner < 3 * triangle + 3; ++corner)
      {
        const std::int32_t across = this->Whole.Neighbors[corner];
        if (across >= 0 && !this->HasSegment(corner))
        {
          stack.push_back(static_cast<std::size_t>(across));
        }
      }
    }
  }

  /// The triangle that has a place, or the number of triangles. Of several, it is the one with the
  /// lowest places of corners.
  std::size_t FindTriangle(const Place& place) const
  {
    std::size_t found = this->IsRemoved.size();
    for (std::size_t t = 0; t < this->IsRemoved.size(); ++t)
    {
      bool isInside = true;
      for (std::size_t k = 0; k < 3 && isInside; ++k)
      {
        const Place& from = this->Points[this->Whole.Triangles[3 * t + k]];
        const Place& to = this->Points[this->Whole.Triangles[3 * t + (k + 1) % 3]];
        isInside =
          (to[0] - from[0]) * (place[1] - from[1]) - (to[1] - from[1]) * (place[0] - from[0]) >=
          0.0;
      }
      const bool isLowest =
        found == this->IsRemoved.size() || this->SortCorners(t) < this->SortCorners(found);
      if (isInside && isLowest)
      {
        found = t;
      }
    }
    return found;
  }

  std::vector<Place> SortCorners(std::size_t triangle) const
  {
    std::vector<Place> corners;
    for (std::size_t corner = 3 * triangle; corner < 3 * triangle + 3; ++corner)
    {
      corners.push_back(this->Points[this->Whole.Triangles[corner]]);
    }
    std::sort(corners.begin(), corners.end());
    return corners;
  }

  void RemoveLarge()
  {
    const double longest = this->Drawn.Options.LongestEdge;
    for (std::size_t i = 0; i < this->Whole.Triangles.size() && longest > 0.0; ++i)
    {
      const std::size_t first = i - i % 3;
      const Place& a = this->Points[this->Whole.Triangles[i]];
      const Place& b = this->Points[this->Whole.Triangles[first + (i + 1) % 3]];
      const double u = b[0] - a[0], v = b[1] - a[1];
      const bool hasSegment =
        this->HasSegment(first) || this->HasSegment(first + 1) || this->HasSegment(first + 2);
      if (!hasSegment && u * u + v * v > longest * longest)
      {
        this->IsRemoved[i / 3] = true;
      }
    }
  }

  const CutCase& Drawn;
  const Places& Points;
  const Triangulation& Whole;
  std::set<std::pair<std::int64_t, std::int64_t>> Segments;
  std::vector<bool> IsRemoved;
};

/// @returns how many triangles are removed.
std::size_t CompareWithWalk(const CutCase& drawn)
{
  Drawing uncut = drawn.Given;
  uncut.Rings.clear(); // all are breaklines
  uncut.Seeds.clear();
  const Triangulation whole = Triangulate(uncut);
  const Triangulation cut = Triangulate(drawn.Given, drawn.Options);
  const std::vector<bool> isRemoved = Walk(drawn, whole).Get();
  std::vector<std::int32_t> numbers, triangles, neighbors;
  std::set<std::int32_t> used;
  std::int32_t next = 0;
  for (const bool isGone : isRemoved)
  {
    numbers.push_back(isGone ? -1 : next++);
  }
  for (std::size_t i = 0; i < whole.Triangles.size(); ++i)
  {
    if (!isRemoved[i / 3])
    {
      triangles.push_back(whole.Triangles[i]);
      used.insert(whole.Triangles[i]);
      neighbors.push_back(whole.Neighbors[i] < 0 ? -1 : numbers[whole.Neighbors[i]]);
    }
  }
  EXPECT_EQ(triangles, cut.Triangles);
  EXPECT_EQ(neighbors, cut.Neighbors);
  EXPECT_EQ(next, cut.Report.Triangles);
  EXPECT_EQ(static_cast<std::int64_t>(used.size()), cut.Report.FromPoints.Used);
  const std::int64_t border = CountBorder(cut);
  EXPECT_EQ(border, cut.Report.Edges.Boundary);
  EXPECT_EQ((3 * std::int64_t(next) + border) / 2, cut.Report.Edges.Edges);
  return isRemoved.size() - static_cast<std::size_t>(next);
}

TEST(Cut, LeavesWhatAWalkLeaves)
{
  int cases = 0, some = 0;
  for (unsigned seed = 0; seed < 200 && !testing::Test::HasFailure(); ++seed)
  {
    SCOPED_TRACE(seed);
    ++cases;
    some += CompareWithWalk(DrawCase(seed, 20 + 2 * seed)) > 0 ? 1 : 0;
  }
  EXPECT_GT(some, cases / 2);
  EXPECT_LT(some, cases);
}

/// So many triangles that several threads share each pass.
TEST(Cut, LeavesWhatAWalkLeavesOnManyThreads)
{
  std::size_t removed = 0;
  for (unsigned seed = 1000; seed < 1004; ++seed)
  {
    SCOPED_TRACE(seed);
    CutCase drawn = DrawCase(seed, 60000);
    drawn.Options.NumberOfThreads = 4;
    removed += CompareWithWalk(drawn);
  }
  EXPECT_GT(removed, std::size_t(0));
}

}
}
