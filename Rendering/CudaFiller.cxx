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

using Stream = std::shared_ptr<CUstream_st>;
using Resource = std::shared_ptr<cudaGraphicsResource>;

/// @throws std::runtime_error, as what follows.
Stream MakeStream()
{
  cudaStream_t stream = nullptr;
  Require(cudaStreamCreateWithFlags(&stream, cudaStreamNonBlocking), "make a stream");
  return Stream(stream, [](cudaStream_t made) { cudaStreamDestroy(made); });
}

/// The buffer keeps what is not written. Of a context that is gone nothing can be released; that is
/// no error.
Resource Register(unsigned int buffer)
{
  cudaGraphicsResource_t resource = nullptr;
  Require(cudaGraphicsGLRegisterBuffer(&resource, buffer, cudaGraphicsRegisterFlagsNone),
    "register a buffer of OpenGL");
  return Resource(resource,
    [](cudaGraphicsResource_t registered)
    {
      cudaGraphicsUnregisterResource(registered);
      cudaGetLastError();
    });
}

using Numbers = std::shared_ptr<std::int32_t>;

Numbers MakeNumbers(std::int64_t count)
{
  void* memory = nullptr;
  Require(cudaMalloc(&memory, 4 * static_cast<std::size_t>(count)), "allocate memory");
  return Numbers(static_cast<std::int32_t*>(memory), [](std::int32_t* made) { cudaFree(made); });
}

class CudaFiller : public BufferFiller
{
public:
  CudaFiller(int device, const TriangleBuffer& buffer)
    : Device(device),
      Count(buffer.Count),
      Buffer(Register(buffer.Name)),
      Written(MakeNumbers(buffer.Count))
  {
  }
  ~CudaFiller() override
  {
    if (this->IsMapped)
    {
      this->Call(cudaGraphicsUnmapResources);
      cudaGetLastError();
    }
  }

  void Map() override
  {
    if (!std::exchange(this->IsMapped, true))
    {
      const CurrentGpu current(this->Device);
      Require(this->Call(cudaGraphicsMapResources), "map a buffer of OpenGL");
    }
  }

  void Unmap() override
  {
    if (std::exchange(this->IsMapped, false))
    {
      const CurrentGpu current(this->Device);
      Require(this->Call(cudaGraphicsUnmapResources), "return a buffer to OpenGL");
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
      Require(cudaMemsetAsync(this->Written.get(), -1, 4 * static_cast<std::size_t>(this->Count),
                this->Queue.get()),
        "set memory");
    }
    session.StoreTriangles(MutableTriangleArray(static_cast<std::int32_t*>(memory), this->Count),
      { this->Queue.get() }, this->Written.get());
    this->Unmap();
  }

private:
  /// Maps or unmaps the buffer.
  template <typename Function>
  cudaError_t Call(Function function) const
  {
    cudaGraphicsResource_t buffer = this->Buffer.get();
    return function(1, &buffer, this->Queue.get());
  }

  int Device;
  std::int64_t Count;
  Stream Queue = MakeStream();
  Resource Buffer;
  Numbers Written; ///< For FlipSession::StoreTriangles.
  bool IsMapped = false;
};

#endif

}

FillerMaker DeviceFillerMaker = &MakeCudaFiller;

#ifdef DELAUNAYFLIP_HAS_CUDA
std::unique_ptr<BufferFiller> MakeCudaFiller(vtkDelaunayFlip* filter, const TriangleBuffer& buffer)
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
  return std::make_unique<CudaFiller>(device, buffer);
}
#else
std::unique_ptr<BufferFiller> MakeCudaFiller(vtkDelaunayFlip*, const TriangleBuffer&)
{
  throw std::runtime_error("this build has no CUDA backend");
}
#endif

}
