// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CudaDevice.h"
#include "CudaError.h"
#include "FlipTestSupport.h"

#include <gtest/gtest.h>

/// @file
/// Every call of the CUDA runtime fails once. The result is the right mesh from the CPU, or an
/// error that says why, and no memory leaks.

namespace delaunayflip
{
namespace
{

class FailureTest : public testing::TestWithParam<cudaError_t>
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

std::size_t GetFreeMemory()
{
  ReleaseCudaMemory();
  std::size_t free = 0;
  std::size_t total = 0;
  cudaMemGetInfo(&free, &total);
  return free;
}

TEST_P(FailureTest, AnyCallMayFail)
{
  const OwnedMesh<double> mesh = MakeRandomBadMeshDouble(40000, 31);
  FlipOptions options;
  options.Backend = BackendKind::Threads;
  const FlipResult expected = Flip(mesh.View(), options);
  options.Backend = BackendKind::Auto;
  Flip(mesh.View(), options); // what the runtime loads at first is not a leak
  const std::size_t freeBefore = GetFreeMemory();
  std::int64_t failures = 0;
  for (std::int64_t call = 1;; ++call)
  {
    InjectCudaError(call, GetParam());
    const FlipResult result = Flip(mesh.View(), options);
    InjectCudaError(0, cudaSuccess);
    ASSERT_TRUE(expected.Triangles == result.Triangles) << "call " << call;
    ReleaseCudaMemory();
    if (result.Report.Fallback.empty())
    {
      EXPECT_EQ(0u, result.Report.Backend.rfind("CUDA: ", 0));
      break;
    }
    EXPECT_EQ(0u, result.Report.Backend.rfind("Threads: ", 0));
    EXPECT_NE(std::string::npos, result.Report.Fallback.find(cudaGetErrorString(GetParam())));
    ++failures;
  }
  EXPECT_LT(50, failures);
  EXPECT_LE(freeBefore, GetFreeMemory() + (std::size_t(4) << 20));
}

/// Memory that other runs have left is freed before the CPU takes over.
TEST_P(FailureTest, IdleMemoryIsFreedForARunThatLacksMemory)
{
  const OwnedMesh<double> mesh = MakeRandomBadMeshDouble(40000, 33);
  FlipOptions options;
  const FlipResult expected = Flip(mesh.View(), options);
  int successes = 0;
  for (std::int64_t call = 10; call < 50; ++call)
  {
    {
      const FlipSession one(mesh.View(), options);
      const FlipSession other(mesh.View(), options); // at the same time, so with memory of its own
    }
    InjectCudaError(call, GetParam());
    const FlipResult result = Flip(mesh.View(), options);
    InjectCudaError(0, cudaSuccess);
    ASSERT_TRUE(expected.Triangles == result.Triangles) << "call " << call;
    successes += result.Report.Fallback.empty() ? 1 : 0;
    ReleaseCudaMemory();
  }
  EXPECT_LT(5, successes);
  EXPECT_GT(40, successes); // a failure of another call has no remedy
}

TEST_P(FailureTest, ForcedCudaSaysWhy)
{
  const OwnedMesh<double> mesh = MakeRandomBadMeshDouble(1000, 32);
  FlipOptions options;
  options.Backend = BackendKind::CUDA;
  InjectCudaError(5, GetParam());
  try
  {
    Flip(mesh.View(), options);
    FAIL() << "no error";
  }
  catch (const BackendUnavailable& error)
  {
    EXPECT_NE(std::string::npos, std::string(error.what()).find(cudaGetErrorString(GetParam())))
      << error.what();
  }
}

INSTANTIATE_TEST_SUITE_P(
  Errors, FailureTest, testing::Values(cudaErrorMemoryAllocation, cudaErrorLaunchFailure));

}
}
