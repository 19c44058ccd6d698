// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CudaDevice.h"
#include "FlipError.h"
#include "FlipTestSupport.h"

#include <cuda_runtime_api.h>
#include <gtest/gtest.h>

#include <string>

/// @file
/// FlipOptions::Device: which GPU does the work, regardless of the current one.

namespace delaunayflip
{
namespace
{

class DeviceTest : public testing::Test
{
protected:
  void SetUp() override
  {
    if (!HasCudaDevice())
    {
      GTEST_SKIP() << "no GPU";
    }
    ASSERT_EQ(cudaSuccess, cudaGetDeviceCount(&this->NumberOfDevices));
    this->Options.Backend = BackendKind::Threads;
    this->Expected = Flip(this->Mesh.View(), this->Options);
    this->Options.Backend = BackendKind::CUDA;
  }
  void TearDown() override
  {
    ReleaseCudaMemory();
    cudaSetDevice(0);
  }

  int NumberOfDevices = 0;
  OwnedMesh<double> Mesh = MakeRandomBadMeshDouble(50000, 61);
  FlipOptions Options;
  FlipResult Expected;
};

TEST_F(DeviceTest, AnyDeviceWorksWhicheverIsCurrent)
{
  for (int current = 0; current < this->NumberOfDevices; ++current)
  {
    for (int device = -1; device < this->NumberOfDevices; ++device)
    {
      ASSERT_EQ(cudaSuccess, cudaSetDevice(current));
      this->Options.Device = device;
      const FlipResult result = Flip(this->Mesh.View(), this->Options);
      EXPECT_TRUE(this->Expected.Triangles == result.Triangles) << device;
      EXPECT_TRUE(this->Expected.FlipCounts == result.FlipCounts) << device;
      int after = -1;
      EXPECT_EQ(cudaSuccess, cudaGetDevice(&after));
      EXPECT_EQ(current, after);
      EXPECT_EQ(cudaSuccess, cudaPeekAtLastError());
    }
  }
}

TEST_F(DeviceTest, OneThatIsAbsentIsRefusedOrReplaced)
{
  this->Options.Device = this->NumberOfDevices;
  EXPECT_THROW(Flip(this->Mesh.View(), this->Options), BackendUnavailable);
  this->Options.Backend = BackendKind::Auto;
  const FlipResult result = Flip(this->Mesh.View(), this->Options);
  EXPECT_TRUE(this->Expected.Triangles == result.Triangles);
  EXPECT_EQ(0u, result.Report.Backend.rfind("Threads: ", 0));
  EXPECT_NE(std::string::npos, result.Report.Fallback.find("invalid device"))
    << result.Report.Fallback;
}

}
}
