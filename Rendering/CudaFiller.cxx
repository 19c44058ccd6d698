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
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

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

/// The devices of CUDA that draw the current context of OpenGL.
/// @throws std::runtime_error.
std::vector<int> ListDrawingDevices()
{
  std::array<int, 64> devices{};
  unsigned int count = 0;
  Require(cudaGLGetDevices(
            &count, devices.data(), static_cast<unsigned int>(devices.size()), cudaGLDeviceListAll),
    "find the GPU that OpenGL draws on");
  return std::vector<int>(devices.begin(), devices.begin() + count);
}

/// Registered buffers, and their memory while they are mapped.
class SharedBuffers
{
public:
  explicit SharedBuffers(const DrawnBuffers& buffers)
  {
    Require(cudaStreamCreateWithFlags(&this->Stream, cudaStreamNonBlocking), "make a stream");
    try
    {
      this->Add(buffers.Triangles, this->Both[0]);
      this->Add(buffers.Colors, this->Both[1]);
    }
    catch (...)
    {
      this->Close();
      throw;
    }
  }
  ~SharedBuffers() { this->Close(); }
  SharedBuffers(const SharedBuffers&) = delete;
  SharedBuffers& operator=(const SharedBuffers&) = delete;

  DeviceStream GetStream() const { return { this->Stream }; }

  void Map()
  {
    if (!this->AreMapped)
    {
      Require(cudaGraphicsMapResources(2, this->Both, this->Stream), "map the buffers of OpenGL");
      this->AreMapped = true;
    }
  }
  void Unmap()
  {
    if (std::exchange(this->AreMapped, false))
    {
      Require(
        cudaGraphicsUnmapResources(2, this->Both, this->Stream), "return the buffers to OpenGL");
    }
  }

  /// Only while they are mapped.
  std::int32_t* GetTriangles(std::int64_t count) const
  {
    return static_cast<std::int32_t*>(Get(this->Both[0], 12 * count));
  }
  std::uint32_t* GetColors(std::int64_t count) const
  {
    return static_cast<std::uint32_t*>(Get(this->Both[1], 4 * count));
  }

private:
  /// The buffer keeps what is not written.
  static void Add(unsigned int buffer, cudaGraphicsResource_t& resource)
  {
    Require(cudaGraphicsGLRegisterBuffer(&resource, buffer, cudaGraphicsRegisterFlagsNone),
      "register a buffer of OpenGL");
  }

  static void* Get(cudaGraphicsResource_t resource, std::int64_t bytes)
  {
    void* memory = nullptr;
    std::size_t size = 0;
    Require(cudaGraphicsResourceGetMappedPointer(&memory, &size, resource),
      "find the memory of a buffer of OpenGL");
    if (size < static_cast<std::size_t>(bytes))
    {
      throw std::runtime_error("a buffer of OpenGL is smaller than the mesh");
    }
    return memory;
  }

  /// Of a context that is gone nothing can be released; that is no error here.
  void Close() noexcept
  {
    if (this->AreMapped)
    {
      cudaGraphicsUnmapResources(2, this->Both, this->Stream);
    }
    for (cudaGraphicsResource_t resource : this->Both)
    {
      if (resource)
      {
        cudaGraphicsUnregisterResource(resource);
      }
    }
    cudaStreamDestroy(this->Stream);
    cudaGetLastError();
  }

  cudaStream_t Stream = nullptr;
  cudaGraphicsResource_t Both[2] = { nullptr, nullptr }; ///< Triangles, colours.
  bool AreMapped = false;
};

/// A copy of points in the memory of the current device.
class PointCopy
{
public:
  /// Memory for such points.
  explicit PointCopy(const PointArray& points)
    : Points(points)
  {
    Require(
      cudaMalloc(&this->Memory, std::max<std::size_t>(CountBytes(points), 1)), "allocate memory");
  }
  ~PointCopy()
  {
    cudaFree(this->Memory);
    cudaGetLastError();
  }
  PointCopy(const PointCopy&) = delete;
  PointCopy& operator=(const PointCopy&) = delete;

  bool Fits(const PointArray& points) const
  {
    return points.Count == this->Points.Count && !points.Floats == !this->Points.Floats;
  }

  void Write(const PointArray& points)
  {
    const void* host = points.Floats ? static_cast<const void*>(points.Floats) : points.Doubles;
    Require(
      cudaMemcpy(this->Memory, host, CountBytes(points), cudaMemcpyHostToDevice), "copy points");
  }

  DevicePointArray View() const
  {
    return this->Points.Floats
      ? DevicePointArray(static_cast<const float*>(this->Memory), this->Points.Count)
      : DevicePointArray(static_cast<const double*>(this->Memory), this->Points.Count);
  }

private:
  static std::size_t CountBytes(const PointArray& points)
  {
    return 3 * points.Count * (points.Floats ? sizeof(float) : sizeof(double));
  }

  PointArray Points;
  void* Memory = nullptr;
};

class CudaFiller : public BufferFiller
{
public:
  CudaFiller(int device, const DrawnBuffers& buffers)
    : Device(device),
      Count(buffers.Count),
      Buffers(buffers)
  {
  }

  void Map() override
  {
    const CurrentGpu current(this->Device);
    this->Buffers.Map();
  }

  void Unmap() override
  {
    const CurrentGpu current(this->Device);
    this->Buffers.Unmap();
  }

  void Fill(const FilledMesh& mesh) override
  {
    if (!IsOnGpu(mesh.Session->GetReport().Backend))
    {
      throw std::runtime_error("the filter no longer works on the GPU");
    }
    const CurrentGpu current(this->Device);
    this->CopyPoints(mesh);
    this->Buffers.Map();
    const DrawnArrays arrays{ this->Points->View(),
      MutableTriangleArray(this->Buffers.GetTriangles(this->Count), this->Count),
      this->Buffers.GetColors(this->Count), this->Buffers.GetStream() };
    this->Drawn.Update(*mesh.Session, arrays, mesh.Colors);
    this->Buffers.Unmap();
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
  void CopyPoints(const FilledMesh& mesh)
  {
    const bool fits = this->Points && this->Points->Fits(mesh.Points);
    if (fits && this->PointsTime == mesh.PointsTime)
    {
      return;
    }
    if (!fits)
    {
      this->Points = std::make_unique<PointCopy>(mesh.Points);
    }
    this->Points->Write(mesh.Points);
    this->PointsTime = mesh.PointsTime;
    this->Drawn.Forget();
  }

  int Device;
  std::int64_t Count;
  SharedBuffers Buffers;
  std::unique_ptr<PointCopy> Points;
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
  const std::vector<int> devices = ListDrawingDevices();
  if (std::count(devices.begin(), devices.end(), device) == 0)
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
