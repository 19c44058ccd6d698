// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CudaDevice.h"
#include "TestBackend.h"

#include <gtest/gtest.h>

/// @file
/// Linked into a test program: with DELAUNAYFLIP_TEST_BACKEND=cuda, but without a GPU, all its
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

}
}
