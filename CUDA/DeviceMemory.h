// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_DEVICEMEMORY_H
#define DELAUNAYFLIP_DEVICEMEMORY_H

#include "Array.h"

#include <cuda_runtime_api.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

namespace delaunayflip
{

/// Memory of a device, allocated and freed in the order of a stream. Freed memory stays in a pool,
/// so that the next run of the same size needs no call of the driver.
class DeviceMemory : public Memory
{
public:
  /// @throws BackendUnavailable, also for a device without memory pools.
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
  cudaMemPool_t Pool = nullptr;
};

/// Frees the memory that is kept for later runs of the process, on all GPUs. @returns whether there
/// was any.
bool ReleaseIdleMemory();

/// The fewest triangles per GPU for which GPUs share a mesh; smaller meshes stay on one GPU. With
/// fewer, the smallest arrays with a value per edge, the bits, would be on one GPU, and the others
/// would wait for it. Only tests change it.
inline std::int64_t SmallestShare = 12000000;

/// Memory of several GPUs that all of them can access. An array has one range of addresses, with
/// an equal part of it on each GPU, in their order: what belongs to the same part of the mesh is on
/// the same GPU. Small arrays are on the first GPU.
///
/// Freed memory is kept for arrays of the same size. Work that follows on the stream may use it
/// again at once, as in a memory pool, so the work of all GPUs must be in the order of the stream.
class SharedMemory : public Memory
{
public:
  /// @param small the memory of the first GPU, which the others can access.
  /// @throws BackendUnavailable if the GPUs cannot share memory.
  SharedMemory(std::vector<int> devices, DeviceMemory& small);
  ~SharedMemory() override;
  SharedMemory(const SharedMemory&) = delete;
  SharedMemory& operator=(const SharedMemory&) = delete;

  /// @throws BackendUnavailable.
  void* Allocate(std::size_t bytes) override;
  void Free(void* memory, std::size_t bytes) noexcept override;

  /// The most bytes that were in use at any time since the last call.
  std::size_t TakePeak();

private:
  bool IsSmall(std::size_t bytes) const;
  std::size_t GetPartSize(std::size_t bytes) const;
  void* Map(std::size_t part) const;
  void Unmap(void* memory, std::size_t part) const noexcept;
  void ReleaseIdle() noexcept;

  std::vector<int> Devices;
  DeviceMemory& Small;
  std::size_t Granularity = 0; ///< Sizes of parts are multiples of it.
  std::multimap<std::size_t, void*> Idle; ///< By the size of a part.
  std::size_t Used = 0, Peak = 0; ///< Bytes of arrays that are not small.
};

}

#endif
