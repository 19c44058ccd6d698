// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "MeshAudit.h"
#include "References.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

/// @file
/// Whole runs in a plane become what CGAL, rational numbers and Lawson's algorithm make.

namespace delaunayflip
{
namespace
{

constexpr TieRuleKind TieRules[] = { TieRuleKind::Keep, TieRuleKind::Canonical };

/// All that must hold for a planar, counter-clockwise result.
FlipResult ExpectDelaunay(const TriangleMesh& mesh, TieRuleKind rule = TieRuleKind::Keep)
{
  const FlipResult result = FlipAndAudit(mesh, With(&FlipOptions::TieRule, rule));
  const TriangleMesh after = WithTriangles(mesh, result.Triangles);
  EXPECT_EQ(0, result.Report.NonDelaunayAfter);
  EXPECT_EQ(0, CountCgalViolations(after));
  EXPECT_EQ(mesh.Triangles.Count, CountTurns(after).Left);
  return result;
}

/// With ties that the rule decides, also CGAL's very triangles.
void ExpectCgals(const TriangleMesh& mesh)
{
  ExpectDelaunay(mesh);
  EXPECT_TRUE(MakeCgalDelaunay(mesh.Points) ==
    ToTriangleSet(ExpectDelaunay(mesh, TieRuleKind::Canonical).Triangles));
}

struct RandomMesh
{
  std::int64_t Points;
  std::uint32_t Seed;
};

class RandomMeshTest : public testing::TestWithParam<RandomMesh>
{
};

/// Floats, doubles and 64-bit ids give the same; and the output may be the input's own array.
TEST_P(RandomMeshTest, BecomesDelaunay)
{
  const std::int64_t size = std::max<std::int64_t>(4, GetParam().Points / Reduction);
  const OwnedMesh<float> floats = MakeRandomBadMesh(size, GetParam().Seed);
  ExpectCgals(floats.View());
  const OwnedMesh<double> doubles = MakeRandomBadMeshDouble(size, GetParam().Seed);
  const FlipResult expected = Flip(floats.View());
  EXPECT_TRUE(expected.Triangles == Flip(doubles.View()).Triangles);
  std::vector<std::int64_t> ids(doubles.Triangles.begin(), doubles.Triangles.end());
  TriangleMesh mesh = doubles.View();
  mesh.Triangles = TriangleArray(ids.data(), doubles.NumberOfTriangles());
  FlipToDelaunay(mesh, OnTestBackend({}), MutableTriangleArray(ids.data(), mesh.Triangles.Count));
  EXPECT_TRUE(std::equal(ids.begin(), ids.end(), expected.Triangles.begin()));
}

INSTANTIATE_TEST_SUITE_P(Sizes, RandomMeshTest,
  testing::Values(RandomMesh{ 4, 1 }, RandomMesh{ 5, 1 }, RandomMesh{ 6, 2 }, RandomMesh{ 10, 3 },
    RandomMesh{ 100, 1 }, RandomMesh{ 1000, 2 }, RandomMesh{ 10000, 3 }, RandomMesh{ 30000, 4 },
    RandomMesh{ 100000, 5 }),
  [](const auto& test)
  { return std::to_string(test.param.Points) + "PointsSeed" + std::to_string(test.param.Seed); });

/// Random points of a small lattice, with many ties.
TEST(LatticePoints, BecomeCgalsTriangles)
{
  for (std::uint32_t seed = 1; seed <= 40 / Reduction; ++seed)
  {
    SCOPED_TRACE(seed);
    const auto size = static_cast<int>(4 + seed), share = static_cast<int>(25 * (1 + seed % 4));
    std::mt19937 random(seed);
    Places points;
    for (int i = 0; i < size * size; ++i)
    {
      if (DrawIndex(random, 100) < share)
      {
        points.push_back({ double(i % size), double(i / size) });
      }
    }
    ExpectCgals(MakeSweptMesh(points).View());
  }
}

TEST(OppositeAngles, ReachNearlyTheSameMesh)
{
  const OwnedMesh<double> mesh = MakeRandomBadMeshDouble(3000, 10);
  const FlipResult result =
    FlipAndAudit(mesh.View(), With(&FlipOptions::Criterion, CriterionKind::OppositeAngles));
  const TriangleMesh after = WithTriangles(mesh.View(), result.Triangles);
  EXPECT_EQ(0, result.Report.NonDelaunayAfter);
  EXPECT_EQ(mesh.NumberOfTriangles(), CountTurns(after).Left);
  // In-circle may find edges within the tolerance; the paper reports 0.05 % of edges.
  EXPECT_LE(CountNonDelaunayEdges(after, FlipOptions()), mesh.NumberOfTriangles() / 2000);
}

TEST(Terrain, IsJudgedByXAndYAlone)
{
  const OwnedMesh<double> flat = MakeRandomBadMeshDouble(2000, 11);
  std::mt19937 random(1);
  const OwnedMesh<double> mesh =
    Lift(flat, [&](double, double) { return DrawIndex(random, 1000); });
  const FlipResult result = FlipAndAudit(mesh.View(), InPlane());
  EXPECT_EQ(GeometryKind::PlanarXY, result.Report.GeometryUsed);
  EXPECT_TRUE(MakeCgalDelaunay(flat.View().Points) == ToTriangleSet(result.Triangles));
}

//------------------------------------------------------------------------------
// Against Lawson's algorithm, flip by flip in rational numbers.

/// Random distinct points of a small lattice, with many ties, and some triangulation of them.
OwnedMesh<double> DrawMesh(std::mt19937& random)
{
  const int size = 3 + DrawIndex(random, 6);
  const int count = 3 + DrawIndex(random, size * size);
  return MakeSweptMesh(DrawDistinct(random, count, size, size));
}

/// Canonical meshes are Lawson's, triangle for triangle. If ties are kept, the result depends on
/// the order of flips, but nothing is left to flip.
TEST(Lawson, FindsTheSameMesh)
{
  std::mt19937 random(91);
  for (int i = 0; i < 800 / Reduction && !testing::Test::HasFailure(); ++i)
  {
    SCOPED_TRACE(i);
    const TieRuleKind rule = TieRules[i % 2];
    OwnedMesh<double> mesh = DrawMesh(random);
    std::set<VertexPair> constraints;
    std::vector<std::int64_t> ids;
    for (const auto& [edge, opposite] : FindOpposites(mesh.View().Triangles))
    {
      if (i % 4 > 1 && DrawIndex(random, 8) == 0)
      {
        constraints.insert(std::minmax(edge.first, edge.second));
        ids.insert(ids.end(), { edge.first, edge.second });
      }
    }
    const FlipResult result =
      FlipAndAudit(WithConstraints(mesh.View(), ids), With(&FlipOptions::TieRule, rule));
    EXPECT_EQ(0, result.Report.NonDelaunayAfter);
    const std::int64_t flips = FlipByLawson(mesh, constraints, rule);
    EXPECT_EQ(flips > 0, result.Report.TotalFlips > 0);
    if (rule == TieRuleKind::Canonical)
    {
      EXPECT_EQ(ToTriangleSet(mesh.Triangles), ToTriangleSet(result.Triangles));
    }
    mesh.Triangles = result.Triangles;
    EXPECT_EQ(0, FlipByLawson(mesh, constraints, rule));
  }
}

//------------------------------------------------------------------------------
// The paper's worst case.

std::vector<std::int64_t> GetFlips(const FlipReport& report)
{
  std::vector<std::int64_t> flips;
  for (const IterationRecord& row : report.Iterations)
  {
    if (row.Flipped > 0)
    {
      flips.push_back(row.Flipped);
    }
  }
  return flips;
}

/// The paper's Fig. 6: 8 vertices, 13 edges, 6 triangles. The opposite-angle sum, its own
/// criterion, makes the same decisions.
TEST(WorstCase, OfThePaperTakesItsFlips)
{
  for (const CriterionKind criterion : { CriterionKind::InCircle, CriterionKind::OppositeAngles })
  {
    const FlipOptions options = With(&FlipOptions::Criterion, criterion);
    const FlipReport report = FlipAndAudit(MakeWorstCaseMesh(4).View(), options).Report;
    EXPECT_EQ(8, report.Points);
    EXPECT_EQ(13, report.Edges.Edges);
    EXPECT_EQ(6, report.Triangles);
    EXPECT_EQ((std::vector<std::int64_t>{ 1, 2, 3, 2, 1 }), GetFlips(report));
  }
}

/// m triangles take m - 1 iterations: with m = 2 k - 2 of them, (k - 1)^2 flips in 2 k - 3.
TEST(WorstCase, GrowsAsThePaperSays)
{
  for (std::int32_t k = 2; k <= 40; ++k)
  {
    const OwnedMesh<double> mesh = MakeWorstCaseMesh(k);
    const FlipResult result = FlipAndAudit(mesh.View());
    const std::vector<std::int64_t> flips = GetFlips(result.Report);
    ASSERT_EQ(2 * k - 3, static_cast<std::int64_t>(flips.size())) << "k = " << k;
    for (std::int32_t i = 0; i < 2 * k - 3; ++i)
    {
      EXPECT_EQ(std::min(i + 1, 2 * k - 3 - i), flips[i]) << "k = " << k << ", flip set " << i;
    }
    EXPECT_EQ((k - 1) * (k - 1), result.Report.TotalFlips);
    EXPECT_EQ(0, CountRationalViolations(WithTriangles(mesh.View(), result.Triangles)));
  }
}

//------------------------------------------------------------------------------
// Planes that are tilted in space.

constexpr AffineRow X = { 1, 0, 0, 0 };
constexpr AffineRow Y = { 0, 1, 0, 0 };
constexpr AffineRow Constant = { 0, 0, 0, 4 };

/// Whether all triangles face the same way as the first, in the projection along some axis.
bool FaceOneWay(const OwnedMesh<double>& mesh, const std::vector<std::int32_t>& triangles)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    AffineMap project = {};
    project[0] = axis == 0 ? Y : X;
    project[1] = axis == 2 ? Y : AffineRow{ 0, 0, 1, 0 };
    const OwnedMesh<double> flat = Transform(mesh, project);
    const TriangleTurns turns = CountTurns(WithTriangles(flat.View(), triangles));
    if (turns.Straight != mesh.NumberOfTriangles())
    {
      return turns.Left == mesh.NumberOfTriangles() || turns.Right == mesh.NumberOfTriangles();
    }
  }
  return false;
}

