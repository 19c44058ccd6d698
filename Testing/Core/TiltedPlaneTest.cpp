// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CgalReference.h"
#include "ExactReference.h"
#include "MeshAudit.h"

#include <gtest/gtest.h>

#include <cmath>

namespace delaunayflip
{
namespace
{

constexpr AffineRow X = { 1, 0, 0, 0 };
constexpr AffineRow Y = { 0, 1, 0, 0 };
constexpr AffineRow Constant = { 0, 0, 0, 4 };

FlipResult FlipPlanar(const OwnedMesh<double>& mesh, TieRuleKind rule = TieRuleKind::Keep)
{
  FlipOptions options;
  options.TieRule = rule;
  FlipResult result = Flip(mesh.View(), options);
  const TriangleMesh after = WithTriangles(mesh.View(), result.Triangles);
  EXPECT_EQ(GeometryKind::Planar, result.Report.GeometryUsed);
  EXPECT_TRUE(result.Report.Converged());
  EXPECT_EQ(0, result.Report.NonDelaunayAfter);
  EXPECT_EQ(0, CountNonDelaunayEdges(after, options));
  EXPECT_EQ(0, CountRationalViolations(after));
  ExpectSameTopology(mesh.View().Triangles, result.Triangles, result.Report);
  return result;
}

/// Whether all triangles face the same way as the first, in the projection along some axis.
bool FaceOneWay(const OwnedMesh<double>& mesh, const std::vector<std::int32_t>& triangles)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    AffineMap project = {};
    project[0] = axis == 0 ? AffineRow{ 0, 1, 0, 0 } : X;
    project[1] = axis == 2 ? AffineRow{ 0, 1, 0, 0 } : AffineRow{ 0, 0, 1, 0 };
    const OwnedMesh<double> flat = Transform(mesh, project);
    const TriangleTurns turns = CountTurns(WithTriangles(flat.View(), triangles));
    if (turns.Straight != mesh.NumberOfTriangles())
    {
      return turns.Left == mesh.NumberOfTriangles() || turns.Right == mesh.NumberOfTriangles();
    }
  }
  return false;
}

/// Similarities that keep the lattice: it does not matter which coordinate is constant, which way
/// the plane faces, or how it is tilted.
TEST(TiltedPlane, SimilarMeshesGiveTheSameTriangles)
{
  const OwnedMesh<double> flat = MakeRandomBadMeshDouble(3000 / Reduction, 21);
  const TriangleSet expected = MakeCgalDelaunay(flat.View().Points);
  const AffineMap maps[] = { { { X, Y, Constant } }, { { Y, X, Constant } }, { { X, Constant, Y } },
    { { Y, Constant, X } }, { { Constant, X, Y } }, { { Constant, Y, X } },
    { { { 3, 0, 0, 0 }, { 0, 5, 0, 0 }, { 4, 0, 0, 0 } } },
    { { { 0, -5, 0, 7 }, { 4, 0, 0, 0 }, { 3, 0, 0, -9 } } },
    { { { 1, 2, 0, 0 }, { 2, -2, 0, 0 }, { 2, 1, 0, 0 } } },
    { { { 1, 2, 0, 1e6 }, { 2, -2, 0, -1e6 }, { 2, 1, 0, 1e6 } } } };
  for (const AffineMap& map : maps)
  {
    const OwnedMesh<double> mesh = Transform(flat, map);
    const FlipResult result = FlipPlanar(mesh);
    EXPECT_TRUE(expected == ToTriangleSet(result.Triangles)) << &map - maps;
    EXPECT_TRUE(FaceOneWay(mesh, result.Triangles));
  }
}

TEST(TiltedPlane, ShearedMeshesBecomeDelaunayInTheirOwnPlane)
{
  const OwnedMesh<double> flat = MakeRandomBadMeshDouble(3000 / Reduction, 22);
  const AffineMap maps[] = { { { X, Y, { 1, 1, 0, 0 } } }, { { X, Y, { 2, -3, 0, 0 } } },
    { { { 1, 1, 0, 0 }, X, Y } }, { { X, { 100, 1, 0, 0 }, Y } },
    { { { 1, 7, 0, 0 }, { -2, 3, 0, 0 }, { 5, 1, 0, 1e5 } } } };
  for (const AffineMap& map : maps)
  {
    const OwnedMesh<double> mesh = Transform(flat, map);
    const FlipResult result = FlipPlanar(mesh);
    EXPECT_TRUE(FaceOneWay(mesh, result.Triangles)) << &map - maps;
  }
}

TEST(TiltedPlane, LatticePointsGiveTheSameCanonicalMeshWhateverTheStart)
{
  const OwnedMesh<double> grid = MakeGridMesh(12, 9);
  std::vector<std::array<double, 2>> points;
  for (std::size_t i = 0; i < grid.Points.size(); i += 3)
  {
    points.push_back({ grid.Points[i], grid.Points[i + 1] });
  }
  const AffineMap map = { { { 3, 0, 0, 0 }, { 0, 5, 0, 0 }, { 4, 0, 0, 0 } } };
  const OwnedMesh<double> tiltedGrid = Transform(grid, map);
  const FlipResult kept = FlipPlanar(tiltedGrid);
  EXPECT_EQ(grid.Triangles, kept.Triangles);
  const FlipResult canonical = FlipPlanar(tiltedGrid, TieRuleKind::Canonical);
  const FlipResult fromSwept =
    FlipPlanar(Transform(MakeSweptMesh(points), map), TieRuleKind::Canonical);
  EXPECT_EQ(ToTriangleSet(canonical.Triangles), ToTriangleSet(fromSwept.Triangles));
}

/// Rotations by any angle round coordinates, so points leave their plane by some units in the last
/// place. Flips must end, agree with the audit, and leave a valid mesh.
TEST(TiltedPlane, RoundedRotationsEnd)
{
  const OwnedMesh<double> flat = MakeRandomBadMeshDouble(2000 / Reduction, 23);
  for (int i = 1; i <= 8; ++i)
  {
    const double a = 0.7 * i;
    const double b = 1.1 * i;
    const AffineMap map = { { { std::cos(a), -std::sin(a) * std::cos(b), 0, 0.1 },
      { std::sin(a), std::cos(a) * std::cos(b), 0, 100.3 }, { 0, std::sin(b), 0, 0 } } };
    const OwnedMesh<double> mesh = Transform(flat, map);
    const FlipResult result = Flip(mesh.View());
    EXPECT_EQ(GeometryKind::Planar, result.Report.GeometryUsed);
    EXPECT_TRUE(result.Report.Converged());
    EXPECT_EQ(result.Report.NonDelaunayAfter,
      CountNonDelaunayEdges(WithTriangles(mesh.View(), result.Triangles), FlipOptions()));
    EXPECT_TRUE(FaceOneWay(mesh, result.Triangles)) << "rotation " << i;
    ExpectSameTopology(mesh.View().Triangles, result.Triangles, result.Report);
    ExpectConsistentStatistics(result.Report);
  }
}

}
}
