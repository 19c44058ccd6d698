// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "References.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

/// @file
/// Triangles without area, from points in line: all triangulations of small point sets that have
/// them, judged by integers.

namespace delaunayflip
{
namespace
{

/// Coordinates up to some 10,000, so that determinants fit 64 bits.
using WholePoint = std::array<std::int64_t, 2>;

/// What is inside of what, in integers, for points with small whole coordinates.
class Judge
{
public:
  explicit Judge(const OwnedMesh<double>& mesh)
  {
    for (std::size_t i = 0; i < mesh.Points.size(); i += 3)
    {
      this->Points.push_back({ static_cast<std::int64_t>(mesh.Points[i]),
        static_cast<std::int64_t>(mesh.Points[i + 1]) });
    }
  }

  /// Twice the area of a triangle, positive where it turns left.
  std::int64_t GetArea(std::int64_t a, std::int64_t b, std::int64_t c) const
  {
    const WholePoint &x = this->Points[a], &y = this->Points[b], &z = this->Points[c];
    return (x[0] - z[0]) * (y[1] - z[1]) - (x[1] - z[1]) * (y[0] - z[0]);
  }

  /// Whether d is in the circle of a triangle that turns left.
  bool IsInCircle(std::int64_t a, std::int64_t b, std::int64_t c, std::int64_t d) const
  {
    return this->Dot(d, a, a) * this->GetArea(b, c, d) +
      this->Dot(d, b, b) * this->GetArea(c, a, d) + this->Dot(d, c, c) * this->GetArea(a, b, d) >
      0;
  }

  /// The inner product of the vectors from i to p and to q.
  std::int64_t Dot(std::int64_t i, std::int64_t p, std::int64_t q) const
  {
    const WholePoint &x = this->Points[i], &y = this->Points[p], &z = this->Points[q];
    return (y[0] - x[0]) * (z[0] - x[0]) + (y[1] - x[1]) * (z[1] - x[1]);
  }

