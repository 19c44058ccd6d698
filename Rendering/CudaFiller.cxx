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
#include <limits>
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

/// The memory of a mapped buffer.
void* GetMemory(const Resource& resource, std::int64_t bytes)
{
  void* memory = nullptr;
  std::size_t size = 0;
  Require(cudaGraphicsResourceGetMappedPointer(&memory, &size, resource.get()),
    "find the memory of a buffer of OpenGL");
  if (size < static_cast<std::size_t>(bytes))
  {
    throw std::runtime_error("a buffer of OpenGL is smaller than the mesh");
  }
  return memory;
}

class CudaFiller : public BufferFiller
{
public:
  CudaFiller(int device, const DrawnBuffers& buffers)
    : Device(device),
      Count(buffers.Count),
      Triangles(Register(buffers.Triangles)),
      Colors(Register(buffers.Colors))
  {
  }
  ~CudaFiller() override
  {
    if (this->AreMapped)
    {
      this->Call(cudaGraphicsUnmapResources);
      cudaGetLastError();
    }
  }

  void Map() override
  {
    if (!std::exchange(this->AreMapped, true))
    {
      const CurrentGpu current(this->Device);
      Require(this->Call(cudaGraphicsMapResources), "map the buffers of OpenGL");
    }
  }

  void Unmap() override
  {
    if (std::exchange(this->AreMapped, false))
    {
      const CurrentGpu current(this->Device);
      Require(this->Call(cudaGraphicsUnmapResources), "return the buffers to OpenGL");
    }
  }

  void Fill(const FilledMesh& mesh) override
  {
    if (!IsOnGpu(mesh.Session->GetReport().Backend))
    {
      throw std::runtime_error("the filter no longer works on the GPU");
    }
    const CurrentGpu current(this->Device);
    this->CopyPoints(mesh);
    this->Map();
    auto* triangles = static_cast<std::int32_t*>(GetMemory(this->Triangles, 12 * this->Count));
    auto* colors = static_cast<std::uint32_t*>(GetMemory(this->Colors, 4 * this->Count));
    const void* points = this->Points.get();
    this->Drawn.Update(*mesh.Session,
      { mesh.Points.Floats
          ? DevicePointArray(static_cast<const float*>(points), mesh.Points.Count)
          : DevicePointArray(static_cast<const double*>(points), mesh.Points.Count),
        MutableTriangleArray(triangles, this->Count), colors, { this->Queue.get() } },
      mesh.Colors);
    this->Unmap();
  }

  double GetSmallestAngle() noexcept override
  {
    try
    {
      return this->Drawn.GetSmallestAngle();
    }
    catch (const std::exception&) // the next call of Fill says why
    {
      return std::numeric_limits<double>::quiet_NaN();
    }
  }

private:
  /// Maps or unmaps the buffers.
  template <typename Function>
  cudaError_t Call(Function function) const
  {
    cudaGraphicsResource_t both[] = { this->Triangles.get(), this->Colors.get() };
    return function(2, both, this->Queue.get());
  }

  void CopyPoints(const FilledMesh& mesh)
  {
    const bool areFloats = mesh.Points.Floats != nullptr;
    const auto bytes = static_cast<std::size_t>(mesh.Points.Count) * (areFloats ? 12 : 24);
    if (std::exchange(this->PointsTime, mesh.PointsTime) == mesh.PointsTime)
    {
      return;
    }
    if (std::exchange(this->PointBytes, bytes) != bytes)
    {
      void* memory = nullptr;
      this->Points.reset();
      Require(cudaMalloc(&memory, bytes), "allocate memory");
      this->Points.reset(memory, [](void* allocated) { cudaFree(allocated); });
    }
    const void* host =
      areFloats ? static_cast<const void*>(mesh.Points.Floats) : mesh.Points.Doubles;
    Require(cudaMemcpy(this->Points.get(), host, bytes, cudaMemcpyHostToDevice), "copy points");
    this->Drawn.Forget();
  }

  int Device;
  std::int64_t Count;
  Stream Queue = MakeStream();
  Resource Triangles, Colors;
  bool AreMapped = false;
  std::shared_ptr<void> Points; ///< A copy in the memory of the GPU.
  std::size_t PointBytes = 0;
  std::uint64_t PointsTime = 0; ///< When they were copied.
  DrawnTriangles Drawn;
};

#endif

}

FillerMaker DeviceFillerMaker = &MakeCudaFiller;

#ifdef DELAUNAYFLIP_HAS_CUDA
std::unique_ptr<BufferFiller> MakeCudaFiller(vtkDelaunayFlip* filter, const DrawnBuffers& buffers)
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
  return std::make_unique<CudaFiller>(device, buffers);
}
#else
std::unique_ptr<BufferFiller> MakeCudaFiller(vtkDelaunayFlip*, const DrawnBuffers&)
{
  throw std::runtime_error("this build has no CUDA backend");
}
#endif

}
