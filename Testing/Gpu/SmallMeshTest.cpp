// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "GpuTestSupport.h"
#include "RandomInputs.h"

/// @file
/// One small mesh of each kind. run.sh runs these tests under compute-sanitizer, which makes every
/// step take a hundred times as long.

namespace delaunayflip
{
namespace
{

class SmallMeshTest : public GpuTest
{
protected:
  static FlipOptions WithGeometry(GeometryKind geometry)
  {
    FlipOptions options;
    options.Geometry = geometry;
    options.FeatureAngle = 180.0;
    return options;
  }
};

TEST_F(SmallMeshTest, Plane)
{
  const OwnedMesh<float> mesh = MakeRandomBadMesh(3000, 61);
  ExpectGpuAgrees(mesh.View(), WithGeometry(GeometryKind::Auto));
}

TEST_F(SmallMeshTest, PlaneByAnglesWithQuality)
{
  const OwnedMesh<double> mesh = MakeRandomBadMeshDouble(400, 62);
  FlipOptions options;
  options.Criterion = CriterionKind::OppositeAngles;
  options.TrackQuality = true;
  ExpectGpuAgrees(mesh.View(), options);
}

TEST_F(SmallMeshTest, TerrainWithConstraintsRegionsAndFrozenTriangles)
{
  const AffineMap map = { { { 1, 0, 0, 0 }, { 0, 1, 0, 0 }, { 2, -3, 0, 0 } } };
  const OwnedMesh<double> mesh = Transform(MakeRandomBadMeshDouble(800, 63), map);
  std::vector<std::int32_t> regions(static_cast<std::size_t>(mesh.NumberOfTriangles()));
  std::vector<unsigned char> frozen(regions.size());
  for (std::size_t i = 0; i < regions.size(); ++i)
  {
    regions[i] = static_cast<std::int32_t>(i / 400);
    frozen[i] = i % 97 == 0;
  }
  std::vector<std::int64_t> constraints(mesh.Triangles.begin(), mesh.Triangles.begin() + 60);
  TriangleMesh view = mesh.View();
  view.Regions = regions.data();
  view.FrozenTriangles = frozen.data();
  view.ConstraintEdges = constraints.data();
  view.NumberOfConstraintEdges = 30;
  ExpectGpuAgrees(view, WithGeometry(GeometryKind::PlanarXY));
}

TEST_F(SmallMeshTest, Surfaces)
{
  for (const OwnedMesh<double>& mesh : { MakeBadSphere(30, 15, 64), MakeMoebiusStrip(60, 4, 65) })
  {
    ExpectGpuAgrees(mesh.View(), WithGeometry(GeometryKind::Auto));
  }
}

TEST_F(SmallMeshTest, SurfaceOfFloats)
{
  const OwnedMesh<float> sphere = RoundToFloat(MakeBadSphere(30, 15, 66));
  ExpectGpuAgrees(sphere.View(), WithGeometry(GeometryKind::Auto));
}

TEST_F(SmallMeshTest, ChainAndTies)
{
  const OwnedMesh<double> chain = MakeWorstCaseMesh(20);
  ExpectGpuAgrees(chain.View(), {});
  const OwnedMesh<double> grid = MakeGridMesh(20, 10);
  FlipOptions canonical;
  canonical.TieRule = TieRuleKind::Canonical;
  ExpectGpuAgrees(grid.View(), canonical);
}

TEST_F(SmallMeshTest, Messes)
{
  for (std::uint32_t seed = 5001; seed <= 5012; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const RandomMess mess = MakeRandomMess(seed);
    ExpectGpuAgrees(mess.View(), mess.Options);
  }
}

}
}
