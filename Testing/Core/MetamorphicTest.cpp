// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FlipTestSupport.h"
#include "MeshAudit.h"
#include "References.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

/// @file
/// What changes of the input must do to the result: nothing, or the same change.

namespace delaunayflip
{
namespace
{

using Mesh = OwnedMesh<double>;

/// A mesh by how its edges are judged. Coordinates are whole numbers, so that scales and shifts are
/// exact.
struct Case
{
  const char* Name;
  Mesh (*Make)();
  GeometryKind Geometry;
};

/// Coordinates times a power of two, rounded.
Mesh Round(Mesh mesh, double factor)
{
  for (double& x : mesh.Points)
  {
    x = std::nearbyint(factor * x);
  }
  return mesh;
}

/// Points without order and with few ties.
Mesh MakePlane() { return Round(MakeRandomBadMeshDouble(600, 3), 0x1p20); }

/// Points of a lattice, with so many ties that the order of flips decides which triangles come out
/// unless the rule does.
Mesh MakeLattice()
{
  std::mt19937 random(1);
  return MakeSweptMesh(DrawDistinct(random, 400, 24, 24));
}

/// A plane askew in space, exactly.
Mesh MakeTiltedPlane()
{
  return Transform(MakePlane(), { { { 3, 0, 0, 0 }, { 0, 5, 0, 0 }, { 4, 0, 0, 0 } } });
}

Mesh MakeTerrain()
{
  return Lift(MakePlane(),
    [](double x, double y)
    { return std::nearbyint(0x1p16 * std::sin(0x1p-17 * x) * std::cos(0x1p-17 * y)); });
}

Mesh MakeSurface() { return Round(MakeBadSphere(40, 20, 4), 0x1p20); }

const Case Cases[] = {
  { "Plane", MakePlane, GeometryKind::Planar },
  { "Lattice", MakeLattice, GeometryKind::Planar },
  { "TiltedPlane", MakeTiltedPlane, GeometryKind::Planar },
  { "Terrain", MakeTerrain, GeometryKind::PlanarXY },
  { "TerrainInSpace", MakeTerrain, GeometryKind::Surface },
  { "Sphere", MakeSurface, GeometryKind::Surface },
};

class Metamorphic : public testing::TestWithParam<Case>
{
protected:
  Metamorphic()
    : Input(GetParam().Make())
  {
    this->Options.Geometry = GetParam().Geometry;
    this->Options.FeatureAngle = 120.0;
  }

  bool IsSurface() const { return this->Options.Geometry == GeometryKind::Surface; }

  FlipResult Run(const Mesh& mesh) const
  {
    const FlipResult result = Flip(mesh.View(), this->Options);
    const TriangleMesh after = WithTriangles(mesh.View(), result.Triangles);
    EXPECT_TRUE(result.Report.Converged());
    EXPECT_EQ(CountNonDelaunayEdges(mesh.View(), this->Options), result.Report.NonDelaunayBefore);
    if (!this->IsSurface()) // On surfaces feature edges may have moved on.
    {
      EXPECT_EQ(0, CountNonDelaunayEdges(after, this->Options));
      EXPECT_EQ(0, result.Report.NonDelaunayAfter);
    }
    ExpectSameTopology(mesh.View().Triangles, result.Triangles, result.Report);
    return result;
  }

  /// Expects equal triangles in equal slots, and equal statistics.
  void ExpectSame(const Mesh& changed, const std::string& what) const
  {
    SCOPED_TRACE(what);
    const FlipResult expected = this->Run(this->Input);
    EXPECT_LT(0, expected.Report.TotalFlips);
    ExpectSameResult(expected, this->Run(changed));
  }

  /// Expects an equal set of triangles, where the rule makes it unique. Else it expects what any
  /// order of flips must leave: on planes no bad edge, on surfaces the same edges of each kind, and
  /// fewer bad ones.
  /// @param rename gives the triangles of the changed mesh the names of the input.
  template <typename Rename>
  void ExpectCorresponding(const Mesh& changed, const Rename& rename)
  {
    if (this->IsSurface())
    {
      const FlipReport expected = this->Run(this->Input).Report;
      const FlipReport report = this->Run(changed).Report;
      EXPECT_EQ(expected.NonDelaunayBefore, report.NonDelaunayBefore);
      EXPECT_EQ(expected.Edges.Fixed, report.Edges.Fixed);
      EXPECT_EQ(expected.MinimumAngleBefore, report.MinimumAngleBefore);
      EXPECT_GT(expected.NonDelaunayBefore, 10 * report.NonDelaunayAfter);
      return;
    }
    this->Run(changed);
    this->Options.TieRule = TieRuleKind::Canonical;
    std::vector<std::int32_t> triangles = this->Run(changed).Triangles;
    rename(triangles);
    EXPECT_EQ(ToTriangleSet(this->Run(this->Input).Triangles), ToTriangleSet(triangles));
  }

