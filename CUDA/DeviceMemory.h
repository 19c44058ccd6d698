// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_DEVICEMEMORY_H
#define DELAUNAYFLIP_DEVICEMEMORY_H

#include "Array.h"

#include <cuda_runtime_api.h>

#include <cstddef>
#include <vector>

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

  /// Lets devices access it; its own, which may be among them, always can.
  /// @throws BackendUnavailable.
  void AllowAccess(const std::vector<int>& devices);

  /// Waits for the stream.
  void Synchronize() const noexcept { cudaStreamSynchronize(this->Stream); }

  /// The most bytes that were in use at any time since the last call.
  std::size_t TakePeak();

private:
  int Device;
  cudaStream_t Stream;
  cudaMemPool_t Pool = nullptr; ///< Null if the device has none; cudaMalloc is used then.
};

}

#endif