  std::vector<WholePoint> Points;
};

OppositeMap FindOppositesOf(const TriangleSet& triangles)
{
  return FindOpposites(ViewTriangles(ToIds(triangles)));
}

/// Edges that are bad: the opposite vertex of one triangle lies inside the circle of the other, or
/// both have no area and the edge spans their opposite vertices.
std::int64_t CountBadEdges(const Judge& judge, const TriangleSet& triangles)
{
  return CountEdges(FindOppositesOf(triangles),
    [&](std::int64_t a, std::int64_t p, std::int64_t q, std::int64_t b)
    {
      const bool spans = judge.Dot(a, p, q) <= 0 && judge.Dot(b, p, q) <= 0 &&
        judge.Dot(a, b, b) < judge.Dot(p, q, q);
      return judge.GetArea(a, p, q) > 0 ? judge.IsInCircle(a, p, q, b)
        : judge.GetArea(b, q, p) > 0    ? judge.IsInCircle(b, q, p, a)
                                        : spans;
    });
}

TriangleSet GetFlipped(
  const TriangleSet& triangles, std::int64_t a, std::int64_t p, std::int64_t q, std::int64_t b)
{
  std::vector<std::int32_t> flipped;
  for (const auto& triangle : triangles)
  {
    const bool hasP = std::count(triangle.begin(), triangle.end(), p) > 0;
    const bool hasQ = std::count(triangle.begin(), triangle.end(), q) > 0;
    if (!(hasP && hasQ))
    {
      flipped.insert(flipped.end(), triangle.begin(), triangle.end());
    }
  }
  for (const std::int64_t id : { a, p, b, b, q, a })
  {
    flipped.push_back(static_cast<std::int32_t>(id));
  }
  return ToTriangleSet(flipped);
}

/// Triangulations to which one flip leads, if both new triangles turn left or have no area.
std::vector<TriangleSet> ListNeighbours(const Judge& judge, const TriangleSet& triangles)
{
  std::vector<TriangleSet> neighbours;
  const OppositeMap opposites = FindOppositesOf(triangles);
  FindEdge(opposites,
    [&](std::int64_t a, std::int64_t p, std::int64_t q, std::int64_t b)
    {
      const bool exists = opposites.count({ a, b }) + opposites.count({ b, a }) > 0;
      if (a != b && !exists && judge.GetArea(a, p, b) >= 0 && judge.GetArea(b, q, a) >= 0)
      {
        neighbours.push_back(GetFlipped(triangles, a, p, q, b));
      }
      return false;
    });
  return neighbours;
}

/// All triangulations of a boundary, up to a number.
std::set<TriangleSet> ListTriangulations(const Judge& judge, const TriangleSet& first)
{
  constexpr std::size_t Most = 4000 / Reduction;
  std::set<TriangleSet> known = { first };
  std::vector<TriangleSet> open = { first };
  while (!open.empty() && known.size() < Most)
  {
    const TriangleSet next = open.back();
    open.pop_back();
    for (const TriangleSet& neighbour : ListNeighbours(judge, next))
    {
      if (known.insert(neighbour).second)
      {
        open.push_back(neighbour);
      }
    }
  }
  return known;
}

/// Covers pairs of boundary edges in line by triangles without area, so that the longer edge is on
/// the boundary, as long as there are such pairs.
void CoverBoundary(OwnedMesh<double>& mesh)
{
  const Judge judge(mesh);
  for (bool changed = true; changed;)
  {
    changed = false;
    const OppositeMap opposites = FindOpposites(mesh.View().Triangles);
    std::map<std::int64_t, std::int64_t> next;
    for (const auto& [edge, opposite] : opposites)
    {
      if (opposites.count({ edge.second, edge.first }) == 0)
      {
        next[edge.first] = edge.second;
      }
    }
    for (const auto& [p, m] : next)
    {
      const std::int64_t q = next[m];
      if (!changed && judge.GetArea(p, m, q) == 0)
      {
        for (const std::int64_t id : { m, p, q })
        {
          mesh.Triangles.push_back(static_cast<std::int32_t>(id));
        }
        changed = true;
      }
    }
  }
}

TriangleSet DropFlat(const Judge& judge, const TriangleSet& triangles)
{
  TriangleSet kept;
  std::copy_if(triangles.begin(), triangles.end(), std::back_inserter(kept),
    [&](const auto& t) { return judge.GetArea(t[0], t[1], t[2]) != 0; });
  return kept;
}

/// Whether no point lies inside the circle of a triangle with an area.
bool AreCirclesEmpty(const Judge& judge, const TriangleSet& triangles)
{
  for (const auto& [a, b, c] : DropFlat(judge, triangles))
  {
    for (std::int64_t d = 0; d < static_cast<std::int64_t>(judge.Points.size()); ++d)
    {
      if (judge.IsInCircle(a, b, c, d))
      {
        return false;
      }
    }
  }
  return true;
}

struct PointSet
{
  const char* Name;
  Places Points;
};

const PointSet PointSets[] = {
  { "FourInLineBelowOne", { { 0, 0 }, { 1, 0 }, { 2, 0 }, { 3, 0 }, { 1, 3 } } },
  { "FourInLineBetweenTwo", { { 0, 0 }, { 1, 0 }, { 2, 0 }, { 4, 0 }, { 2, 3 }, { 1, -2 } } },
  { "FiveInLineBetweenTwo",
    { { 0, 0 }, { 1, 0 }, { 2, 0 }, { 4, 0 }, { 5, 0 }, { 2, 3 }, { 1, -2 } } },
  { "TwoLinesOfThree", { { 0, 0 }, { 2, 0 }, { 4, 0 }, { 0, 2 }, { 1, 2 }, { 4, 2 }, { 2, 1 } } },
  { "Cross",
    { { -2, 0 }, { -1, 0 }, { 0, 0 }, { 1, 0 }, { 2, 0 }, { 0, 3 }, { 0, 1 }, { 0, -2 } } },
  { "ThreeByThree",
    { { 0, 0 }, { 1, 0 }, { 2, 0 }, { 0, 1 }, { 1, 1 }, { 2, 1 }, { 0, 2 }, { 1, 2 }, { 2, 2 } } },
  { "Askew", { { 0, 0 }, { 2, 1 }, { 4, 2 }, { 6, 3 }, { 1, 4 }, { 5, -3 }, { 3, 3 } } },
};

class FlatTriangles : public testing::TestWithParam<PointSet>
{
protected:
  /// Calls check(mesh, triangulation) for all triangulations, of the convex hull and, where points
  /// of its sides are in line, of the hull with long sides.
  template <typename Check>
  void ForTriangulations(const Check& check) const
  {
    OwnedMesh<double> swept = MakeSweptMesh(GetParam().Points);
    OwnedMesh<double> covered = swept;
    CoverBoundary(covered);
    for (OwnedMesh<double>& mesh : { std::ref(swept), std::ref(covered) })
    {
      const Judge judge(mesh);
      for (const TriangleSet& triangulation :
        ListTriangulations(judge, ToTriangleSet(mesh.Triangles)))
      {
        mesh.Triangles = ToIds(triangulation);
        check(mesh);
        ASSERT_FALSE(this->HasFailure()) << testing::PrintToString(triangulation);
      }
    }
  }
};

/// Every bad edge is counted, before and after. Where none is left the circles of all triangles are
/// empty; where some are, their flips would make edges that exist.
/// @returns how many are left.
std::int64_t CheckFlips(const OwnedMesh<double>& mesh)
{
  const Judge judge(mesh);
  const FlipResult result = FlipAndAudit(mesh.View(), InPlane());
  const FlipReport& report = result.Report;
  const TriangleSet after = ToTriangleSet(result.Triangles);
  EXPECT_EQ(CountBadEdges(judge, ToTriangleSet(mesh.Triangles)), report.NonDelaunayBefore);
  EXPECT_EQ(CountBadEdges(judge, after), report.NonDelaunayAfter);
  EXPECT_EQ(report.NonDelaunayAfter, report.BlockedByEdge);
  EXPECT_TRUE(report.NonDelaunayAfter > 0 || AreCirclesEmpty(judge, after));
  return report.NonDelaunayAfter;
}

TEST_P(FlatTriangles, LeaveNoBadEdgeUncounted)
{
  std::int64_t meshes = 0, left = 0;
  this->ForTriangulations(
    [&](const OwnedMesh<double>& mesh)
    {
      ++meshes;
      left += CheckFlips(mesh) > 0 ? 1 : 0;
    });
  EXPECT_LT(8, meshes);
  EXPECT_LE(left, meshes / 7);
}

/// Longer walks from one triangulation to the next, on larger lattices.
TEST(FlatTrianglesOfLattices, LeaveNoBadEdgeUncounted)
{
  std::mt19937 random(17);
  for (int i = 0; i < 300 / Reduction; ++i)
  {
    OwnedMesh<double> mesh = MakeSweptMesh(DrawDistinct(random, 8 + i % 10, 6, 4));
    if (i % 2 == 0)
    {
      CoverBoundary(mesh);
    }
    const Judge judge(mesh);
    for (int step = 0; step < 60; ++step)
    {
      const std::vector<TriangleSet> neighbours =
        ListNeighbours(judge, ToTriangleSet(mesh.Triangles));
      if (!neighbours.empty())
      {
        mesh.Triangles =
          ToIds(neighbours[DrawIndex(random, static_cast<std::int64_t>(neighbours.size()))]);
      }
    }
    CheckFlips(mesh);
    ASSERT_FALSE(testing::Test::HasFailure()) << i;
  }
}

/// Point 3 is where point 0 or 1 is, so all are on a circle; a flip would only move the flat
/// triangle.
TEST(FlatTrianglesOfOnePlace, AreNoTies)
{
  for (const std::int32_t twin : { 0, 1 })
  {
    OwnedMesh<double> mesh;
    mesh.Points = { 0, 0, 0, 4, 0, 0, 2, -3, 0, 4.0 * twin, 0, 0 };
    mesh.Triangles = { 0, 2, 1, 0, 1, 3 };
    const FlipReport report = Flip(mesh.View(), InPlane(TieRuleKind::Canonical)).Report;
    EXPECT_EQ(0, report.NonDelaunayBefore);
    EXPECT_EQ(0, report.TotalFlips);
  }
}

TEST_P(FlatTriangles, CanonicalTrianglesWithAreaAreTheSame)
{
  std::map<std::size_t, TriangleSet> results;
  this->ForTriangulations(
    [&](const OwnedMesh<double>& mesh)
    {
      const FlipResult result = Flip(mesh.View(), InPlane(TieRuleKind::Canonical));
      const TriangleSet kept = DropFlat(Judge(mesh), ToTriangleSet(result.Triangles));
      const auto first = results.emplace(mesh.Triangles.size(), kept).first; // by the boundary
      EXPECT_TRUE(result.Report.NonDelaunayAfter > 0 || first->second == kept);
    });
}

INSTANTIATE_TEST_SUITE_P(PointSets, FlatTriangles, testing::ValuesIn(PointSets), GetCaseName);

}
}
