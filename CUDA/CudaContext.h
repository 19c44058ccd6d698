// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_CUDACONTEXT_H
#define DELAUNAYFLIP_CUDACONTEXT_H

#include "Array.h"
#include "CudaError.h"
#include "FlipEngine.h"

#include <cuda_runtime_api.h>

#include <cstddef>
#include <memory>
#include <string>

namespace delaunayflip
{

/// Memory of a device, allocated and freed in the order of a stream. Freed memory stays in a pool,
/// so that the next run of the same size needs no call of the driver.
class DeviceMemory : public Memory
{
public:
  DeviceMemory(int device, cudaStream_t stream);
  ~DeviceMemory() override;
  DeviceMemory(const DeviceMemory&) = delete;
  DeviceMemory& operator=(const DeviceMemory&) = delete;

  /// @throws BackendUnavailable.
  void* Allocate(std::size_t bytes) override;
  void Free(void* memory, std::size_t bytes) noexcept override;

  /// The most bytes that were in use at any time since the last call.
  std::size_t TakePeak();

private:
  cudaStream_t Stream;
  cudaMemPool_t Pool = nullptr; ///< Null if the device has none; cudaMalloc is used then.
};

/// What a run needs besides its mesh: a stream, memory, and page-locked buffers for copies between
/// host and device. One run at a time uses a context; then it is kept for the next run.
class CudaContext
{
public:
  static constexpr int StagingSlots = 4;
  static constexpr std::size_t StagingBytes = std::size_t(8) << 20; ///< The size of one slot.

  /// @throws BackendUnavailable.
  explicit CudaContext(int device);
  ~CudaContext();
  CudaContext(const CudaContext&) = delete;
  CudaContext& operator=(const CudaContext&) = delete;

  int Device;
  std::string Name; ///< E.g. "NVIDIA H200".
  int Multiprocessors = 0;
  std::size_t CacheBytes = 0; ///< Of the second-level cache.
  cudaStream_t Stream = nullptr;
  std::unique_ptr<DeviceMemory> Pool;
  cudaEvent_t CallerDone = nullptr; ///< What was in a stream of the caller's.
  void* Staging[StagingSlots] = {};
  cudaEvent_t StagingDone[StagingSlots] = {};

private:
  void Open();
  void Close() noexcept;
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

/// A context for one run. Kept afterwards for the next run, unless something failed in it.
class ContextLease
{
public:
  explicit ContextLease(int device);
  ~ContextLease();
  ContextLease(ContextLease&&) noexcept;
  ContextLease& operator=(ContextLease&&) = delete;

  CudaContext& operator*() const { return *this->Context; }
  CudaContext* operator->() const { return this->Context.get(); }

private:
  std::unique_ptr<CudaContext> Context;
};

}

#endif
