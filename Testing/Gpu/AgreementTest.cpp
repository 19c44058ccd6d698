// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "GpuTestSupport.h"
#include "RandomInputs.h"

#include <cmath>
#include <random>
#include <utility>
#include <vector>

/// @file
/// The GPU gives the bits of the CPU: triangles, flip counts and statistics.

namespace delaunayflip
{
namespace
{

constexpr AffineMap Tilt = { { { 1, 0, 0, 0 }, { 0, 1, 0, 0 }, { 2, -3, 0, 0 } } };

OwnedMesh<double> MakeTiltedPlane() { return Transform(MakeRandomBadMeshDouble(50000, 15), Tilt); }
OwnedMesh<double> MakeSphere() { return MakeBadSphere(300, 150, 13); }
OwnedMesh<double> MakeGrid() { return MakeGridMesh(300, 200); }

OwnedMesh<double> MakeFoldedPlane()
{
  return Lift(MakeBadSphere(200, 100, 17), [](double, double) { return 0.0; });
}

OwnedMesh<double> MakeHills(double height)
{
  OwnedMesh<double> mesh = MakeGrid();
  for (std::size_t i = 0; i < mesh.Points.size(); i += 3)
  {
    mesh.Points[i] += 0.3 * static_cast<double>(i % 11) / 11.0;
    mesh.Points[i + 2] = height * static_cast<double>(i * i % 101) / 101.0;
  }
  return mesh;
}

/// A few triangles are turned over, so it is no height field.
OwnedMesh<double> MakeNearlyHills()
{
  OwnedMesh<double> mesh = MakeHills(0.5);
  for (std::size_t t = 0; t < mesh.Triangles.size(); t += 3 * 300)
  {
    std::swap(mesh.Triangles[t], mesh.Triangles[t + 1]);
  }
  return mesh;
}

struct AgreementCase
{
  const char* Name;
  OwnedMesh<double> (*Make)();
  GeometryKind Geometry = GeometryKind::Auto;
  CriterionKind Criterion = CriterionKind::InCircle;
  TieRuleKind TieRule = TieRuleKind::Keep;
  double FeatureAngle = 180.0;
  double MaximumDeviation = INFINITY;
};

constexpr GeometryKind Auto = GeometryKind::Auto;
constexpr CriterionKind InCircleOnly = CriterionKind::InCircle;
constexpr CriterionKind Angles = CriterionKind::OppositeAngles;

const AgreementCase Cases[] = {
  { "SmallPlane", [] { return MakeRandomBadMeshDouble(500, 11); } },
  { "MiddlePlane", [] { return MakeRandomBadMeshDouble(8000, 18); } },
  { "LargePlane", [] { return MakeRandomBadMeshDouble(150000, 12); } },
  { "PlaneByAngles", [] { return MakeRandomBadMeshDouble(500, 11); }, Auto, Angles },
  { "TiltedPlane", MakeTiltedPlane },
  { "Terrain", MakeTiltedPlane, GeometryKind::PlanarXY },
  { "TerrainByAngles", MakeTiltedPlane, GeometryKind::PlanarXY, Angles },
  { "PlaneAsSurface", MakeTiltedPlane, GeometryKind::Surface },
  { "FarPlane",
    [] { return Transform(MakeRandomBadMeshDouble(30000, 16), ScaleAndMove(1000.0, 1e7)); } },
  { "FoldedPlane", MakeFoldedPlane },
  { "Grid", MakeGrid },
  { "CanonicalGrid", MakeGrid, Auto, InCircleOnly, TieRuleKind::Canonical },
  { "Chain", [] { return MakeWorstCaseMesh(60); } },
  { "Sphere", MakeSphere },
  { "Globe", MakeSphere, GeometryKind::Sphere },
  { "CanonicalGlobe", [] { return MakeLatLongSphere(300, 150); }, GeometryKind::Sphere,
    InCircleOnly, TieRuleKind::Canonical },
  { "SphereWithFeatures", MakeSphere, Auto, InCircleOnly, TieRuleKind::Keep, 30.0 },
  { "SphereWithDeviation", MakeSphere, Auto, InCircleOnly, TieRuleKind::Keep, 180.0, 0.001 },
  { "GentleHills", [] { return MakeHills(0.5); } },
  { "SteepHills", [] { return MakeHills(5.0); } },
  { "NearlyHills", MakeNearlyHills },
  { "MoebiusStrip", [] { return MakeMoebiusStrip(1000, 8, 14); } },
  { "DirtySphere", [] { return RepeatTriangles(MakeSphere()); } },
};

class AgreementTest
  : public GpuTest
  , public testing::WithParamInterface<AgreementCase>
{
protected:
  static FlipOptions GetOptions()
  {
    FlipOptions options = MakeOptions(BackendKind::CUDA, GetParam().Geometry);
    options.Criterion = GetParam().Criterion;
    options.TieRule = GetParam().TieRule;
    options.FeatureAngle = GetParam().FeatureAngle;
    options.MaximumDeviation = GetParam().MaximumDeviation;
    return options;
  }
};

TEST_P(AgreementTest, RunsAgree)
{
  const OwnedMesh<double> mesh = GetParam().Make();
  const FlipResult first = ExpectGpuAgrees(mesh.View(), GetOptions());
  ExpectSameResult(first, Flip(mesh.View(), GetOptions()));
  ExpectSameResult(first, FlipInSteps(mesh.View(), GetOptions(), 1));
}

TEST_P(AgreementTest, EveryIterationAgrees)
{
  FlipOptions options = GetOptions();
  options.TrackQuality = true;
  options.MaximumIterations = 20;
  ExpectGpuAgrees(GetParam().Make().View(), options);
}

INSTANTIATE_TEST_SUITE_P(Meshes, AgreementTest, testing::ValuesIn(Cases), GetCaseName);

class MoreAgreementTest : public GpuTest
{
};

/// The larger mesh is copied back in several slices.
TEST_F(MoreAgreementTest, Floats)
{
  for (const std::int64_t points : { 200000, 1100000 })
  {
    const OwnedMesh<float> mesh = MakeRandomBadMesh(points, 22);
    ExpectGpuAgrees(mesh.View(), MakeOptions(BackendKind::CUDA));
    if (points == 200000)
    {
      ExpectGpuAgrees(mesh.View(), MakeOptions(BackendKind::CUDA, GeometryKind::Surface));
    }
  }
}

TEST_F(MoreAgreementTest, Tolerances)
{
  for (double offset : { 0.0, 1000.0, 1e6 })
  {
    const OwnedMesh<float> mesh =
      RoundToFloat(Transform(MakeLatLongSphere(400, 200), ScaleAndMove(100.0, offset)));
    const OwnedMesh<float> plane =
      RoundToFloat(Transform(MakeRandomBadMeshDouble(30000, 23), ScaleAndMove(100.0, offset)));
    for (double tolerance : { -1.0, 0.0, 1e-9 })
    {
      FlipOptions options = MakeOptions(BackendKind::CUDA);
      options.Tolerance = tolerance;
      options.MaximumIterations = 200; // for a tolerance of 0
      ExpectGpuAgrees(mesh.View(), options);
      options.Criterion = CriterionKind::OppositeAngles;
      ExpectGpuAgrees(plane.View(), options);
    }
  }
}

TEST_F(MoreAgreementTest, InsertedConstraints)
{
  constexpr std::int64_t Constraints = 300;
  const OwnedMesh<double> bad = MakeRandomBadMeshDouble(50000, 24);
  std::mt19937 random(24);
  std::vector<std::int64_t> ends;
  for (std::int64_t i = 0; i < 2 * Constraints; ++i)
  {
    ends.push_back(DrawIndex(random, bad.NumberOfPoints()));
  }
  const std::vector<unsigned char> toInsert(Constraints, 1);
  const TriangleMesh mesh = WithConstraints(bad.View(), ends, toInsert.data());
  const FlipReport report = ExpectGpuAgrees(mesh, FlipOptions()).Report;
  EXPECT_LT(0, report.InsertedConstraints);
  EXPECT_LT(0, report.ConstraintFlips);
}

void ExpectMessesAgree(std::uint32_t first, std::uint32_t last)
{
  for (std::uint32_t seed = first; seed <= last && !testing::Test::HasFailure(); ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const RandomMess mess = MakeRandomMess(seed);
    ExpectGpuAgrees(mess.View(), mess.Options);
  }
}

/// Small meshes with every kind of defect.
TEST_F(MoreAgreementTest, Messes) { ExpectMessesAgree(1, 2000); }

/// One small mesh of each kind. run.sh runs these tests under compute-sanitizer, which makes every
/// step take a hundred times as long.
class SmallMeshTest : public GpuTest
{
};

TEST_F(SmallMeshTest, Planes)
{
  ExpectGpuAgrees(MakeRandomBadMesh(3000, 61).View(), MakeOptions(BackendKind::CUDA));
  FlipOptions options;
  options.Criterion = CriterionKind::OppositeAngles;
  options.TrackQuality = true;
  ExpectGpuAgrees(MakeRandomBadMeshDouble(400, 62).View(), options);
  ExpectGpuAgrees(MakeWorstCaseMesh(20).View(), {});
  ExpectGpuAgrees(MakeGridMesh(20, 10).View(), With(&FlipOptions::TieRule, TieRuleKind::Canonical));
}

TEST_F(SmallMeshTest, TerrainWithConstraintsRegionsAndFrozenTriangles)
{
  const OwnedMesh<double> mesh = Transform(MakeRandomBadMeshDouble(800, 63), Tilt);
  std::vector<std::int32_t> regions(static_cast<std::size_t>(mesh.NumberOfTriangles()));
  std::vector<unsigned char> frozen(regions.size());
  for (std::size_t i = 0; i < regions.size(); ++i)
  {
    regions[i] = static_cast<std::int32_t>(i / 400);
    frozen[i] = i % 97 == 0;
  }
  std::vector<std::int64_t> constraints(mesh.Triangles.begin(), mesh.Triangles.begin() + 60);
  TriangleMesh view = WithConstraints(mesh.View(), constraints);
  view.Regions = regions.data();
  view.FrozenTriangles = frozen.data();
  ExpectGpuAgrees(view, MakeOptions(BackendKind::CUDA, GeometryKind::PlanarXY));
}

TEST_F(SmallMeshTest, Surfaces)
{
  const FlipOptions options = MakeOptions(BackendKind::CUDA);
  ExpectGpuAgrees(MakeBadSphere(30, 15, 64).View(), options);
  ExpectGpuAgrees(RoundToFloat(MakeBadSphere(30, 15, 66)).View(), options);
  ExpectGpuAgrees(MakeMoebiusStrip(60, 4, 65).View(), options);
}

/// Bipyramids over triangles: the three edges at the waist of one are all bad, and would all become
/// the edge between its tips.
OwnedMesh<double> MakeBipyramids(int count)
{
  constexpr double Height = 0.6;
  OwnedMesh<double> mesh;
  for (int i = 0; i < count; ++i)
  {
    const std::int32_t first = 5 * i;
    const double x = 3.0 * i;
    mesh.Points.insert(mesh.Points.end(),
      { x, 0.0, Height, x, 0.0, -Height, x + 1.0, 0.0, 0.0, x - 0.5, 0.875, 0.0, x - 0.5, -0.875,
        0.0 });
    for (int k = 0; k < 3; ++k)
    {
      const std::int32_t p = first + 2 + k, q = first + 2 + (k + 1) % 3;
      mesh.Triangles.insert(mesh.Triangles.end(), { first, p, q, first + 1, q, p });
    }
  }
  return mesh;
}

TEST_F(SmallMeshTest, EdgesThatWouldBecomeTheSame)
{
  constexpr int Count = 200;
  const FlipReport report =
    ExpectGpuAgrees(MakeBipyramids(Count).View(), MakeOptions(BackendKind::CUDA)).Report;
  EXPECT_EQ(Count, report.TotalFlips);
  EXPECT_EQ(2 * Count, report.BlockedByEdge);
}

/// Points of a longitude-latitude grid, where everything would tie without rounding.
TEST_F(SmallMeshTest, PointsOnASphere)
{
  const OwnedMesh<double> globe = MakeLatLongSphere(40, 20);
  PointInput input;
  input.Points = PlaneArray(globe.Points.data(), globe.NumberOfPoints(), 3);
  std::vector<std::int32_t> triangles[2];
  for (const BackendKind backend : { BackendKind::Threads, BackendKind::CUDA })
  {
    PointOptions options;
    options.Backend = backend;
    options.Projection = ProjectionKind::Sphere;
    FlipSession session(input, options);
    session.Advance();
    EXPECT_EQ(2 * globe.NumberOfPoints() - 4, session.GetReport().Triangles);
    EXPECT_EQ(backend == BackendKind::CUDA, IsOnGpu(session.GetReport()));
    triangles[int(backend == BackendKind::CUDA)] = StoreTriangles(session);
  }
  EXPECT_EQ(triangles[0], triangles[1]);
}

TEST_F(SmallMeshTest, Messes) { ExpectMessesAgree(5001, 5012); }

}
}
