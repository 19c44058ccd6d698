// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "MeshAudit.h"
#include "References.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace delaunayflip
{
namespace
{

/// Every `step`-th interior edge, some of them reversed.
std::vector<std::int64_t> PickConstraints(const TriangleArray& triangles, int step)
{
  std::vector<std::int64_t> constraints;
  int i = 0;
  for (const auto& [edge, incident] : CollectEdges(triangles))
  {
    if (incident.size() == 2 && ++i % step == 0)
    {
      const bool turn = i % (2 * step) == 0;
      constraints.push_back(turn ? edge.second : edge.first);
      constraints.push_back(turn ? edge.first : edge.second);
    }
  }
  return constraints;
}

/// Bad edges are left, but none that may flip.
void ExpectNoneLeft(const TriangleMesh& mesh, const FlipResult& result)
{
  EXPECT_LT(0, result.Report.TotalFlips);
  EXPECT_EQ(0, CountNonDelaunayEdges(WithTriangles(mesh, result.Triangles), FlipOptions()));
  TriangleMesh free = mesh;
  static_cast<FixedEdges&>(free) = FixedEdges();
  EXPECT_LT(0, CountNonDelaunayEdges(WithTriangles(free, result.Triangles), FlipOptions()));
}

TEST(ConstraintEdges, GiveCgalsConstrainedDelaunayMesh)
{
  for (std::uint32_t seed = 31; seed < 34; ++seed)
  {
    const OwnedMesh<double> bad = MakeRandomBadMeshDouble(3000 / Reduction, seed);
    const std::vector<std::int64_t> constraints = PickConstraints(bad.View().Triangles, 10);
    const TriangleMesh mesh = WithConstraints(bad.View(), constraints);
    const FlipResult result = Flip(mesh);
    EXPECT_TRUE(MakeCgalConstrainedDelaunay(mesh) == ToTriangleSet(result.Triangles));
    ExpectNoneLeft(mesh, result);
    EXPECT_EQ(mesh.NumberOfConstraintEdges, result.Report.Edges.Constraint);
    EXPECT_EQ(mesh.NumberOfConstraintEdges + 4, result.Report.Edges.Fixed);
  }
}

TEST(ConstraintEdges, CountOnceAndAreReportedWhenMissing)
{
  const OwnedMesh<double> grid = MakeGridMesh(2, 1);
  // 0-4 is a diagonal, given three times; 1-3 the other diagonal; 0-1 a boundary edge; 5-5 no edge.
  const std::vector<std::int64_t> constraints = { 0, 4, 4, 0, 0, 4, 1, 3, 0, 1, 5, 5 };
  const FlipReport report = MakeSession(WithConstraints(grid.View(), constraints)).GetReport();
  EXPECT_EQ(2, report.Edges.Constraint);
  EXPECT_EQ(1 + report.Edges.Boundary, report.Edges.Fixed);
  ASSERT_EQ(1u, report.Defects.size());
  EXPECT_EQ(1, report.Defects[0].Count);
  EXPECT_NE(std::string::npos, DescribeDefects(report.Defects).find("constraint"));
}

TEST(Regions, KeepTheirBorders)
{
  const OwnedMesh<double> bad = MakeRandomBadMeshDouble(3000, 35);
  std::vector<std::int32_t> regions;
  for (std::int64_t t = 0; t < bad.NumberOfTriangles(); ++t)
  {
    regions.push_back(static_cast<std::int32_t>(3.0 * bad.Points[3 * bad.Triangles[3 * t]]) - 1);
  }
  TriangleMesh mesh = bad.View();
  mesh.Regions = regions.data();
  const FlipResult result = Flip(mesh);

  const auto edges = CollectEdges(mesh.Triangles);
  const auto edgesAfter = CollectEdges(ViewTriangles(result.Triangles));
  std::int64_t borders = 0;
  for (const auto& [edge, incident] : edges)
  {
    if (incident.size() == 2 && regions[incident[0]] != regions[incident[1]])
    {
      ++borders;
      ASSERT_EQ(1u, edgesAfter.count(edge));
      // Slots keep their labels, so the labels on either side of the border are the same as before.
      const std::vector<std::int64_t>& after = edgesAfter.at(edge);
      EXPECT_EQ(std::minmax({ regions[incident[0]], regions[incident[1]] }),
        std::minmax({ regions[after[0]], regions[after[1]] }));
    }
  }
  EXPECT_LT(0, borders);
  EXPECT_EQ(borders, result.Report.Edges.Region);
  EXPECT_EQ(borders + 4, result.Report.Edges.Fixed);
  ExpectNoneLeft(mesh, result);
}

TEST(FrozenTriangles, StayBitForBit)
{
  const OwnedMesh<double> bad = MakeRandomBadMeshDouble(3000, 36);
  std::vector<unsigned char> frozen;
  for (std::int64_t t = 0; t < bad.NumberOfTriangles(); ++t)
  {
    frozen.push_back(t % 9 == 0 ? 255 : 0);
  }
  TriangleMesh mesh = bad.View();
  mesh.FrozenTriangles = frozen.data();
  const FlipResult result = Flip(mesh);
  for (std::int64_t t = 0; t < bad.NumberOfTriangles(); t += 9)
  {
    EXPECT_TRUE(
      std::equal(&bad.Triangles[3 * t], &bad.Triangles[3 * t] + 3, &result.Triangles[3 * t]));
    EXPECT_EQ(0, result.FlipCounts[t]);
  }
  ExpectNoneLeft(mesh, result);
}

TEST(FixedEdges, AreListed)
{
  // Those of the rim are not.
  EXPECT_TRUE(FindFixedEdges(MakeRandomBadMeshDouble(200, 37).View(), FlipOptions()).empty());
  const OwnedMesh<double> bad = MakeBadSphere(40, 20, 36);
  const std::vector<std::int64_t> constraints = PickConstraints(bad.View().Triangles, 9);
  const TriangleMesh mesh = WithConstraints(bad.View(), constraints);
  const FlipOptions options = With(&FlipOptions::FeatureAngle, 12.0);
  const std::set<VertexPair> fixed = ToEdges(FindFixedEdges(mesh, options));
  const EdgeCounts counts = MakeSession(mesh, options).GetReport().Edges;
  EXPECT_LT(0, counts.Feature);
  EXPECT_EQ(counts.Fixed, static_cast<std::int64_t>(fixed.size()));
  for (const VertexPair& edge : ToEdges(constraints))
  {
    EXPECT_EQ(1u, fixed.count(edge));
  }
  const FlipResult result = Flip(mesh, options);
  EXPECT_LT(0, result.Report.TotalFlips);
  const auto edgesAfter = CollectEdges(ViewTriangles(result.Triangles));
  for (const VertexPair& edge : fixed)
  {
    EXPECT_EQ(1u, edgesAfter.count(edge));
  }
}

TEST(FeatureEdges, AreDecidedByTheFeatureAngle)
{
  // Two long bad pairs that meet at a right angle along edge 0-1.
  OwnedMesh<double> roof;
  roof.Points = { 0, 0, 0, 9, 0, 0, 9, 1, 0, 0, 1, 0, 4, 0, 1 };
  roof.Triangles = { 0, 1, 2, 0, 2, 3, 1, 0, 4 };
  const auto count = [&](double angle)
  {
    const FlipOptions options = With(&FlipOptions::FeatureAngle, angle);
    return MakeSession(roof.View(), options).GetReport().Edges.Feature;
  };
  for (double angle : { 0.0, 30.0, 89.9 })
  {
    EXPECT_EQ(1, count(angle)) << angle;
  }
  for (double angle : { 90.1, 180.0 })
  {
    EXPECT_EQ(0, count(angle)) << angle;
  }
  EXPECT_TRUE(HasEdge(Flip(roof.View()).Triangles, 0, 1));
}

}
}