FlipResult FlipTilted(const OwnedMesh<double>& mesh, TieRuleKind rule = TieRuleKind::Keep)
{
  FlipResult result = FlipAndAudit(mesh.View(), With(&FlipOptions::TieRule, rule));
  EXPECT_EQ(GeometryKind::Planar, result.Report.GeometryUsed);
  EXPECT_TRUE(FaceOneWay(mesh, result.Triangles));
  return result;
}

/// Similarities that keep the lattice: it does not matter which coordinate is constant, which way
/// the plane faces, or how it is tilted. Sheared meshes become Delaunay in their own plane.
TEST(TiltedPlane, BecomesDelaunayInItself)
{
  const OwnedMesh<double> flat = MakeRandomBadMeshDouble(3000 / Reduction, 21);
  const TriangleSet expected = MakeCgalDelaunay(flat.View().Points);
  const AffineMap maps[] = { { { X, Y, Constant } }, { { Y, X, Constant } }, { { X, Constant, Y } },
    { { Y, Constant, X } }, { { Constant, X, Y } }, { { Constant, Y, X } },
    { { { 3, 0, 0, 0 }, { 0, 5, 0, 0 }, { 4, 0, 0, 0 } } },
    { { { 0, -5, 0, 7 }, { 4, 0, 0, 0 }, { 3, 0, 0, -9 } } },
    { { { 1, 2, 0, 0 }, { 2, -2, 0, 0 }, { 2, 1, 0, 0 } } },
    { { { 1, 2, 0, 1e6 }, { 2, -2, 0, -1e6 }, { 2, 1, 0, 1e6 } } },
    // From here on they are sheared.
    { { X, Y, { 1, 1, 0, 0 } } }, { { X, Y, { 2, -3, 0, 0 } } }, { { { 1, 1, 0, 0 }, X, Y } },
    { { X, { 100, 1, 0, 0 }, Y } }, { { { 1, 7, 0, 0 }, { -2, 3, 0, 0 }, { 5, 1, 0, 1e5 } } } };
  for (const AffineMap& map : maps)
  {
    SCOPED_TRACE(&map - maps);
    const OwnedMesh<double> mesh = Transform(flat, map);
    const FlipResult result = FlipTilted(mesh);
    EXPECT_EQ(0, result.Report.NonDelaunayAfter);
    EXPECT_EQ(0, CountRationalViolations(WithTriangles(mesh.View(), result.Triangles)));
    EXPECT_TRUE(&map - maps >= 10 || expected == ToTriangleSet(result.Triangles));
  }
}

