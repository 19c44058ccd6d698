// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FlipError.h"
#include "FlipTestSupport.h"
#include "GpuTestSupport.h"
#include "PieceFlip.h"

#include <gtest/gtest.h>

#include <cuda_runtime_api.h>

#include <vector>

/// @file
/// FlipInPieces on GPUs: pieces that take turns on one, and pieces on two.

namespace delaunayflip
{
namespace
{

class PiecesTest : public GpuTest
{
protected:
  /// The first GPU, and the first two if there are two.
  static std::vector<std::vector<int>> ListDevices()
  {
    int devices = 0;
    cudaGetDeviceCount(&devices);
    return devices < 2 ? std::vector<std::vector<int>>{ { 0 } }
                       : std::vector<std::vector<int>>{ { 0 }, { 0, 1 } };
  }

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

  /// Expects the bits that threads make of the same pieces.
  static std::vector<std::int32_t> ExpectSameAsThreads(
    const TriangleMesh& mesh, FlipOptions options)
  {
    PiecesReport report;
    options.Backend = BackendKind::Threads;
    std::vector<std::int32_t> expected = FlipPieces(mesh, options, {}, report);
    options.Backend = BackendKind::CUDA;
    for (const std::vector<int>& devices : ListDevices())
    {
      PiecesReport onDevice;
      EXPECT_EQ(expected, FlipPieces(mesh, options, devices, onDevice));
      EXPECT_EQ(0u, onDevice.Backend.find("CUDA: ")) << onDevice.Backend;
      EXPECT_EQ(report.TotalFlips, onDevice.TotalFlips);
      EXPECT_EQ(report.Rounds, onDevice.Rounds);
      EXPECT_EQ(report.Edges.Fixed, onDevice.Edges.Fixed);
      EXPECT_EQ(report.NonDelaunayBefore, onDevice.NonDelaunayBefore);
      EXPECT_EQ(report.NonDelaunayAfter, onDevice.NonDelaunayAfter);
    }
    return expected;
  }
};

TEST_F(PiecesTest, RandomMesh)
{
  const OwnedMesh<float> mesh = MakeRandomBadMesh(200000, 1);
  FlipOptions options;
  options.TieRule = TieRuleKind::Canonical;
  const std::vector<std::int32_t> together = ExpectSameAsThreads(mesh.View(), options);
  EXPECT_EQ(ToTriangleSet(Flip(mesh.View(), options).Triangles), ToTriangleSet(together));
}

TEST_F(PiecesTest, SurfaceWithFeatures)
{
  ExpectSameAsThreads(MakeBadSphere(400, 200, 2).View(), {});
}

TEST_F(PiecesTest, AGpuThatDoesNotExist)
{
  const OwnedMesh<float> mesh = MakeRandomBadMesh(1000, 3);
  FlipOptions options;
  options.Backend = BackendKind::CUDA;
  PiecesReport report;
  EXPECT_THROW(FlipPieces(mesh.View(), options, { 0, 999 }, report), FlipError);
}

}
}
