// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CgalReference.h"
#include "ExactReference.h"
#include "MeshAudit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

namespace delaunayflip
{
namespace
{

constexpr TieRuleKind TieRules[] = { TieRuleKind::Keep, TieRuleKind::Canonical };

FlipOptions WithTieRule(TieRuleKind rule)
{
  FlipOptions options;
  options.TieRule = rule;
  return options;
}

/// All that must hold for a planar, counter-clockwise result.
void ExpectDelaunay(const TriangleMesh& mesh, const FlipResult& result)
{
  const TriangleMesh after = WithTriangles(mesh, result.Triangles);
  EXPECT_TRUE(result.Report.Converged());
  EXPECT_EQ(0, result.Report.NonDelaunayAfter);
  EXPECT_EQ(0, CountNonDelaunayEdges(after, FlipOptions()));
  EXPECT_EQ(0, CountCgalViolations(after));
  EXPECT_EQ(mesh.Triangles.Count, CountTurns(after).Left);
  ExpectSameTopology(mesh.Triangles, result.Triangles, result.Report);
  ExpectConsistentStatistics(result.Report);
}

struct RandomMesh
{
  std::int64_t Points;
  std::uint32_t Seed;
};

void PrintTo(const RandomMesh& mesh, std::ostream* stream)
{
  *stream << mesh.Points << " points, seed " << mesh.Seed;
}

class RandomMeshTest : public testing::TestWithParam<RandomMesh>
{
protected:
  std::int64_t GetSize() const { return std::max<std::int64_t>(4, GetParam().Points / Reduction); }
};

TEST_P(RandomMeshTest, FloatsBecomeDelaunay)
{
  const OwnedMesh<float> mesh = MakeRandomBadMesh(this->GetSize(), GetParam().Seed);
  const TriangleSet expected = MakeCgalDelaunay(mesh.View().Points);
  for (TieRuleKind rule : TieRules)
  {
    const FlipResult result = Flip(mesh.View(), WithTieRule(rule));
    ExpectDelaunay(mesh.View(), result);
    EXPECT_TRUE(rule == TieRuleKind::Keep || expected == ToTriangleSet(result.Triangles));
  }
}

TEST_P(RandomMeshTest, DoublesAnd64BitIdsGiveTheSame)
{
  const std::int64_t size = this->GetSize();
  const OwnedMesh<float> floats = MakeRandomBadMesh(size, GetParam().Seed);
  const OwnedMesh<double> doubles = MakeRandomBadMeshDouble(size, GetParam().Seed);
  const FlipResult expected = Flip(floats.View());
  EXPECT_TRUE(expected.Triangles == Flip(doubles.View()).Triangles);

  std::vector<std::int64_t> ids(doubles.Triangles.begin(), doubles.Triangles.end());
  TriangleMesh mesh = doubles.View();
  mesh.Triangles = TriangleArray(ids.data(), doubles.NumberOfTriangles());
  // The output may be the input's own array.
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
std::vector<std::array<double, 2>> DrawLatticePoints(int size, int share, std::uint32_t seed)
{
  std::mt19937 random(seed);
  std::vector<std::array<double, 2>> points;
  for (int i = 0; i < size * size; ++i)
  {
    if (DrawIndex(random, 100) < share)
    {
      points.push_back({ double(i % size), double(i / size) });
    }
  }
  return points;
}

TEST(LatticePoints, BecomeCgalsTrianglesCanonically)
{
  for (std::uint32_t seed = 1; seed <= 40 / Reduction; ++seed)
  {
    const int share = 25 * (1 + seed % 4);
    const OwnedMesh<double> mesh =
      MakeSweptMesh(DrawLatticePoints(4 + static_cast<int>(seed), share, seed));
    const FlipResult canonical = Flip(mesh.View(), WithTieRule(TieRuleKind::Canonical));
    ExpectDelaunay(mesh.View(), canonical);
    EXPECT_TRUE(MakeCgalDelaunay(mesh.View().Points) == ToTriangleSet(canonical.Triangles))
      << "seed " << seed;
    ExpectDelaunay(mesh.View(), Flip(mesh.View()));
  }
}

/// Integer points on a circle about the origin: every edge is a tie.
TEST(CirclePoints, BecomeCgalsTrianglesCanonically)
{
  std::vector<std::array<double, 2>> points;
  for (int x = -65; x <= 65; ++x)
  {
    for (int y = -65; y <= 65; ++y)
    {
      const int square = x * x + y * y;
      if (square == 65 * 65 || square == 25 * 25 || square == 0)
      {
        points.push_back({ double(x), double(y) });
      }
    }
  }
  const OwnedMesh<double> mesh = MakeSweptMesh(points);
  const FlipResult canonical = Flip(mesh.View(), WithTieRule(TieRuleKind::Canonical));
  ExpectDelaunay(mesh.View(), canonical);
  EXPECT_EQ(MakeCgalDelaunay(mesh.View().Points), ToTriangleSet(canonical.Triangles));
  ExpectDelaunay(mesh.View(), Flip(mesh.View()));
}

TEST(CanonicalResult, DoesNotDependOnTheInputsTriangles)
{
  const OwnedMesh<double> grid = MakeGridMesh(30, 20);
  std::vector<std::array<double, 2>> points;
  for (std::size_t i = 0; i < grid.Points.size(); i += 3)
  {
    points.push_back({ grid.Points[i], grid.Points[i + 1] });
  }
  const OwnedMesh<double> swept = MakeSweptMesh(points);
  const FlipOptions options = WithTieRule(TieRuleKind::Canonical);
  const TriangleSet expected = ToTriangleSet(Flip(grid.View(), options).Triangles);
  EXPECT_EQ(expected, ToTriangleSet(Flip(swept.View(), options).Triangles));
  // It does not depend on their winding either.
  OwnedMesh<double> reversed = swept;
  ReverseTriangles(reversed.Triangles);
  FlipResult result = Flip(reversed.View(), options);
  ReverseTriangles(result.Triangles);
  EXPECT_EQ(expected, ToTriangleSet(result.Triangles));
}

TEST(ClockwiseMeshes, KeepTheirWinding)
{
  OwnedMesh<double> mesh = MakeRandomBadMeshDouble(3000, 6);
  const TriangleSet expected = MakeCgalDelaunay(mesh.View().Points);
  ReverseTriangles(mesh.Triangles);
  FlipResult result = Flip(mesh.View());
  EXPECT_EQ(
    mesh.NumberOfTriangles(), CountTurns(WithTriangles(mesh.View(), result.Triangles)).Right);
  ReverseTriangles(result.Triangles);
  EXPECT_TRUE(expected == ToTriangleSet(result.Triangles));
}

TEST(MirroredMeshes, GiveTheMirroredResult)
{
  const OwnedMesh<double> mesh = MakeRandomBadMeshDouble(3000, 7);
  const OwnedMesh<double> mirrored =
    Transform(mesh, { { { -1, 0, 0, 0 }, { 0, 1, 0, 0 }, { 0, 0, 1, 0 } } });
  EXPECT_TRUE(
    ToTriangleSet(Flip(mesh.View()).Triangles) == ToTriangleSet(Flip(mirrored.View()).Triangles));
}

/// Maps that keep the lattice of the random meshes exact, scaling by powers of two and translation
/// by integers below 2^28, must not change the triangles of the result.
TEST(ExactMaps, ChangeNothing)
{
  const OwnedMesh<double> mesh = MakeRandomBadMeshDouble(3000, 8);
  const TriangleSet expected = MakeCgalDelaunay(mesh.View().Points);
  const AffineMap maps[] = { ScaleAndMove(1.0, 1e7), ScaleAndMove(1.0, -1e8),
    ScaleAndMove(0x1p500, 0.0), ScaleAndMove(0x1p-500, 0.0), ScaleAndMove(0x1p-997, 0.0),
    ScaleAndMove(0x1p1023, 0.0), ScaleAndMove(0x1p-1050, 0.0) };
  for (const AffineMap& map : maps)
  {
    const OwnedMesh<double> moved = Transform(mesh, map);
    const bool isRounded = map[0].X == 0x1p-1050; // to subnormal numbers, so only it still ends
    for (TieRuleKind rule : TieRules)
    {
      const FlipResult result = Flip(moved.View(), WithTieRule(rule));
      EXPECT_TRUE(result.Report.Converged());
      EXPECT_EQ(
        0, CountNonDelaunayEdges(WithTriangles(moved.View(), result.Triangles), FlipOptions()));
      EXPECT_TRUE(isRounded || expected == ToTriangleSet(result.Triangles))
        << map[0].X << " " << map[0].Offset;
    }
  }
}

TEST(RoundedScales, StillEndInDelaunay)
{
  const OwnedMesh<double> mesh = MakeRandomBadMeshDouble(1000, 9);
  for (double scale : { 1e-300, 1e-100, 3e-8, 1e100, 1e300 })
  {
    const OwnedMesh<double> scaled = Transform(mesh, ScaleAndMove(scale, 0.0));
    ExpectDelaunay(scaled.View(), Flip(scaled.View()));
    ASSERT_FALSE(HasFailure()) << scale;
  }
}

/// One mesh whose quads hold coordinates near 1, 1e-300 and 1e300 at once.
TEST(MixedMagnitudes, EndInDelaunay)
{
  std::set<std::array<double, 2>> points = { { 0.0, 0.0 } };
  for (double r : { 1e-300, 1e-160, 1e-20, 1.0, 1e20, 1e160, 1e300 })
  {
    points.insert({ { r, r / 3 }, { -r, r / 7 }, { r / 9, -r }, { -r / 5, -r / 11 } });
  }
  const OwnedMesh<double> mesh = MakeSweptMesh({ points.begin(), points.end() });
  ExpectDelaunay(mesh.View(), Flip(mesh.View()));
  EXPECT_EQ(MakeCgalDelaunay(mesh.View().Points),
    ToTriangleSet(Flip(mesh.View(), WithTieRule(TieRuleKind::Canonical)).Triangles));
}

TEST(OppositeAngles, ReachNearlyTheSameMesh)
{
  FlipOptions options;
  options.Criterion = CriterionKind::OppositeAngles;
  const OwnedMesh<double> mesh = MakeRandomBadMeshDouble(3000, 10);
  const FlipResult result = Flip(mesh.View(), options);
  const TriangleMesh after = WithTriangles(mesh.View(), result.Triangles);
  EXPECT_TRUE(result.Report.Converged());
  EXPECT_EQ(0, CountNonDelaunayEdges(after, options));
  EXPECT_EQ(mesh.NumberOfTriangles(), CountTurns(after).Left);
  // In-circle may find edges within the tolerance; the paper reports 0.05 % of edges.
  EXPECT_LE(CountNonDelaunayEdges(after, FlipOptions()), mesh.NumberOfTriangles() / 2000);
}

TEST(Terrain, IsJudgedByXAndYAlone)
{
  OwnedMesh<double> mesh = MakeRandomBadMeshDouble(2000, 11);
  const TriangleSet expected = MakeCgalDelaunay(mesh.View().Points);
  std::mt19937 random(1);
  for (std::size_t i = 2; i < mesh.Points.size(); i += 3)
  {
    mesh.Points[i] = DrawIndex(random, 1000);
  }
  FlipOptions options;
  options.Geometry = GeometryKind::PlanarXY;
  const FlipResult result = Flip(mesh.View(), options);
  EXPECT_EQ(GeometryKind::PlanarXY, result.Report.GeometryUsed);
  EXPECT_TRUE(expected == ToTriangleSet(result.Triangles));
}

TEST(FlipCounts, SumToTwiceTheFlips)
{
  const OwnedMesh<double> mesh = MakeRandomBadMeshDouble(2000, 12);
  const FlipResult result = Flip(mesh.View());
  const std::int64_t sum =
    std::accumulate(result.FlipCounts.begin(), result.FlipCounts.end(), std::int64_t(0));
  EXPECT_EQ(2 * result.Report.TotalFlips, sum);
  for (std::int64_t t = 0; t < mesh.NumberOfTriangles(); ++t)
  {
    const bool isSame =
      std::equal(&mesh.Triangles[3 * t], &mesh.Triangles[3 * t] + 3, &result.Triangles[3 * t]);
    EXPECT_TRUE(isSame || result.FlipCounts[t] > 0) << t;
  }
}

}
}
