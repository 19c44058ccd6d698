// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_CUDACONTEXT_H
#define DELAUNAYFLIP_CUDACONTEXT_H

#include "Array.h"
#include "DeviceMemory.h"
#include "LoadedMesh.h"

#include <cuda_runtime_api.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace delaunayflip
{

// Errors of the CUDA runtime as exceptions.

/// Throws a BackendUnavailable that says what was tried and why it failed. Clears the runtime's
/// last error, so that no other code sees it.
[[noreturn]] void ThrowCudaError(cudaError_t error, const char* action);

/// Whether a driver is installed, of any version. Never throws.
bool HasCudaDriver();

/// For tests: the `calls`-th call of CallCuda from now on (1: the next) is not made but fails with
/// `error`; 0 cancels this.
void InjectCudaError(std::int64_t calls, cudaError_t error);

/// Counts a call. @returns the error that it must fail with, or cudaSuccess.
cudaError_t BeginCudaCall();

/// Makes a call of the CUDA runtime: of one of its functions with arguments, or of a function that
/// launches a kernel and returns cudaGetLastError().
/// @param action what it does, for the message, e.g. "allocate memory".
/// @throws BackendUnavailable.
template <typename Call, typename... Arguments>
void CallCuda(const char* action, const Call& call, const Arguments&... arguments)
{
  const cudaError_t injected = BeginCudaCall();
  const cudaError_t error = injected == cudaSuccess ? call(arguments...) : injected;
  if (error != cudaSuccess)
  {
    ThrowCudaError(error, action);
  }
}

//------------------------------------------------------------------------------

/// What the CUDA runtime has made, owned.
template <typename T, cudaError_t (*Destroy)(T*)>
class CudaOwner
{
public:
  CudaOwner() = default;
  explicit CudaOwner(T* made)
    : Made(made)
  {
  }
  T* Get() const { return this->Made.get(); }
  operator T*() const { return this->Made.get(); } // NOLINT(google-explicit-constructor)

private:
  struct Deleter
  {
    void operator()(T* made) const noexcept
    {
      Destroy(made);
      cudaGetLastError(); // there is no caller to report to
    }
  };

  std::unique_ptr<T, Deleter> Made;
};
using CudaStream = CudaOwner<CUstream_st, cudaStreamDestroy>;
using CudaEvent = CudaOwner<CUevent_st, cudaEventDestroy>;
using PageLocked = CudaOwner<void, cudaFreeHost>;

/// A GPU of a context, and its stream.
struct DeviceStreams
{
  int Device;
  CudaStream Stream;
  CudaEvent Done; ///< What is in the stream so far.
};

/// Page-locked memory of the host, and the stream of a GPU that copies to it and from it.
struct StagingBuffer
{
  cudaStream_t Stream;
  PageLocked Memory; ///< None before it is used.
  CudaEvent Done; ///< The last copy.
};

/// What a run needs besides its mesh: a stream, memory, and page-locked buffers for copies between
/// host and device. One run at a time uses a context; then it is kept for the next run.
///
/// With several GPUs the first has the stream that gives all work its order. The others take part
/// in single launches: they wait for what is in that stream, and it waits for them.
class CudaContext
{
public:
  static constexpr int StagingSlots = 4; ///< The number of buffers per GPU.
  static constexpr std::size_t StagingBytes = std::size_t(8) << 20; ///< The size of one.

  /// @param devices one GPU, or several that share the memory of arrays.
  /// @throws BackendUnavailable.
  explicit CudaContext(const std::vector<int>& devices);
  ~CudaContext();
  CudaContext(const CudaContext&) = delete;
  CudaContext& operator=(const CudaContext&) = delete;

  /// The buffer for copy number i: all buffers are used, one after the other. Their memory is
  /// allocated when it is needed, because that takes milliseconds.
  const StagingBuffer& GetBuffer(std::int64_t i);
  std::int64_t CountBuffers() const { return static_cast<std::int64_t>(this->Staging.size()); }

  /// Page-locked memory for a small result, which kernels can write. A copy to it takes half the
  /// time of one to ordinary memory.
  void* GetResult() const { return this->Result.Get(); }
  static constexpr std::size_t ResultBytes = 4096;

  /// Where arrays are.
  Memory& GetMemory() const;

  /// The most bytes that were in use on the devices at any time since the last call.
  std::size_t TakePeak();

  /// Lets the work that follows in a stream wait for what is in another one so far.
  /// @param event of the other one's GPU.
  static void LetWait(cudaStream_t stream, cudaStream_t other, cudaEvent_t event);

  /// Lets the other GPUs wait for the stream.
  void Fork() const;
  /// Lets the stream wait for the other GPUs.
  void Join() const;

  std::vector<int> Devices; ///< The GPUs, in order.
  int Device; ///< The first one.
  std::string Name; ///< E.g. "NVIDIA H200" or "2 x NVIDIA H200".
  int Multiprocessors = 0;
  std::size_t CacheBytes = 0; ///< The size of the second-level cache.
  /// By kernel, how many of its blocks can run at the same time on every GPU, once that is known.
  std::map<const void*, int> ResidentBlocks;
  unsigned int GroupBlocks = 0; ///< The number of blocks of a ThreadGroup; 0: not known yet.
  CudaStream Stream;
  CudaEvent StreamDone; ///< What is in the stream so far.
  CudaEvent CallerDone; ///< What was in a stream of the caller's.
  std::vector<DeviceStreams> Others; ///< The other GPUs; empty if there is one.
  std::unique_ptr<DeviceMemory> Pool;
  std::unique_ptr<SharedMemory> Shared; ///< Null if there is one GPU.

private:
  PageLocked Result;
  std::vector<StagingBuffer> Staging; ///< One of every GPU, in their order, then the next ones.
};

/// Makes a device current in the calling thread, and restores the previous one.
class CurrentDevice : public DeviceScope
{
public:
  explicit CurrentDevice(int device);
  ~CurrentDevice() override;
  CurrentDevice(const CurrentDevice&) = delete;
  CurrentDevice& operator=(const CurrentDevice&) = delete;

private:
  int Previous = -1;
};

/// Waits for all GPUs, also after an exception between Fork and Join, and keeps the context for the
/// next run, unless something failed in it.
struct ContextReturn
{
  void operator()(CudaContext* context) const noexcept;
};

/// A context for one run.
using ContextLease = std::unique_ptr<CudaContext, ContextReturn>;
ContextLease LeaseContext(const std::vector<int>& devices);

}

#endif
