// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// What drawing without copies takes for granted about CUDA and OpenGL on one GPU.

#include "TestBackend.h"
#include "TestWindow.h"

#include "vtk_glew.h"

#include <cuda_runtime_api.h>
// After the runtime's:
#include <cuda_gl_interop.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace
{

class Interop : public testing::Test
{
protected:
  void SetUp() override
  {
    if (!delaunayflip::IsTestBackendCuda())
    {
      GTEST_SKIP() << "no GPU of CUDA";
    }
    this->Window = MakeTestWindow();
    this->Window->SetSize(64, 64);
    this->Window->Render(); // loads the functions of OpenGL
    glGenBuffers(1, &this->Buffer);
    glBindBuffer(GL_ARRAY_BUFFER, this->Buffer);
    glBufferData(GL_ARRAY_BUFFER, Bytes, nullptr, GL_STATIC_DRAW);
    glBindBuffer(GL_ARRAY_BUFFER, 0);
  }
  void TearDown() override
  {
    if (this->Buffer)
    {
      glDeleteBuffers(1, &this->Buffer);
    }
  }

  std::vector<unsigned char> ReadBuffer() const
  {
    std::vector<unsigned char> bytes(Bytes);
    glBindBuffer(GL_ARRAY_BUFFER, this->Buffer);
    glGetBufferSubData(GL_ARRAY_BUFFER, 0, Bytes, bytes.data());
    glBindBuffer(GL_ARRAY_BUFFER, 0);
    return bytes;
  }

  static constexpr int Bytes = 1 << 20;
  vtkSmartPointer<vtkRenderWindow> Window;
  unsigned int Buffer = 0;
};

}

TEST_F(Interop, CudaNamesTheDeviceOfTheContext)
{
  unsigned int count = 0;
  int devices[8] = {};
  const cudaError_t error = cudaGLGetDevices(&count, devices, 8, cudaGLDeviceListAll);
  EXPECT_EQ(cudaSuccess, error) << cudaGetErrorString(error);
  ASSERT_GE(count, 1u);
  EXPECT_EQ(0, devices[0]);
}

TEST_F(Interop, MappedBuffersAreMemoryOfTheDevice)
{
  cudaGraphicsResource_t resource = nullptr;
  cudaError_t error =
    cudaGraphicsGLRegisterBuffer(&resource, this->Buffer, cudaGraphicsRegisterFlagsNone);
  ASSERT_EQ(cudaSuccess, error) << cudaGetErrorString(error);
  ASSERT_EQ(cudaSuccess, cudaGraphicsMapResources(1, &resource, nullptr));
  void* memory = nullptr;
  std::size_t size = 0;
  ASSERT_EQ(cudaSuccess, cudaGraphicsResourceGetMappedPointer(&memory, &size, resource));
  EXPECT_EQ(std::size_t(Bytes), size);
  cudaPointerAttributes attributes = {};
  error = cudaPointerGetAttributes(&attributes, memory);
  EXPECT_EQ(cudaSuccess, error) << cudaGetErrorString(error);
  EXPECT_EQ(cudaMemoryTypeDevice, attributes.type);
  EXPECT_EQ(0, attributes.device);
  EXPECT_EQ(cudaSuccess, cudaMemset(memory, 7, Bytes));
  EXPECT_EQ(cudaSuccess, cudaGraphicsUnmapResources(1, &resource, nullptr));
  EXPECT_EQ(cudaSuccess, cudaGraphicsUnregisterResource(resource));
  EXPECT_EQ(std::vector<unsigned char>(Bytes, 7), this->ReadBuffer());
}

TEST_F(Interop, MappedBuffersKeepWhatIsNotWritten)
{
  cudaGraphicsResource_t resource = nullptr;
  ASSERT_EQ(cudaSuccess,
    cudaGraphicsGLRegisterBuffer(&resource, this->Buffer, cudaGraphicsRegisterFlagsNone));
  for (const int size : { Bytes, Bytes / 2, Bytes / 4 })
  {
    ASSERT_EQ(cudaSuccess, cudaGraphicsMapResources(1, &resource, nullptr));
    void* memory = nullptr;
    std::size_t all = 0;
    ASSERT_EQ(cudaSuccess, cudaGraphicsResourceGetMappedPointer(&memory, &all, resource));
    EXPECT_EQ(cudaSuccess, cudaMemset(memory, Bytes / size, size));
    EXPECT_EQ(cudaSuccess, cudaGraphicsUnmapResources(1, &resource, nullptr));
    this->Window->Render();
  }
  EXPECT_EQ(cudaSuccess, cudaGraphicsUnregisterResource(resource));
  std::vector<unsigned char> expected(Bytes, 1);
  std::fill_n(expected.begin(), Bytes / 2, 2);
  std::fill_n(expected.begin(), Bytes / 4, 4);
  EXPECT_EQ(expected, this->ReadBuffer());
}

TEST_F(Interop, ABufferThatIsNotThereCannotBeRegistered)
{
  cudaGraphicsResource_t resource = nullptr;
  EXPECT_NE(cudaSuccess,
    cudaGraphicsGLRegisterBuffer(&resource, 4000000000u, cudaGraphicsRegisterFlagsWriteDiscard));
  cudaGetLastError();
}
