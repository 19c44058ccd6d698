// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "DeviceMemory.h"
#include "FlipError.h"
#include "GpuTestSupport.h"
#include "PieceFlip.h"

#include <string>
#include <vector>

/// @file
/// Which GPU does the work, a mesh on two GPUs, and a mesh in pieces on one or two.

namespace delaunayflip
{
namespace
{

int CountDevices()
{
  int devices = 0;
  cudaGetDeviceCount(&devices);
  return devices;
}

class DeviceTest : public GpuTest
{
protected:
  void TearDown() override
  {
    ReleaseCudaMemory();
    cudaSetDevice(0);
  }

  OwnedMesh<double> Mesh = MakeRandomBadMeshDouble(50000, 61);
  FlipOptions Options = MakeOptions(BackendKind::Threads);
  FlipResult Expected = Flip(this->Mesh.View(), this->Options);
};

TEST_F(DeviceTest, AnyDeviceWorksWhicheverIsCurrent)
{
  this->Options.Backend = BackendKind::CUDA;
  for (int current = 0; current < CountDevices(); ++current)
  {
    for (int device = -1; device < CountDevices(); ++device)
    {
      ASSERT_EQ(cudaSuccess, cudaSetDevice(current));
      this->Options.Device = device;
      ExpectSameResult(this->Expected, Flip(this->Mesh.View(), this->Options));
      int after = -1;
      EXPECT_EQ(cudaSuccess, cudaGetDevice(&after));
      EXPECT_EQ(current, after);
      EXPECT_EQ(cudaSuccess, cudaPeekAtLastError());
    }
  }
}

TEST_F(DeviceTest, OneThatIsAbsentIsRefusedOrReplaced)
{
  this->Options.Backend = BackendKind::CUDA;
  this->Options.Device = CountDevices();
  EXPECT_THROW(Flip(this->Mesh.View(), this->Options), BackendUnavailable);
  const std::int64_t smallest = SmallestShare;
  SmallestShare = 1; // so that a small mesh is shared
  for (const int pieces : { 0, 5 })
  {
    FlipOptions several = MakeOptions(BackendKind::CUDA);
    several.Devices = { 0, 1000 };
    several.NumberOfPieces = pieces;
    EXPECT_THROW(Flip(this->Mesh.View(), several), FlipError);
  }
  SmallestShare = smallest;
  this->Options.Backend = BackendKind::Auto;
  const FlipResult result = Flip(this->Mesh.View(), this->Options);
  EXPECT_TRUE(this->Expected.Triangles == result.Triangles);
  EXPECT_EQ(0u, result.Report.Backend.rfind("Threads: ", 0));
  EXPECT_NE(std::string::npos, result.Report.Fallback.find("invalid device"))
    << result.Report.Fallback;
}

constexpr std::int64_t Points = 400000; ///< Enough for all launches to be shared.

class SharedMeshTest : public GpuTest
{
protected:
  void SetUp() override
  {
    this->GpuTest::SetUp();
    if (CountDevices() < 2)
    {
      GTEST_SKIP() << "one GPU only";
    }
    int isNative = 0;
    cudaDeviceGetP2PAttribute(&isNative, cudaDevP2PAttrNativeAtomicSupported, 0, 1);
    if (isNative == 0)
    {
      GTEST_SKIP() << "GPUs 0 and 1 cannot do atomic operations in each other's memory";
    }
    SmallestShare = 1;
  }
  void TearDown() override
  {
    GpuTest::TearDown();
    SmallestShare = this->Smallest;
  }

  static bool IsOnTwo(const FlipReport& report)
  {
    return report.Backend.rfind("CUDA: 2 x ", 0) == 0;
  }