  Mesh Input;
  FlipOptions Options;
};

Mesh Scale(const Mesh& mesh, double factor) { return Transform(mesh, ScaleAndMove(factor, 0.0)); }

/// Down to numbers without all their bits, and up to the largest.
TEST_P(Metamorphic, ScaledByAPowerOfTwo)
{
  for (const int exponent :
    { -1074, -1060, -1000, -600, -521, -300, -101, -1, 1, 120, 300, 521, 1000 })
  {
    if (exponent + 21 < 1024)
    {
      this->ExpectSame(Scale(this->Input, std::scalbn(1.0, exponent)), std::to_string(exponent));
    }
  }
}

/// The automatic tolerance grows with the coordinates, so surfaces get a fixed one.
TEST_P(Metamorphic, ShiftedExactly)
{
  this->Options.Tolerance = this->IsSurface() ? 1e-9 : -1.0;
  for (const double shift : { 0x1p21, -0x1p30 })
  {
    this->ExpectSame(Transform(this->Input,
                       { { { 1, 0, 0, shift }, { 0, 1, 0, 3 * shift }, { 0, 0, 1, shift } } }),
      std::to_string(shift));
  }
}

/// Triangles then turn the other way, which changes no decision.
TEST_P(Metamorphic, Mirrored)
{
  this->ExpectSame(
    Transform(this->Input, { { { -1, 0, 0, 0 }, { 0, 1, 0, 0 }, { 0, 0, 1, 0 } } }), "x");
  this->ExpectSame(
    Transform(this->Input, { { { -1, 0, 0, 0 }, { 0, -1, 0, 0 }, { 0, 0, 1, 0 } } }), "x and y");
}

TEST_P(Metamorphic, WoundTheOtherWay)
{
  Mesh changed = this->Input;
  ReverseTriangles(changed.Triangles);
  this->ExpectCorresponding(
    changed, [](std::vector<std::int32_t>& triangles) { ReverseTriangles(triangles); });
}

TEST_P(Metamorphic, RenumberedPoints)
{
  std::mt19937 random(8);
  std::vector<std::int32_t> newIds(this->Input.NumberOfPoints());
  std::iota(newIds.begin(), newIds.end(), 0);
  std::shuffle(newIds.begin(), newIds.end(), random);
  std::vector<std::int32_t> oldIds(newIds.size());
  Mesh changed = this->Input;
  for (std::size_t i = 0; i < newIds.size(); ++i)
  {
    oldIds[newIds[i]] = static_cast<std::int32_t>(i);
    std::copy_n(this->Input.Points.begin() + 3 * i, 3, changed.Points.begin() + 3 * newIds[i]);
  }
  const auto rename = [](std::vector<std::int32_t>& triangles, const std::vector<std::int32_t>& ids)
  {
    for (std::int32_t& id : triangles)
    {
      id = ids[id];
    }
  };
  rename(changed.Triangles, newIds);
  this->ExpectCorresponding(
    changed, [&](std::vector<std::int32_t>& triangles) { rename(triangles, oldIds); });
}

TEST_P(Metamorphic, RotatedIdsInTriangles)
{
  std::mt19937 random(9);
  Mesh changed = this->Input;
  for (auto triangle = changed.Triangles.begin(); triangle != changed.Triangles.end();
       triangle += 3)
  {
    std::rotate(triangle, triangle + DrawIndex(random, 3), triangle + 3);
  }
  this->ExpectCorresponding(changed, [](std::vector<std::int32_t>&) {});
}

TEST_P(Metamorphic, PermutedTriangles)
{
  std::mt19937 random(10);
  std::vector<std::int32_t> order(this->Input.NumberOfTriangles());
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), random);
  Mesh changed = this->Input;
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    std::copy_n(this->Input.Triangles.begin() + 3 * order[i], 3, changed.Triangles.begin() + 3 * i);
  }
  this->ExpectCorresponding(changed, [](std::vector<std::int32_t>&) {});
}

INSTANTIATE_TEST_SUITE_P(Cases, Metamorphic, testing::ValuesIn(Cases), GetCaseName);

}
}
