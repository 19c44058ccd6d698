// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_STAGEDCOPY_H
#define DELAUNAYFLIP_STAGEDCOPY_H

#include "CudaContext.h"
#include "CudaError.h"
#include "ThreadBackend.h"

#include <cuda_runtime_api.h>

#include <algorithm>
#include <cstdint>

namespace delaunayflip
{

/// Copies between arrays on the host and device memory through page-locked buffers: threads convert
/// one buffer while others are being copied. This is several times as fast as the driver's copies
/// from pageable memory.
class StagedCopy
{
public:
  StagedCopy(CudaContext& context, const ThreadBackend& threads)
    : Context(context),
      Threads(threads)
  {
  }

  /// Sends get(i) for i = 0 .. size - 1. When it returns, get is no longer needed.
  template <typename T, typename Get>
  void Upload(std::int64_t size, T* device, const Get& get) const
  {
    const std::int64_t step = CudaContext::StagingBytes / sizeof(T);
    for (std::int64_t begin = 0; begin < size; begin += step)
    {
      const int slot = this->SlotOf(begin / step);
      const std::int64_t count = std::min(step, size - begin);
      T* staging = static_cast<T*>(this->Context.Staging[slot]);
      this->WaitFor(slot);
      this->Threads.ForEach(count, [&](std::int64_t i) { staging[i] = get(begin + i); });
      this->Copy(device + begin, staging, count * sizeof(T), cudaMemcpyHostToDevice, slot);
    }
  }

  /// Calls put(i, value) for the values of i = 0 .. size - 1, from an array of `sliceSize` values:
  /// prepare(first) begins to fill it, on the context's stream, with those from `first` on.
  /// @param sliceSize from GetSliceSize.
  template <typename T, typename Prepare, typename Put>
  void DownloadSlices(std::int64_t size, const T* device, std::int64_t sliceSize,
    const Prepare& prepare, const Put& put) const
  {
    constexpr std::int64_t Step = CudaContext::StagingBytes / sizeof(T);
    const std::int64_t parts = (size + Step - 1) / Step;
    for (std::int64_t part = 0; part < parts + Ahead; ++part)
    {
      if (part < parts)
      {
        const std::int64_t begin = part * Step;
        if (begin % sliceSize == 0)
        {
          prepare(begin);
        }
        const int slot = this->SlotOf(part);
        this->Copy(this->Context.Staging[slot], device + begin % sliceSize,
          std::min(Step, size - begin) * sizeof(T), cudaMemcpyDeviceToHost, slot);
      }
      if (part >= Ahead)
      {
        this->Drain<T>(part - Ahead, Step, size, put);
      }
    }
  }

  /// The size of a slice when there are about `slices` of them, a multiple of the size of a part.
  template <typename T>
  static std::int64_t GetSliceSize(std::int64_t size, std::int64_t slices)
  {
    constexpr std::int64_t Step = CudaContext::StagingBytes / sizeof(T);
    const std::int64_t parts = (size + Step - 1) / Step;
    return std::max<std::int64_t>(1, (parts + slices - 1) / slices) * Step;
  }

private:
  /// How many parts are being copied while one is converted.
  static constexpr std::int64_t Ahead = CudaContext::StagingSlots - 1;

  static int SlotOf(std::int64_t part)
  {
    return static_cast<int>(part % CudaContext::StagingSlots);
  }

  template <typename T, typename Put>
  void Drain(std::int64_t part, std::int64_t step, std::int64_t size, const Put& put) const
  {
    const int slot = this->SlotOf(part);
    const T* staging = static_cast<const T*>(this->Context.Staging[slot]);
    const std::int64_t begin = part * step;
    this->WaitFor(slot);
    this->Threads.ForEach(
      std::min(step, size - begin), [&](std::int64_t i) { put(begin + i, staging[i]); });
  }

  void Copy(void* to, const void* from, std::size_t bytes, cudaMemcpyKind kind, int slot) const
  {
    CallCuda("copy between host and GPU",
      [&] { return cudaMemcpyAsync(to, from, bytes, kind, this->Context.Stream); });
    CallCuda("record an event",
      [&] { return cudaEventRecord(this->Context.StagingDone[slot], this->Context.Stream); });
  }

  void WaitFor(int slot) const
  {
    CallCuda(
      "wait for a copy", [&] { return cudaEventSynchronize(this->Context.StagingDone[slot]); });
  }

  CudaContext& Context;
  const ThreadBackend& Threads;
};

}

#endif