  /// Flips on one GPU and on two.
  static void ExpectSame(const TriangleMesh& mesh, FlipOptions options = {})
  {
    options.Backend = BackendKind::CUDA;
    options.Device = 0;
    const FlipResult expected = Flip(mesh, options);
    options.Devices = { 0, 1 };
    const FlipResult actual = Flip(mesh, options);
    EXPECT_TRUE(IsOnTwo(actual.Report)) << actual.Report.Backend;
    EXPECT_LT(0, expected.Report.TotalFlips);
    ExpectSameResult(expected, actual);
  }

private:
  std::int64_t Smallest = SmallestShare;
};

TEST_F(SharedMeshTest, Plane)
{
  FlipOptions options;
  ExpectSame(MakeRandomBadMeshDouble(Points, 51).View(), options);
  options.TieRule = TieRuleKind::Canonical;
  ExpectSame(MakeTiledBadMesh(4 * Points, 5, 52).View(), options);
  ExpectSame(Transform(MakeGridMesh(700, 600), ScaleAndMove(3.0, 1e6)).View(), options);
  options.TieRule = TieRuleKind::Keep;
  options.Criterion = CriterionKind::OppositeAngles;
  ExpectSame(MakeRandomBadMeshDouble(Points, 53).View(), options);
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
  TriangleMesh view = WithConstraints(mesh.View(), edges);
  view.Regions = regions.data();
  ExpectSame(view);
}

TEST_F(SharedMeshTest, SmallMeshes)
{
  FlipOptions options = OnBackend(BackendKind::CUDA);
  for (const std::int64_t points : { 3, 50, 5000 })
  {
    const OwnedMesh<double> mesh = MakeRandomBadMeshDouble(points, 56);
    options.Devices = {};
    const FlipResult expected = Flip(mesh.View(), options);
    options.Devices = { 1, 0 };
    EXPECT_TRUE(expected.Triangles == Flip(mesh.View(), options).Triangles) << points;
  }
  const OwnedMesh<double> mesh = MakeRandomBadMeshDouble(50000, 59);
  SmallestShare = mesh.NumberOfTriangles() / 2;
  EXPECT_TRUE(IsOnTwo(Flip(mesh.View(), options).Report));
  SmallestShare = mesh.NumberOfTriangles() / 2 + 1;
  EXPECT_FALSE(IsOnTwo(Flip(mesh.View(), options).Report));
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

class PiecesTest : public GpuTest
{
protected:
  static std::vector<std::int32_t> FlipPieces(const TriangleMesh& mesh, FlipOptions options,
    const std::vector<int>& devices, PiecesReport& report)
  {
    options.NumberOfPieces = 5;
    options.Devices = devices;
    std::vector<std::int32_t> triangles(3 * mesh.Triangles.Count);
    report =
      FlipInPieces(mesh, options, MutableTriangleArray(triangles.data(), mesh.Triangles.Count));
    return triangles;
  }

  /// Expects the bits that threads make of the same pieces, which take turns on a GPU or are on
  /// two.
  static std::vector<std::int32_t> ExpectSameAsThreads(
    const TriangleMesh& mesh, FlipOptions options)
  {
    PiecesReport report;
    options.Backend = BackendKind::Threads;
    std::vector<std::int32_t> expected = FlipPieces(mesh, options, {}, report);
    options.Backend = BackendKind::CUDA;
    std::vector<int> devices;
    for (int device = 0; device < std::min(2, CountDevices()); ++device)
    {
      devices.push_back(device);
      PiecesReport onDevice;
      EXPECT_EQ(expected, FlipPieces(mesh, options, devices, onDevice));
      EXPECT_TRUE(IsOnGpu(onDevice)) << onDevice.Backend;
      EXPECT_EQ(report.TotalFlips, onDevice.TotalFlips);
      EXPECT_EQ(report.Rounds, onDevice.Rounds);
      EXPECT_EQ(report.Edges.Fixed, onDevice.Edges.Fixed);
      EXPECT_EQ(report.NonDelaunayBefore, onDevice.NonDelaunayBefore);
      EXPECT_EQ(report.NonDelaunayAfter, onDevice.NonDelaunayAfter);
    }
    return expected;
  }
};

TEST_F(PiecesTest, AgreeWithThreads)
{
  const OwnedMesh<float> mesh = MakeRandomBadMesh(200000, 1);
  FlipOptions options;
  options.TieRule = TieRuleKind::Canonical;
  const std::vector<std::int32_t> together = ExpectSameAsThreads(mesh.View(), options);
  EXPECT_EQ(ToTriangleSet(Flip(mesh.View(), options).Triangles), ToTriangleSet(together));
  ExpectSameAsThreads(MakeBadSphere(400, 200, 2).View(), {}); // with features
}

}
}
