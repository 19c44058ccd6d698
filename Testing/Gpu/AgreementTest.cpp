// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CudaDevice.h"
#include "FlipTestSupport.h"
#include "GpuTestSupport.h"

#include <gtest/gtest.h>

#include <random>
#include <utility>
#include <vector>

/// @file
/// The GPU's mesh and statistics are the CPU's, bit for bit.

namespace delaunayflip
{
namespace
{

struct AgreementCase
{
  const char* Name;
  OwnedMesh<double> (*Make)();
  GeometryKind Geometry;
  CriterionKind Criterion = CriterionKind::InCircle;
  TieRuleKind TieRule = TieRuleKind::Keep;
  double FeatureAngle = 180.0;
};

void PrintTo(const AgreementCase& mesh, std::ostream* stream) { *stream << mesh.Name; }

OwnedMesh<double> MakeSmallPlane() { return MakeRandomBadMeshDouble(500, 11); }
OwnedMesh<double> MakeMiddlePlane() { return MakeRandomBadMeshDouble(8000, 18); }
OwnedMesh<double> MakeLargePlane() { return MakeRandomBadMeshDouble(150000, 12); }
OwnedMesh<double> MakeGrid() { return MakeGridMesh(300, 200); }
OwnedMesh<double> MakeChain() { return MakeWorstCaseMesh(60); }
OwnedMesh<double> MakeSphere() { return MakeBadSphere(300, 150, 13); }
OwnedMesh<double> MakeStrip() { return MakeMoebiusStrip(1000, 8, 14); }

OwnedMesh<double> MakeTiltedPlane()
{
  const AffineMap map = { { { 1, 0, 0, 0 }, { 0, 1, 0, 0 }, { 2, -3, 0, 0 } } };
  return Transform(MakeRandomBadMeshDouble(50000, 15), map);
}

/// A grid of lattice points far from the origin, with random diagonals: ties and bad edges.
OwnedMesh<double> MakeFarPlane()
{
  return Transform(MakeRandomBadMeshDouble(30000, 16), ScaleAndMove(1000.0, 1e7));
}

/// A wave that folds planes over themselves, so that flips could repeat edges.
OwnedMesh<double> MakeFoldedPlane()
{
  OwnedMesh<double> mesh = MakeBadSphere(200, 100, 17);
  for (std::size_t i = 2; i < mesh.Points.size(); i += 3)
  {
    mesh.Points[i] = 0.0;
  }
  return mesh;
}

/// Hills that Auto judges by x and y if they are gentle, in space if they are steep, and in space
/// with a warning if a few triangles are turned over.
OwnedMesh<double> MakeHills(double height)
{
  OwnedMesh<double> mesh = MakeGridMesh(300, 200);
  for (std::size_t i = 0; i < mesh.Points.size(); i += 3)
  {
    mesh.Points[i] += 0.3 * static_cast<double>(i % 11) / 11.0;
    mesh.Points[i + 2] = height * static_cast<double>(i * i % 101) / 101.0;
  }
  return mesh;
}
OwnedMesh<double> MakeGentleHills() { return MakeHills(0.5); }
OwnedMesh<double> MakeSteepHills() { return MakeHills(5.0); }
OwnedMesh<double> MakeNearlyHills()
{
  OwnedMesh<double> mesh = MakeHills(0.5);
  for (std::size_t t = 0; t < mesh.Triangles.size(); t += 3 * 300)
  {
    std::swap(mesh.Triangles[t], mesh.Triangles[t + 1]);
  }
  return mesh;
}

OwnedMesh<double> MakeDirtySphere() { return RepeatTriangles(MakeSphere()); }

FlipOptions MakeOptions(BackendKind backend)
{
  FlipOptions options;
  options.Backend = backend;
  options.FeatureAngle = 180.0;
  return options;
}

void ExpectSameResult(const FlipResult& expected, const FlipResult& actual)
{
  EXPECT_TRUE(expected.Triangles == actual.Triangles);
  EXPECT_TRUE(expected.FlipCounts == actual.FlipCounts);
  ExpectSameStatistics(expected.Report, actual.Report);
}

class AgreementTest : public testing::TestWithParam<AgreementCase>
{
protected:
  void SetUp() override
  {
    if (!HasCudaDevice())
    {
      GTEST_SKIP() << "no GPU";
    }
    this->Mesh = GetParam().Make();
  }

  FlipOptions GetOptions(BackendKind backend) const
  {
    FlipOptions options = MakeOptions(backend);
    options.Geometry = GetParam().Geometry;
    options.Criterion = GetParam().Criterion;
    options.TieRule = GetParam().TieRule;
    options.FeatureAngle = GetParam().FeatureAngle;
    return options;
  }

