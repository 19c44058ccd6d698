// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CudaDevice.h"
#include "FlipTestSupport.h"

#include <gtest/gtest.h>

/// @file
/// With DELAUNAYFLIP_TEST_BACKEND=cuda this whole program tests the GPU. If there is none, all
/// tests are skipped, instead of passing on the CPU.

namespace delaunayflip
{
namespace
{

/// Skips the tests one by one: if an environment skipped all, they would be reported as passed.
class GpuOrNothing : public testing::EmptyTestEventListener
{
public:
  void OnTestStart(const testing::TestInfo&) override
  {
    if (this->IsGpuMissing)
    {
      GTEST_SKIP() << "no GPU for DELAUNAYFLIP_TEST_BACKEND=cuda";
    }
  }

private:
  const bool IsGpuMissing = IsTestBackendCuda() && !HasCudaDevice();
};

const bool IsRegistered = []
{
  testing::UnitTest::GetInstance()->listeners().Append(new GpuOrNothing);
  return true;
}();

TEST(TestBackend, IsTheRequestedOne)
{
  const OwnedMesh<double> mesh = MakeRandomBadMeshDouble(100, 1);
  const std::string expected = IsTestBackendCuda() ? "CUDA: " : "Threads: ";
  EXPECT_EQ(0u, Flip(mesh.View()).Report.Backend.rfind(expected, 0));
  EXPECT_EQ(0u, MakeSession(mesh.View()).GetReport().Backend.rfind(expected, 0));
}

}
}
