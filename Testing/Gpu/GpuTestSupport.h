// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_GPUTESTSUPPORT_H
#define DELAUNAYFLIP_GPUTESTSUPPORT_H

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
};

/// Flips the mesh on the CPU and on the GPU, reports a failure for every bit that differs, and
/// returns the GPU's result.
inline FlipResult ExpectGpuAgrees(const TriangleMesh& mesh, FlipOptions options)
{
  options.Backend = BackendKind::Threads;
  const FlipResult expected = Flip(mesh, options);
  options.Backend = BackendKind::CUDA;
  FlipResult actual = Flip(mesh, options);
  EXPECT_EQ(0u, actual.Report.Backend.rfind("CUDA: ", 0)) << actual.Report.Backend;
  EXPECT_TRUE(expected.Triangles == actual.Triangles);
  EXPECT_TRUE(expected.FlipCounts == actual.FlipCounts);
  ExpectSameStatistics(expected.Report, actual.Report);
  return actual;
}

}

#endif
