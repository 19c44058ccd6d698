// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_GPUTESTSUPPORT_H
#define DELAUNAYFLIP_GPUTESTSUPPORT_H

#include "CudaContext.h"
#include "CudaDevice.h"
#include "FlipTestSupport.h"

#include <gtest/gtest.h>

namespace delaunayflip
{

/// Its tests are skipped if there is no GPU.
class GpuTest : public testing::Test
{
protected:
  void SetUp() override
  {
    if (!HasCudaDevice())
    {
      GTEST_SKIP() << "no GPU";
    }
  }
  void TearDown() override { InjectCudaError(0, cudaSuccess); }
};

inline FlipOptions MakeOptions(BackendKind backend, GeometryKind geometry = GeometryKind::Auto)
{
  FlipOptions options;
  options.Backend = backend;
  options.Geometry = geometry;
  options.FeatureAngle = 180.0;
  return options;
}

inline bool IsOnGpu(const FlipReport& report) { return report.Backend.rfind("CUDA: ", 0) == 0; }

/// Reports a failure for every bit that differs.
inline void ExpectSameResult(const FlipResult& expected, const FlipResult& actual)
{
  EXPECT_TRUE(expected.Triangles == actual.Triangles);
  EXPECT_TRUE(expected.FlipCounts == actual.FlipCounts);
  ExpectSameStatistics(expected.Report, actual.Report);
  EXPECT_EQ(expected.Report.KeepsSliver, actual.Report.KeepsSliver);
}

/// Flips the mesh on the CPU and on the GPU, expects the same bits, and returns the GPU's result.
inline FlipResult ExpectGpuAgrees(const TriangleMesh& mesh, FlipOptions options)
{
  options.Backend = BackendKind::Threads;
  const FlipResult expected = Flip(mesh, options);
  options.Backend = BackendKind::CUDA;
  FlipResult actual = Flip(mesh, options);
  EXPECT_TRUE(IsOnGpu(actual.Report)) << actual.Report.Backend;
  ExpectSameResult(expected, actual);
  return actual;
}

}

#endif
