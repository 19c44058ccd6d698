// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "BufferFiller.h"

#include "DelaunayFlip.h"

#include "vtkDelaunayFlip.h"

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

/// Makes a device current in this thread for as long as it lives.
class CurrentGpu
{
public:
  explicit CurrentGpu(int device)
  {
    Require(cudaGetDevice(&this->Previous), "ask for the current device");
    Require(cudaSetDevice(device), "use the device");
  }
  ~CurrentGpu() { cudaSetDevice(this->Previous); }
  CurrentGpu(const CurrentGpu&) = delete;
  CurrentGpu& operator=(const CurrentGpu&) = delete;

private:
  int Previous = -1;
};

class CudaFiller : public BufferFiller
{
public:
  /// The buffer keeps what is not written. Of a context that is gone nothing can be released; that
  /// is no error.
  CudaFiller(int device, unsigned int buffer, std::int64_t triangles)
    : Device(device),
      Count(triangles)
  {
    cudaGraphicsResource_t resource = nullptr;
    Require(cudaGraphicsGLRegisterBuffer(&resource, buffer, cudaGraphicsRegisterFlagsNone),
      "register a buffer of OpenGL");
    this->Buffer.reset(resource,
      [](cudaGraphicsResource_t registered)
      {
        cudaGraphicsUnregisterResource(registered);
        cudaGetLastError();
      });
    void* memory = nullptr;
    Require(cudaMalloc(&memory, 4 * static_cast<std::size_t>(this->Count)), "allocate memory");
    this->Written.reset(static_cast<std::int32_t*>(memory), cudaFree);
  }
  ~CudaFiller() override
  {
    try
    {
      this->Unmap();
    }
    catch (const std::exception&)
    {
    }
  }

  void Map() override
  {
    if (!std::exchange(this->IsMapped, true))
    {
      this->Call(cudaGraphicsMapResources, "map a buffer of OpenGL");
    }
  }

  void Unmap() override
  {
    if (std::exchange(this->IsMapped, false))
    {
      this->Call(cudaGraphicsUnmapResources, "return a buffer to OpenGL");
    }
  }

  void Fill(const FlipSession& session, bool isNew) override
  {
    if (!IsOnGpu(session.GetReport().Backend))
    {
      throw std::runtime_error("the filter no longer works on the GPU");
    }
    const CurrentGpu current(this->Device);
    this->Map();
    void* memory = nullptr;
    std::size_t size = 0;
    Require(cudaGraphicsResourceGetMappedPointer(&memory, &size, this->Buffer.get()),
      "find the memory of a buffer of OpenGL");
    if (size < 12 * static_cast<std::size_t>(this->Count))
    {
      throw std::runtime_error("a buffer of OpenGL is smaller than the mesh");
    }
    if (isNew)
    {
      Require(cudaMemset(this->Written.get(), -1, 4 * static_cast<std::size_t>(this->Count)),
        "set memory");
    }
    session.StoreTriangles(MutableTriangleArray(static_cast<std::int32_t*>(memory), this->Count),
      {}, this->Written.get());
    this->Unmap();
  }

private:
  /// Maps or unmaps the buffer, in the default stream.
  template <typename Function>
  void Call(Function function, const char* action) const
  {
    const CurrentGpu current(this->Device);
    cudaGraphicsResource_t buffer = this->Buffer.get();
    Require(function(1, &buffer, nullptr), action);
  }

  int Device;
  std::int64_t Count;
  std::shared_ptr<cudaGraphicsResource> Buffer;
  std::shared_ptr<std::int32_t> Written; ///< For FlipSession::StoreTriangles.
  bool IsMapped = false;
};

#endif

}

FillerMaker DeviceFillerMaker = &MakeCudaFiller;

#ifdef DELAUNAYFLIP_HAS_CUDA
std::unique_ptr<BufferFiller> MakeCudaFiller(
  vtkDelaunayFlip* filter, unsigned int buffer, std::int64_t triangles)
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
  const CurrentGpu current(device);
  return std::make_unique<CudaFiller>(device, buffer, triangles);
}
#else
std::unique_ptr<BufferFiller> MakeCudaFiller(vtkDelaunayFlip*, unsigned int, std::int64_t)
{
  throw std::runtime_error("this build has no CUDA backend");
}
#endif

}
