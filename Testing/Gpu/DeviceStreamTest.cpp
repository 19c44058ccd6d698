// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CudaError.h"
#include "FlipError.h"
#include "GpuTestSupport.h"
#include "TestDevice.h"

#include <cuda_runtime_api.h>

#include <chrono>
#include <thread>

/// @file
/// Device arrays and the caller's streams: calls of the engine come after what is in the stream,
/// and what they give is there when they return. And: calls of CUDA that fail.

namespace delaunayflip
{
namespace
{

using Arrays = DeviceArrays<double, std::int32_t>;

/// A stream whose work takes long to begin.
class SlowStream
{
public:
  SlowStream()
  {
    CallCuda("make a stream of a test",
      [&] { return cudaStreamCreateWithFlags(&this->Handle, cudaStreamNonBlocking); });
  }
  ~SlowStream() { cudaStreamDestroy(this->Handle); }
  SlowStream(const SlowStream&) = delete;
  SlowStream& operator=(const SlowStream&) = delete;

  DeviceStream Get() const { return { this->Handle }; }

  /// What follows in the stream waits.
  void Delay() const
  {
    const auto sleep = [](void*) { std::this_thread::sleep_for(std::chrono::milliseconds(200)); };
    CallCuda("delay a stream", [&] { return cudaLaunchHostFunc(this->Handle, sleep, nullptr); });
  }
  template <typename T>
  void Copy(const DeviceValues<T>& from, const DeviceValues<T>& to) const
  {
    CallCuda("copy for a test",
      [&]
      {
        return cudaMemcpyAsync(
          to.Data(), from.Data(), from.Size() * sizeof(T), cudaMemcpyDeviceToDevice, this->Handle);
      });
  }

private:
  cudaStream_t Handle = nullptr;
};

class DeviceStreamTest : public GpuTest
{
protected:
  /// The first use of the GPU would wait for all streams.
  void SetUp() override
  {
    GpuTest::SetUp();
    if (!this->IsSkipped())
    {
      const Arrays device(this->Mesh.View(), 3);
      FlipToDelaunay(device.View(), {}, device.ViewResult());
    }
  }

  OwnedMesh<double> Mesh = MakeRandomBadMeshDouble(2000, 81);
  std::vector<std::int32_t> Expected = Flip(this->Mesh.View()).Triangles;
};

TEST_F(DeviceStreamTest, TheMeshIsReadAfterTheCallersWork)
{
  for (const BackendKind backend : { BackendKind::Auto, BackendKind::Threads })
  {
    const Arrays device(this->Mesh.View(), 3);
    const DeviceValues<std::int32_t> triangles(device.Triangles.Get());
    device.Triangles.Set(std::vector<std::int32_t>(this->Mesh.Triangles.size(), -1));
    const SlowStream stream;
    stream.Delay();
    stream.Copy(triangles, device.Triangles);
    DeviceMesh mesh = device.View();
    mesh.Stream = stream.Get();
    FlipOptions options;
    options.Backend = backend;
    FlipToDelaunay(mesh, options, device.ViewResult());
    EXPECT_TRUE(this->Expected == device.Result.Get());
  }
}

TEST_F(DeviceStreamTest, ResultsAreWrittenAfterTheCallersWork)
{
  const Arrays device(this->Mesh.View(), 3);
  FlipSession session(device.View(), {});
  session.Advance();
  const DeviceValues<std::int32_t> seen(device.Triangles.Get());
  const SlowStream stream;
  stream.Delay();
  stream.Copy(device.Result, seen);
  session.StoreTriangles(device.ViewResult(), stream.Get());
  EXPECT_TRUE(this->Expected == device.Result.Get());
  EXPECT_EQ(std::vector<std::int32_t>(this->Mesh.Triangles.size(), 77), seen.Get());
}

TEST_F(DeviceStreamTest, TheCurrentDeviceAndItsErrorsStay)
{
  const Arrays device(this->Mesh.View(), 3);
  FlipToDelaunay(device.View(), {}, device.ViewResult());
  int current = -1;
  EXPECT_EQ(cudaSuccess, cudaGetDevice(&current));
  EXPECT_EQ(0, current);
  EXPECT_EQ(cudaSuccess, cudaPeekAtLastError());
}

TEST_F(DeviceStreamTest, ManagedMemoryIsDeviceMemory)
{
  const Arrays device(this->Mesh.View(), 3);
  void* managed = nullptr;
  const std::size_t bytes = this->Mesh.Points.size() * sizeof(double);
  ASSERT_EQ(cudaSuccess, cudaMallocManaged(&managed, bytes));
  ASSERT_EQ(cudaSuccess, cudaMemcpy(managed, this->Mesh.Points.data(), bytes, cudaMemcpyDefault));
  DeviceMesh mesh = device.View();
  mesh.Points = DevicePointArray(static_cast<double*>(managed), this->Mesh.NumberOfPoints());
  FlipToDelaunay(mesh, {}, device.ViewResult());
  EXPECT_TRUE(this->Expected == device.Result.Get());
  cudaFree(managed);
}

/// Each call fails once: the CPU takes over, or an error says why.
TEST_F(DeviceStreamTest, AnyCallMayFail)
{
  const Arrays device(this->Mesh.View(), 2);
  std::int64_t fallbacks = 0;
  std::int64_t errors = 0;
  for (std::int64_t call = 1;; ++call)
  {
    InjectCudaError(call, cudaErrorMemoryAllocation);
    try
    {
      const FlipReport report = FlipToDelaunay(device.View(), {}, device.ViewResult());
      InjectCudaError(0, cudaSuccess);
      ASSERT_TRUE(this->Expected == device.Result.Get()) << "call " << call;
      if (report.Fallback.empty())
      {
        break;
      }
      ++fallbacks;
    }
    catch (const BackendUnavailable&)
    {
      InjectCudaError(0, cudaSuccess);
      ++errors;
    }
    ReleaseCudaMemory();
  }
  EXPECT_LT(30, fallbacks);
  EXPECT_LT(0, errors); // where the arrays are must be known, whoever flips
  EXPECT_GT(5, errors);
}

}
}
