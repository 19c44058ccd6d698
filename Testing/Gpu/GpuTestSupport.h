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
  FlipOptions options = OnBackend(backend);
  options.Geometry = geometry;
  options.FeatureAngle = 180.0;
  return options;
}

inline bool IsOnGpu(const FlipReport& report) { return report.Backend.rfind("CUDA: ", 0) == 0; }

/// Flips the mesh on the CPU and on the GPU, expects the same bits, and returns the GPU's result.
inline FlipResult ExpectGpuAgrees(const TriangleMesh& mesh, const FlipOptions& options)
{
  const FlipResult expected = Flip(mesh, OnBackend(BackendKind::Threads, options));
  FlipResult actual = Flip(mesh, OnBackend(BackendKind::CUDA, options));
  EXPECT_TRUE(IsOnGpu(actual.Report)) << actual.Report.Backend;
  ExpectSameResult(expected, actual);
  return actual;
}

}

#endif
