// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "BufferFiller.h"

#include "DelaunayFlip.h"

#include "vtkDelaunayFlipAlgorithm.h"

#ifdef DELAUNAYFLIP_HAS_CUDA
#include <cuda_runtime_api.h>
// After the runtime's:
#include <cuda_gl_interop.h>
#endif

#include <algorithm>
#include <array>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

namespace delaunayflip
{

namespace
{

#ifdef DELAUNAYFLIP_HAS_CUDA

/// @throws std::runtime_error.
void Require(cudaError_t error, const char* action)
{
  if (error != cudaSuccess)
  {
    cudaGetLastError(); // so that no other code sees it
    throw std::runtime_error(
      std::string("CUDA could not ") + action + ": " + cudaGetErrorString(error));
  }
}

bool IsOnGpu(const std::string& backend) { return backend.rfind("CUDA", 0) == 0; }

/// Makes a device current in this thread for as long as it lives. Where that fails, so does what
/// follows.
class CurrentGpu
{
public:
  explicit CurrentGpu(int device)
  {
    cudaGetDevice(&this->Previous);
    cudaSetDevice(device);
  }
  ~CurrentGpu() { cudaSetDevice(this->Previous); }
  CurrentGpu(const CurrentGpu&) = delete;
  CurrentGpu& operator=(const CurrentGpu&) = delete;

private:
  int Previous = 0;
};

class CudaFiller : public BufferFiller
{
public:
  CudaFiller(int device, unsigned int buffer)
    : Device(device)
  {
    const CurrentGpu current(device);
    Require(cudaGraphicsGLRegisterBuffer(&this->Buffer, buffer, cudaGraphicsRegisterFlagsNone),
      "register a buffer of OpenGL");
  }
  /// If the context is gone, nothing can be released, and that is no error.
  ~CudaFiller() override
  {
    const CurrentGpu current(this->Device);
    if (this->IsMapped)
    {
      cudaGraphicsUnmapResources(1, &this->Buffer, nullptr);
    }
    cudaGraphicsUnregisterResource(this->Buffer);
    cudaGetLastError();
  }

  void Map() override
  {
    if (!std::exchange(this->IsMapped, true))
    {
      const CurrentGpu current(this->Device);
      Require(cudaGraphicsMapResources(1, &this->Buffer, nullptr), "map a buffer of OpenGL");
    }
  }

  void Unmap() override
  {
    if (std::exchange(this->IsMapped, false))
    {
      const CurrentGpu current(this->Device);
      Require(cudaGraphicsUnmapResources(1, &this->Buffer, nullptr), "return a buffer to OpenGL");
    }
  }

  void Fill(const FlipSession& session, bool isNew) override
  {
    if (!IsOnGpu(session.GetReport().Backend))
    {
      throw std::runtime_error("the filter no longer works on the GPU");
    }
    this->Map();
    const CurrentGpu current(this->Device);
    void* memory = nullptr;
    std::size_t size = 0;
    Require(cudaGraphicsResourceGetMappedPointer(&memory, &size, this->Buffer),
      "find the memory of a buffer of OpenGL");
    const MutableTriangleArray triangles(
      static_cast<std::int32_t*>(memory), session.GetReport().Triangles);
    if (size < 12 * static_cast<std::size_t>(triangles.Count))
    {
      throw std::runtime_error("a buffer of OpenGL is smaller than the mesh");
    }
    size /= 3; // from three ids of a triangle to one
    if (!this->Written)
    {
      Require(cudaMalloc(&memory, size), "allocate memory");
      this->Written.reset(static_cast<std::int32_t*>(memory), cudaFree);
    }
    if (isNew)
    {
      Require(cudaMemset(this->Written.get(), -1, size), "set memory");
    }
    session.StoreTriangles(triangles, {}, this->Written.get());
    this->Unmap();
  }

private:
  int Device;
  cudaGraphicsResource_t Buffer = nullptr;
  std::shared_ptr<std::int32_t> Written; ///< For FlipSession::StoreTriangles.
  bool IsMapped = false;
};

#endif

}

FillerMaker DeviceFillerMaker = &MakeCudaFiller;

#ifdef DELAUNAYFLIP_HAS_CUDA
std::unique_ptr<BufferFiller> MakeCudaFiller(vtkDelaunayFlipAlgorithm* filter, unsigned int buffer)
{
  if (!IsOnGpu(filter->GetBackendUsed()))
  {
    throw std::runtime_error("the filter works on CPU threads");
  }
  int device = filter->GetDeviceId();
  if (device < 0)
  {
    Require(cudaGetDevice(&device), "ask for the current device");
  }
  std::array<int, 64> devices{};
  unsigned int count = 0;
  Require(cudaGLGetDevices(
            &count, devices.data(), static_cast<unsigned int>(devices.size()), cudaGLDeviceListAll),
    "find the GPU that OpenGL draws on");
  if (std::count(devices.begin(), devices.begin() + count, device) == 0)
  {
    throw std::runtime_error("OpenGL does not draw on the GPU of the filter");
  }
  return std::make_unique<CudaFiller>(device, buffer);
}
#else
std::unique_ptr<BufferFiller> MakeCudaFiller(vtkDelaunayFlipAlgorithm*, unsigned int)
{
  throw std::runtime_error("this build has no CUDA backend");
}
#endif

}