  OwnedMesh<double> Mesh;
};

TEST_P(AgreementTest, TheGpuGivesTheCpusBits)
{
  const FlipResult expected = Flip(this->Mesh.View(), this->GetOptions(BackendKind::Threads));
  const FlipResult actual = Flip(this->Mesh.View(), this->GetOptions(BackendKind::CUDA));
  EXPECT_EQ(0u, actual.Report.Backend.rfind("CUDA: ", 0)) << actual.Report.Backend;
  ExpectSameResult(expected, actual);
  ExpectSameResult(actual, Flip(this->Mesh.View(), this->GetOptions(BackendKind::CUDA)));
}

TEST_P(AgreementTest, EveryIterationAgrees)
{
  FlipOptions options = this->GetOptions(BackendKind::Threads);
  options.TrackQuality = true;
  options.MaximumIterations = 20;
  const FlipResult expected = Flip(this->Mesh.View(), options);
  options.Backend = BackendKind::CUDA;
  ExpectSameResult(expected, Flip(this->Mesh.View(), options));
}

TEST_P(AgreementTest, SingleStepsGiveTheSameBits)
{
  FlipOptions options = this->GetOptions(BackendKind::CUDA);
  FlipSession session(this->Mesh.View(), options);
  while (session.Advance(1))
  {
  }
  FlipResult result;
  result.Triangles.resize(this->Mesh.Triangles.size());
  result.FlipCounts.resize(this->Mesh.Triangles.size() / 3);
  session.StoreTriangles(
    MutableTriangleArray(result.Triangles.data(), this->Mesh.NumberOfTriangles()));
  session.StoreFlipCounts(result.FlipCounts.data());
  result.Report = session.GetReport();
  options.Backend = BackendKind::Threads;
  ExpectSameResult(Flip(this->Mesh.View(), options), result);
}

INSTANTIATE_TEST_SUITE_P(Meshes, AgreementTest,
  testing::Values(AgreementCase{ "SmallPlane", MakeSmallPlane, GeometryKind::Auto },
    AgreementCase{ "MiddlePlane", MakeMiddlePlane, GeometryKind::Auto },
    AgreementCase{ "LargePlane", MakeLargePlane, GeometryKind::Auto },
    AgreementCase{
      "PlaneByAngles", MakeSmallPlane, GeometryKind::Auto, CriterionKind::OppositeAngles },
    AgreementCase{ "TiltedPlane", MakeTiltedPlane, GeometryKind::Auto },
    AgreementCase{ "Terrain", MakeTiltedPlane, GeometryKind::PlanarXY },
    AgreementCase{
      "TerrainByAngles", MakeTiltedPlane, GeometryKind::PlanarXY, CriterionKind::OppositeAngles },
    AgreementCase{ "PlaneAsSurface", MakeTiltedPlane, GeometryKind::Surface },
    AgreementCase{ "FarPlane", MakeFarPlane, GeometryKind::Auto },
    AgreementCase{ "FoldedPlane", MakeFoldedPlane, GeometryKind::Auto },
    AgreementCase{ "Grid", MakeGrid, GeometryKind::Auto },
    AgreementCase{ "CanonicalGrid", MakeGrid, GeometryKind::Auto, CriterionKind::InCircle,
      TieRuleKind::Canonical },
    AgreementCase{ "Chain", MakeChain, GeometryKind::Auto },
    AgreementCase{ "Sphere", MakeSphere, GeometryKind::Auto },
    AgreementCase{ "SphereWithFeatures", MakeSphere, GeometryKind::Auto, CriterionKind::InCircle,
      TieRuleKind::Keep, 30.0 },
    AgreementCase{ "GentleHills", MakeGentleHills, GeometryKind::Auto },
    AgreementCase{ "SteepHills", MakeSteepHills, GeometryKind::Auto },
    AgreementCase{ "NearlyHills", MakeNearlyHills, GeometryKind::Auto },
    AgreementCase{ "MoebiusStrip", MakeStrip, GeometryKind::Auto },
    AgreementCase{ "DirtySphere", MakeDirtySphere, GeometryKind::Auto }),
  [](const auto& test) { return std::string(test.param.Name); });

class FloatAgreementTest : public GpuTest
{
};

// Ids and flip counts are copied in parts of two million numbers, each in a separate slice.
TEST_F(FloatAgreementTest, OutputsOfSeveralSlicesAreWhole)
{
  const OwnedMesh<float> mesh = MakeRandomBadMesh(1100000, 22);
  ExpectSameResult(Flip(mesh.View(), MakeOptions(BackendKind::Threads)),
    Flip(mesh.View(), MakeOptions(BackendKind::CUDA)));
}

TEST_F(FloatAgreementTest, TheGpuGivesTheCpusBits)
{
  const OwnedMesh<float> mesh = MakeRandomBadMesh(200000, 21);
  ExpectSameResult(Flip(mesh.View(), MakeOptions(BackendKind::Threads)),
    Flip(mesh.View(), MakeOptions(BackendKind::CUDA)));
  FlipOptions surface = MakeOptions(BackendKind::Threads);
  surface.Geometry = GeometryKind::Surface;
  const FlipResult expected = Flip(mesh.View(), surface);
  surface.Backend = BackendKind::CUDA;
  ExpectSameResult(expected, Flip(mesh.View(), surface));
}

// Each edge's own tolerance decides ties, near the origin and far from it. The precision is that of
// float even if points of a plane are packed as doubles.
TEST_F(FloatAgreementTest, TolerancesAgree)
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

class InsertionAgreementTest : public GpuTest
{
};

TEST_F(InsertionAgreementTest, InsertedConstraintsAgree)
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
  TriangleMesh mesh = bad.View();
  mesh.ConstraintEdges = ends.data();
  mesh.NumberOfConstraintEdges = Constraints;
  mesh.ConstraintsToInsert = toInsert.data();
  const FlipReport report = ExpectGpuAgrees(mesh, FlipOptions()).Report;
  EXPECT_LT(0, report.InsertedConstraints);
  EXPECT_LT(0, report.ConstraintFlips);
}

}
}
