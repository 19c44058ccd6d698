// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CudaDevice.h"
#include "CudaError.h"
#include "DeviceMemory.h"
#include "FlipError.h"
#include "FlipTestSupport.h"
#include "GpuTestSupport.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

/// @file
/// A mesh on two GPUs: its bits are those of one. The meshes are large enough for all launches to
/// be shared.

namespace delaunayflip
{
namespace
{

class SharedMeshTest : public GpuTest
{
protected:
  void SetUp() override
  {
    this->GpuTest::SetUp();
    int devices = 0;
    cudaGetDeviceCount(&devices);
    if (devices < 2)
    {
      GTEST_SKIP() << "one GPU only";
    }
    int isNative = 0;
    cudaDeviceGetP2PAttribute(&isNative, cudaDevP2PAttrNativeAtomicSupported, 0, 1);
    if (isNative == 0)
    {
      GTEST_SKIP() << "GPUs 0 and 1 cannot do atomic operations in each other's memory";
    }
    SetSmallestShare(1);
  }
  void TearDown() override
  {
    InjectCudaError(0, cudaSuccess);
    SetSmallestShare(this->Smallest);
  }

private:
  std::int64_t Smallest = GetSmallestShare();
};

/// Flips on one GPU and on two.
void ExpectSame(const TriangleMesh& mesh, FlipOptions options = {})
{
  options.Backend = BackendKind::CUDA;
  options.Device = 0;
  const FlipResult expected = Flip(mesh, options);
  options.Devices = { 0, 1 };
  const FlipResult actual = Flip(mesh, options);
  EXPECT_EQ(0u, actual.Report.Backend.rfind("CUDA: 2 x ", 0)) << actual.Report.Backend;
  EXPECT_LT(0, expected.Report.TotalFlips);
  EXPECT_TRUE(expected.Triangles == actual.Triangles);
  EXPECT_TRUE(expected.FlipCounts == actual.FlipCounts);
  ExpectSameStatistics(expected.Report, actual.Report);
}

constexpr std::int64_t Points = 400000;

TEST_F(SharedMeshTest, Plane)
{
  const OwnedMesh<double> mesh = MakeRandomBadMeshDouble(Points, 51);
  ExpectSame(mesh.View());
}

TEST_F(SharedMeshTest, CanonicalPlaneOfFloats)
{
  const OwnedMesh<float> mesh = MakeTiledBadMesh(4 * Points, 5, 52);
  FlipOptions options;
  options.TieRule = TieRuleKind::Canonical;
  ExpectSame(mesh.View(), options);
}

TEST_F(SharedMeshTest, OppositeAnglesInAPlane)
{
  const OwnedMesh<double> mesh = MakeRandomBadMeshDouble(Points, 53);
  FlipOptions options;
  options.Criterion = CriterionKind::OppositeAngles;
  ExpectSame(mesh.View(), options);
}

TEST_F(SharedMeshTest, SurfaceWithFeatures)
{
  const OwnedMesh<double> mesh = MakeBadSphere(1200, 400, 54);
  FlipOptions options;
  options.Geometry = GeometryKind::Surface;
  ExpectSame(mesh.View(), options);
  options.FeatureAngle = 180.0;
  options.TrackQuality = true;
  ExpectSame(mesh.View(), options);
}

TEST_F(SharedMeshTest, Ties)
{
  const OwnedMesh<double> mesh = MakeGridMesh(700, 600);
  FlipOptions options;
  options.TieRule = TieRuleKind::Canonical;
  const OwnedMesh<double> moved = Transform(mesh, ScaleAndMove(3.0, 1e6));
  ExpectSame(moved.View(), options);
}

TEST_F(SharedMeshTest, RegionsAndConstraints)
{
  OwnedMesh<double> mesh = MakeRandomBadMeshDouble(Points, 55);
  std::vector<std::int32_t> regions(mesh.NumberOfTriangles());
  for (std::size_t t = 0; t < regions.size(); ++t)
  {
    regions[t] = static_cast<std::int32_t>(t / 1000);
  }
  std::vector<std::int64_t> edges;
  for (std::int64_t t = 0; t < mesh.NumberOfTriangles(); t += 977)
  {
    edges.insert(edges.end(), { mesh.Triangles[3 * t], mesh.Triangles[3 * t + 1] });
  }
  TriangleMesh view = mesh.View();
  view.Regions = regions.data();
  view.ConstraintEdges = edges.data();
  view.NumberOfConstraintEdges = static_cast<std::int64_t>(edges.size() / 2);
  ExpectSame(view);
}

TEST_F(SharedMeshTest, SmallMeshes)
{
  for (const std::int64_t points : { 3, 50, 5000 })
  {
    const OwnedMesh<double> mesh = MakeRandomBadMeshDouble(points, 56);
    FlipOptions options;
    options.Backend = BackendKind::CUDA;
    const FlipResult expected = Flip(mesh.View(), options);
    options.Devices = { 1, 0 };
    EXPECT_TRUE(expected.Triangles == Flip(mesh.View(), options).Triangles) << points;
  }
}

TEST_F(SharedMeshTest, AMeshThatIsTooSmallStaysOnOneGpu)
{
  const OwnedMesh<double> mesh = MakeRandomBadMeshDouble(50000, 59);
  FlipOptions options;
  options.Backend = BackendKind::CUDA;
  options.Devices = { 0, 1 };
  SetSmallestShare(mesh.NumberOfTriangles() / 2);
  EXPECT_EQ(0u, Flip(mesh.View(), options).Report.Backend.rfind("CUDA: 2 x ", 0));
  SetSmallestShare(mesh.NumberOfTriangles() / 2 + 1);
  EXPECT_NE(0u, Flip(mesh.View(), options).Report.Backend.rfind("CUDA: 2 x ", 0));
}

TEST_F(SharedMeshTest, AnyCallMayFail)
{
  const OwnedMesh<double> mesh = MakeRandomBadMeshDouble(Points, 57);
  FlipOptions options;
  const FlipResult expected = Flip(mesh.View(), options);
  options.Devices = { 0, 1 };
  Flip(mesh.View(), options);
  int fallbacks = 0;
  for (std::int64_t call = 1; call < 1500; call += 29)
  {
    InjectCudaError(call, cudaErrorMemoryAllocation);
    const FlipResult result = Flip(mesh.View(), options);
    InjectCudaError(0, cudaSuccess);
    ASSERT_TRUE(expected.Triangles == result.Triangles) << "call " << call;
    fallbacks += result.Report.Fallback.empty() ? 0 : 1; // there may also be memory after all
    ReleaseCudaMemory();
  }
  EXPECT_LT(10, fallbacks);
}

TEST_F(SharedMeshTest, NoSuchGpuIsAnError)
{
  const OwnedMesh<double> mesh = MakeRandomBadMeshDouble(100, 58);
  FlipOptions options;
  options.Backend = BackendKind::CUDA;
  options.Devices = { 0, 1000 };
  EXPECT_THROW(Flip(mesh.View(), options), BackendUnavailable);
  options.Devices = { 0, 1 };
  EXPECT_NO_THROW(Flip(mesh.View(), options));
}

}
}
