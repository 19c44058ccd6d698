// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "MeshAudit.h"
#include "Predicates.h"
#include "RandomInputs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

/// @file
/// Meshes with every kind of defect: nothing is lost, what cannot be judged stays, the statistics
/// agree with the audit, and the loop ends by itself.

namespace delaunayflip
{
namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();

constexpr GeometryKind Geometries[] = { GeometryKind::Auto, GeometryKind::Planar,
  GeometryKind::PlanarXY, GeometryKind::Surface };

FlipResult FlipDirty(const OwnedMesh<double>& mesh, GeometryKind geometry)
{
  return FlipAndAudit(mesh.View(), With(&FlipOptions::Geometry, geometry, OnSurface()));
}

TEST(DirtyInput, EmptyMeshesAreDone)
{
  const OwnedMesh<double> empty[] = { {}, { { 1, 2, 3, 4, 5, 6 }, {} } };
  for (const OwnedMesh<double>& mesh : empty)
  {
    for (GeometryKind geometry : Geometries)
    {
      const FlipResult result = FlipDirty(mesh, geometry);
      EXPECT_EQ(0, result.Report.TotalFlips);
      EXPECT_EQ(0, result.Report.Edges.Edges);
      EXPECT_TRUE(std::isnan(result.Report.MinimumAngleBefore));
      EXPECT_NE(GeometryKind::Auto, result.Report.GeometryUsed);
      EXPECT_TRUE(result.Report.Defects.empty());
    }
  }
}

/// Among them are one triangle, ties, and flat triangles with the apex on the line of the shared
/// edge outside of it: no flip can improve that.
TEST(DirtyInput, DelaunayMeshesComeBackBitForBit)
{
  OwnedMesh<double> notANumber = MakeGridMesh(4, 4);
  std::fill(notANumber.Points.begin(), notANumber.Points.end(), std::nan(""));
  const OwnedMesh<double> meshes[] = { { { 0, 0, 0, 1, 0, 0, 0, 1, 0 }, { 2, 0, 1 } },
    MakeGridMesh(40, 30), { { 0, 0, 0, 4, 0, 0, 2, 3, 0, 5, 0, 0 }, { 0, 1, 2, 1, 0, 3 } },
    notANumber };
  for (const OwnedMesh<double>& mesh : meshes)
  {
    for (GeometryKind geometry : Geometries)
    {
      const FlipResult result = FlipDirty(mesh, geometry);
      EXPECT_EQ(mesh.Triangles, result.Triangles);
      EXPECT_TRUE(result.Report.Iterations.empty() || result.Report.Iterations[0].Flipped == 0);
    }
  }
}

/// What a caller may think converged: nothing was flipped because nothing can be.
TEST(DirtyInput, TrianglesWithPointsOfTheirOwnAreReported)
{
  const std::vector<double> points = { 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0 };
  const auto describe = [&](const std::vector<std::int32_t>& triangles) {
    return DescribeDefects(FlipDirty({ points, triangles }, GeometryKind::Auto).Report.Defects);
  };
  EXPECT_EQ("2 triangles of which no two share an edge, so that none can flip: merge points that "
            "lie at the same place",
    describe({ 0, 1, 2, 3, 4, 5 }));
  EXPECT_EQ("", describe({ 0, 1, 2 }));
  EXPECT_EQ("", describe({ 0, 1, 2, 1, 4, 2 }));
}

/// Some points are NaN or infinite: no flip touches their triangles, and all others become
/// Delaunay.
TEST(DirtyInput, NonFinitePointsStayAndTheRestIsProcessed)
{
  for (double bad : { std::nan(""), Infinity, -Infinity })
  {
    OwnedMesh<double> mesh = MakeRandomBadMeshDouble(2000, 81);
    for (std::size_t point : { 100u, 500u, 501u, 1500u })
    {
      mesh.Points[3 * point + point % 2] = bad;
    }
    const std::vector<double> points = mesh.Points;
    for (GeometryKind geometry : { GeometryKind::Auto, GeometryKind::PlanarXY })
    {
      const FlipResult result = FlipDirty(mesh, geometry);
      EXPECT_EQ(0, result.Report.NonDelaunayAfter);
      EXPECT_LT(1000, result.Report.TotalFlips);
      EXPECT_EQ(4, CountDefect(result.Report, "NaN"));
      EXPECT_EQ(1u, result.Report.Defects.size()) << DescribeDefects(result.Report.Defects);
      for (std::size_t corner = 0; corner < mesh.Triangles.size(); ++corner)
      {
        const std::int32_t id = mesh.Triangles[corner];
        const bool isBad = !std::isfinite(mesh.Points[3 * id] + mesh.Points[3 * id + 1]);
        EXPECT_TRUE(!isBad || result.FlipCounts[corner / 3] == 0);
      }
      EXPECT_EQ(0, std::memcmp(points.data(), mesh.Points.data(), points.size() * sizeof(double)));
    }
  }
}

/// A cap with its apex exactly on the shared edge: its angle is pi, so the edge is bad.
TEST(DirtyInput, FlatCapsFlip)
{
  OwnedMesh<double> mesh = { { 0, 0, 0, 4, 0, 0, 2, 3, 0, 1, 0, 0 }, { 0, 1, 2, 1, 0, 3 } };
  for (int direction = 0; direction < 2; ++direction)
  {
    for (GeometryKind geometry : Geometries)
    {
      const FlipResult result = FlipDirty(mesh, geometry);
      EXPECT_EQ(1, result.Report.TotalFlips) << ToString(geometry);
      EXPECT_TRUE(HasEdge(result.Triangles, 2, 3));
      EXPECT_EQ(1, CountDefect(result.Report, "area"));
      EXPECT_EQ(0.0, result.Report.MinimumAngleBefore);
      EXPECT_LT(1.0, result.Report.MinimumAngleAfter);
    }
    ReverseTriangles(mesh.Triangles);
  }
}

TEST(DirtyInput, AllCollinearOrCoincidentPointsEnd)
{
  const OwnedMesh<double> line = Transform(
    MakeRandomBadMeshDouble(300, 83), { { { 1, 0, 0, 0 }, { 1, 0, 0, 0 }, { 0, 0, 1, 0 } } });
  OwnedMesh<double> spot = line;
  std::fill(spot.Points.begin(), spot.Points.end(), 7.0);
  for (GeometryKind geometry : Geometries)
  {
    EXPECT_EQ(line.NumberOfTriangles(), CountDefect(FlipDirty(line, geometry).Report, "area"));
    const FlipResult result = FlipDirty(spot, geometry);
    EXPECT_EQ(spot.Triangles, result.Triangles);
  }
}

TEST(DirtyInput, TrianglesWithRepeatedIdsStay)
{
  OwnedMesh<double> mesh = MakeRandomBadMeshDouble(1000, 85);
  for (std::size_t t = 0; t < 30; t += 3)
  {
    mesh.Triangles[30 * t + 1] = mesh.Triangles[30 * t];
  }
  for (GeometryKind geometry : Geometries)
  {
    const FlipResult result = FlipDirty(mesh, geometry);
    EXPECT_EQ(10, CountDefect(result.Report, "repeated"));
    for (std::size_t t = 0; t < 30; t += 3)
    {
      EXPECT_TRUE(std::equal(
        &mesh.Triangles[30 * t], &mesh.Triangles[30 * t] + 3, &result.Triangles[30 * t]));
    }
    EXPECT_LT(1000, result.Report.TotalFlips);
  }
}

/// The edges between their points do not have them: these are paired as without them, and may be
/// inserted and made. A constraint between such points is not an edge because of them.
TEST(DirtyInput, TrianglesWithRepeatedIdsHaveNoEdges)
{
  const OwnedMesh<double> clean = MakeRandomBadMeshDouble(1000, 88);
  OwnedMesh<double> mesh = clean;
  for (std::size_t i = 0; i < clean.Triangles.size(); i += 3)
  {
    const std::int32_t a = clean.Triangles[i], b = clean.Triangles[i + 1];
    const std::int32_t collapsed[3][3] = { { a, a, b }, { a, b, a }, { b, a, a } };
    mesh.Triangles.insert(mesh.Triangles.end(), collapsed[i % 9 / 3], collapsed[i % 9 / 3] + 3);
  }
  const std::vector<std::int64_t> ends = { 17, 18 };
  const unsigned char inserts = 1;
  ASSERT_FALSE(HasEdge(clean.Triangles, 17, 18));
  mesh.Triangles.insert(mesh.Triangles.end(), { 17, 17, 18 });
  for (GeometryKind geometry : Geometries)
  {
    const FlipResult expected = FlipDirty(clean, geometry);
    const FlipResult result = FlipDirty(mesh, geometry);
    EXPECT_EQ(clean.NumberOfTriangles() + 1, CountDefect(result.Report, "repeated"));
    EXPECT_EQ(0, result.Report.Edges.NonManifold);
    EXPECT_EQ(expected.Report.Edges.Edges, result.Report.Edges.Edges);
    EXPECT_EQ(expected.Report.Edges.Boundary, result.Report.Edges.Boundary);
    EXPECT_EQ(0, result.Report.NonDelaunayAfter);
    EXPECT_EQ(0, result.Report.BlockedByEdge);
    if (geometry != GeometryKind::Surface) // There the result depends on the order of flips.
    {
      EXPECT_TRUE(
        std::equal(expected.Triangles.begin(), expected.Triangles.end(), result.Triangles.begin()));
      const FlipOptions options = With(&FlipOptions::Geometry, geometry, OnSurface());
      const FlipResult inserted = Flip(WithConstraints(mesh.View(), ends, &inserts), options);
      EXPECT_EQ(1, inserted.Report.InsertedConstraints);
      EXPECT_EQ(1, Flip(WithConstraints(mesh.View(), ends), options).Report.UnmatchedConstraints);
    }
  }
}

/// Unused points, even NaN, change nothing.
TEST(DirtyInput, IsolatedPointsDoNotMatter)
{
  const OwnedMesh<double> clean = MakeRandomBadMeshDouble(500, 86);
  OwnedMesh<double> mesh = clean;
  mesh.Points.insert(mesh.Points.end(), { 5, 5, 5, std::nan(""), 0, 1e300, -7, 0, -1e9 });
  const FlipResult result = FlipDirty(mesh, GeometryKind::Auto);
  EXPECT_EQ(GeometryKind::Planar, result.Report.GeometryUsed);
  EXPECT_EQ(Flip(clean.View()).Triangles, result.Triangles);
  EXPECT_EQ(503, result.Report.Points);
  EXPECT_TRUE(result.Report.Defects.empty());
}

/// A hub of very many triangles, placed so that nearly all of its edges are bad.
TEST(DirtyInput, HugeFansAreProcessed)
{
  const int count = 20000 / static_cast<int>(Reduction);
  OwnedMesh<double> mesh;
  mesh.Points = { 0, 0, 0 };
  for (std::int32_t i = 0; i < count; ++i)
  {
    const double x = 1.8 * i / (count - 1) - 0.9;
    mesh.Points.insert(mesh.Points.end(), { x, 3.0 + std::sqrt(1.0 - x * x), 0.0 });
    if (i > 0)
    {
      mesh.Triangles.insert(mesh.Triangles.end(), { 0, i + 1, i });
    }
  }
  for (GeometryKind geometry : { GeometryKind::Auto, GeometryKind::Surface })
  {
    EXPECT_LT(count / 2, FlipDirty(mesh, geometry).Report.TotalFlips);
  }
}

//------------------------------------------------------------------------------
/// Planar meshes that overlap themselves: with either tie rule, flips must end and create no edge
/// twice.
std::int64_t FlipOverlapping(const OwnedMesh<double>& mesh)
{
  std::int64_t left = 0;
  for (TieRuleKind rule : { TieRuleKind::Keep, TieRuleKind::Canonical })
  {
    const FlipReport report = FlipAndAudit(mesh.View(), With(&FlipOptions::TieRule, rule)).Report;
    EXPECT_EQ(GeometryKind::Planar, report.GeometryUsed);
    left += report.NonDelaunayAfter;
  }
  return left;
}

TEST(Overlap, FansThatWindTwiceGainNoEdgeTwice)
{
  for (std::uint32_t seed = 0; seed < 200 / Reduction; ++seed)
  {
    const int turns = 2 + static_cast<int>(seed % 2);
    const int count = 3 * turns + static_cast<int>(seed % 11);
    for (const bool closed : { true, false })
    {
      std::mt19937 random(seed);
      OwnedMesh<double> fan = MakeWindingFan(count, turns, closed);
      for (std::size_t i = 3; i < fan.Points.size(); i += 3)
      {
        const double radius = 1.0 + DrawIndex(random, 1000) / 100.0;
        fan.Points[i] *= radius;
        fan.Points[i + 1] *= radius;
      }
      FlipOverlapping(fan);
    }
    ASSERT_FALSE(HasFailure()) << "seed " << seed;
  }
}

/// Diamonds on top of each other that share only their lower and upper ends p and q: the bad edge
/// of each would become p-q.
TEST(Overlap, DiamondsThatShareTheirEndsGainNoEdgeTwice)
{
  for (std::int32_t layers = 2; layers < 6; ++layers)
  {
    OwnedMesh<double> mesh = { { 0, -1, 0, 0, 1, 0 }, {} };
    for (std::int32_t layer = 0; layer < layers; ++layer)
    {
      const double shift = 0.01 * layer;
      const std::int32_t left = 2 + 3 * layer;
      mesh.Points.insert(
        mesh.Points.end(), { -3 + shift, 0, 0, 0.5 + shift, 0, 0, 3 + shift, 0, 0 });
      mesh.Triangles.insert(mesh.Triangles.end(),
        { left, 0, left + 1, left, left + 1, 1, left + 2, left + 1, 0, left + 2, 1, left + 1 });
    }
    EXPECT_EQ(2 * (layers - 1), FlipOverlapping(mesh)) << layers;
  }
}

/// Two fans over the same polygon, back to back and joined along the border: flips on both sides
/// would make the same edges, and only one side may get each.
TEST(Overlap, FlatPillowsGainNoEdgeTwice)
{
  std::int64_t blocked = 0;
  for (std::int32_t count = 5; count < 60; ++count)
  {
    std::mt19937 random(static_cast<std::uint32_t>(count));
    OwnedMesh<double> mesh;
    for (std::int32_t i = 0; i < count; ++i)
    {
      const double angle = 6.283185307179586 * (i + DrawIndex(random, 80) / 100.0) / count;
      mesh.Points.insert(mesh.Points.end(), { 3.0 * std::cos(angle), std::sin(angle), 0.0 });
    }
    const std::int32_t other = count / 2;
    for (std::int32_t i = 1; i + 1 < count; ++i)
    {
      const std::int32_t far = (other + i) % count;
      mesh.Triangles.insert(mesh.Triangles.end(), { 0, i, i + 1, other, (far + 1) % count, far });
    }
    blocked += FlipOverlapping(mesh);
    ASSERT_FALSE(HasFailure()) << count << " points";
  }
  EXPECT_LT(0, blocked);
}

/// The slots of the triangles with this exact orientation: 1, -1, or 0 without area.
std::vector<std::int64_t> FindTurns(const OwnedMesh<double>& mesh, int side)
{
  std::vector<std::int64_t> slots;
  for (std::int64_t t = 0; t < mesh.NumberOfTriangles(); ++t)
  {
    const auto get = [&](int i) { return &mesh.Points[3 * mesh.Triangles[3 * t + i]]; };
    if (Orientation(get(0), get(1), get(2)) == side)
    {
      slots.push_back(t);
    }
  }
  return slots;
}

/// A vertex that is moved out of its star inverts triangles. Triangles of opposite orientation
/// never flip with each other.
TEST(Overlap, InvertedTrianglesAreReportedAndSurvived)
{
  std::mt19937 random(7);
  OwnedMesh<double> mesh = MakeRandomBadMeshDouble(2000, 71);
  for (int i = 0; i < 20; ++i)
  {
    const std::int32_t point = 4 + DrawIndex(random, 1996);
    mesh.Points[3 * point] = DrawIndex(random, 1000) / 1000.0;
  }
  FlipOverlapping(mesh);
  std::vector<std::int64_t> inverted = FindTurns(mesh, -1);
  ASSERT_LT(20u, inverted.size());
  ASSERT_LT(inverted.size(), FindTurns(mesh, 1).size());
  ASSERT_TRUE(FindTurns(mesh, 0).empty());
  const std::vector<Defect> defects = MakeSession(mesh.View()).GetReport().Defects;
  ASSERT_EQ(1u, defects.size()) << DescribeDefects(defects);
  EXPECT_EQ(DefectKind::TurnedFromMost, defects[0].Kind);
  EXPECT_EQ(static_cast<std::int64_t>(inverted.size()), defects[0].Count);
  EXPECT_EQ(DefectIds::Triangles, defects[0].Ids);
  inverted.resize(3);
  EXPECT_EQ(inverted, defects[0].FirstIds);
}

}
}
