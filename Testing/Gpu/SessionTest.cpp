// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CudaContext.h"
#include "FlipError.h"
#include "GpuTestSupport.h"
#include "TestDevice.h"

#include <cuda_runtime_api.h>

#include <chrono>
#include <string>
#include <thread>

/// @file
/// Sessions on a GPU: device arrays and the caller's streams, iterations in batches, and calls of
/// CUDA that fail.

namespace delaunayflip
{
namespace
{

using Arrays = DeviceArrays<double, std::int32_t>;

/// A stream that takes long to begin its work.
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

/// Calls of the engine come after what is in the caller's stream, and what they give is there when
/// they return.
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
    FlipToDelaunay(mesh, OnBackend(backend), device.ViewResult());
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

/// Iterations are made in batches; an abort acts at the end of one.
class BatchTest : public GpuTest
{
protected:
  static constexpr std::int64_t LargestBatch = 128;

  FlipSession Start() const { return FlipSession(this->Mesh.View(), OnBackend(BackendKind::CUDA)); }

  /// Takes 797 iterations, several batches.
  OwnedMesh<double> Mesh = MakeWorstCaseMesh(400);
};

TEST_F(BatchTest, OnlyChangedTrianglesAreWritten)
{
  FlipSession session = this->Start();
  const std::int64_t count = this->Mesh.NumberOfTriangles();
  const std::vector<std::int32_t> none(3 * static_cast<std::size_t>(count), -1);
  const DeviceValues<std::int32_t> triangles(none);
  const DeviceValues<std::int32_t> written(std::vector<std::int32_t>(count, -1));
  const auto store = [&]
  {
    session.StoreTriangles(MutableTriangleArray(triangles.Data(), count), {}, written.Data());
    return triangles.Get();
  };
  for (const std::int64_t iterations : { 0, 1, 300, -1 })
  {
    session.Advance(iterations);
    EXPECT_EQ(StoreTriangles(session), store());
  }
  triangles.Set(none);
  EXPECT_EQ(none, store());
}

TEST_F(BatchTest, AnAbortActsAtItsEnd)
{
  FlipSession session = this->Start();
  std::int64_t calls = 0;
  EXPECT_FALSE(session.Advance(-1,
    [&](const IterationRecord& record)
    {
      EXPECT_EQ(++calls, record.Iteration);
      return record.Iteration < 3;
    }));
  const auto done = static_cast<std::int64_t>(session.GetReport().Iterations.size());
  EXPECT_EQ(StopReasonKind::Aborted, session.GetReport().StopReason);
  EXPECT_EQ(calls, done);
  EXPECT_LE(3, done);
  EXPECT_GE(3 + LargestBatch, done);
  EXPECT_LT(0, session.GetReport().NonDelaunayAfter);

  // The mesh and the statistics are those after `done` iterations, and the run can continue.
  FlipOptions options = OnBackend(BackendKind::Threads);
  options.MaximumIterations = done;
  EXPECT_TRUE(Flip(this->Mesh.View(), options).Triangles == StoreTriangles(session));
  EXPECT_FALSE(session.Advance());
  options.MaximumIterations = -1;
  const FlipResult complete = Flip(this->Mesh.View(), options);
  EXPECT_TRUE(complete.Triangles == StoreTriangles(session));
  EXPECT_EQ(complete.Report.TotalFlips, session.GetReport().TotalFlips);
  EXPECT_EQ(complete.Report.Iterations.size(), session.GetReport().Iterations.size());
  ExpectConsistentStatistics(session.GetReport());
}

/// Every call of the CUDA runtime fails once. The result is the right mesh from the CPU, or an
/// error that says why, and no memory leaks.
class FailureTest
  : public GpuTest
  , public testing::WithParamInterface<cudaError_t>
{
};

std::size_t GetFreeMemory()
{
  ReleaseCudaMemory();
  std::size_t free = 0;
  std::size_t total = 0;
  cudaMemGetInfo(&free, &total);
  return free;
}

TEST_P(FailureTest, AnyCallMayFail)
{
  const OwnedMesh<double> mesh = MakeRandomBadMeshDouble(40000, 31);
  const FlipOptions options;
  const FlipResult expected = Flip(mesh.View(), OnBackend(BackendKind::Threads));
  Flip(mesh.View(), options); // what the runtime loads at first is not a leak
  const std::size_t freeBefore = GetFreeMemory();
  std::int64_t failures = 0;
  for (std::int64_t call = 1;; ++call)
  {
    InjectCudaError(call, GetParam());
    const FlipResult result = Flip(mesh.View(), options);
    InjectCudaError(0, cudaSuccess);
    ASSERT_TRUE(expected.Triangles == result.Triangles) << "call " << call;
    ReleaseCudaMemory();
    if (result.Report.Fallback.empty())
    {
      EXPECT_TRUE(IsOnGpu(result.Report));
      break;
    }
    EXPECT_EQ(0u, result.Report.Backend.rfind("Threads: ", 0));
    EXPECT_NE(std::string::npos, result.Report.Fallback.find(cudaGetErrorString(GetParam())));
    ++failures;
  }
  EXPECT_LT(50, failures);
  EXPECT_LE(freeBefore, GetFreeMemory() + (std::size_t(4) << 20));
}

/// Memory that other runs have left is freed before the CPU takes over.
TEST_P(FailureTest, IdleMemoryIsFreedForARunThatLacksMemory)
{
  const OwnedMesh<double> mesh = MakeRandomBadMeshDouble(40000, 33);
  FlipOptions options;
  const FlipResult expected = Flip(mesh.View(), options);
  int successes = 0;
  for (std::int64_t call = 10; call < 50; ++call)
  {
    {
      const FlipSession one(mesh.View(), options);
      const FlipSession other(mesh.View(), options); // at the same time, so with memory of its own
    }
    InjectCudaError(call, GetParam());
    const FlipResult result = Flip(mesh.View(), options);
    InjectCudaError(0, cudaSuccess);
    ASSERT_TRUE(expected.Triangles == result.Triangles) << "call " << call;
    successes += result.Report.Fallback.empty() ? 1 : 0;
    ReleaseCudaMemory();
  }
  EXPECT_LT(5, successes);
  EXPECT_GT(40, successes); // a failure of another call has no remedy
}

TEST_P(FailureTest, ForcedCudaSaysWhy)
{
  const OwnedMesh<double> mesh = MakeRandomBadMeshDouble(1000, 32);
  InjectCudaError(5, GetParam());
  const std::string error =
    GetMessage<BackendUnavailable>([&] { Flip(mesh.View(), OnBackend(BackendKind::CUDA)); });
  EXPECT_NE(std::string::npos, error.find(cudaGetErrorString(GetParam()))) << error;
}

INSTANTIATE_TEST_SUITE_P(
  Errors, FailureTest, testing::Values(cudaErrorMemoryAllocation, cudaErrorLaunchFailure));

}
}