/// A canonical result does not depend on the triangles of the input.
TEST(TiltedPlane, LatticePointsGiveTheSameCanonicalMeshWhateverTheStart)
{
  const OwnedMesh<double> grid = MakeGridMesh(12, 9);
  Places points;
  for (std::size_t i = 0; i < grid.Points.size(); i += 3)
  {
    points.push_back({ grid.Points[i], grid.Points[i + 1] });
  }
  for (const AffineMap& map :
    { AffineMap{ { X, Y, Constant } }, { { { 3, 0, 0, 0 }, { 0, 5, 0, 0 }, { 4, 0, 0, 0 } } } })
  {
    const OwnedMesh<double> tilted = Transform(grid, map);
    EXPECT_EQ(grid.Triangles, FlipTilted(tilted).Triangles);
    const FlipResult swept =
      FlipTilted(Transform(MakeSweptMesh(points), map), TieRuleKind::Canonical);
    EXPECT_EQ(ToTriangleSet(FlipTilted(tilted, TieRuleKind::Canonical).Triangles),
      ToTriangleSet(swept.Triangles));
  }
}

/// Rotations by any angle round coordinates, so points leave their plane by some units in the last
/// place. Flips must end, agree with the audit, and leave a valid mesh.
TEST(TiltedPlane, RoundedRotationsEnd)
{
  const OwnedMesh<double> flat = MakeRandomBadMeshDouble(2000 / Reduction, 23);
  for (int i = 1; i <= 8; ++i)
  {
    SCOPED_TRACE(i);
    const double a = 0.7 * i, b = 1.1 * i;
    FlipTilted(Transform(flat,
      { { { std::cos(a), -std::sin(a) * std::cos(b), 0, 0.1 },
        { std::sin(a), std::cos(a) * std::cos(b), 0, 100.3 }, { 0, std::sin(b), 0, 0 } } }));
  }
}

}
}
