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

/// The order in which the parts of an array are copied. Every GPU in turn copies a part of its
/// share, so that all of them copy at the same time.
class PartOrder
{
public:
  /// @param partsPerSlice the number of parts in each slice; the last slice may have fewer.
  PartOrder(std::int64_t parts, std::int64_t partsPerSlice, std::int64_t devices)
    : Parts(parts),
      PartsPerSlice(std::max<std::int64_t>(1, partsPerSlice)),
      Share((this->PartsPerSlice + devices - 1) / devices),
      Devices(devices)
  {
  }

  std::int64_t CountTurns() const
  {
    const std::int64_t slices = (this->Parts + this->PartsPerSlice - 1) / this->PartsPerSlice;
    return slices * this->CountTurnsPerSlice();
  }
  /// @returns the slice that begins with a turn, or -1.
  std::int64_t FindSlice(std::int64_t turn) const
  {
    return turn % this->CountTurnsPerSlice() == 0 ? turn / this->CountTurnsPerSlice() : -1;
  }
  /// @returns the part of a turn, or -1 if there is none.
  std::int64_t FindPart(std::int64_t turn) const
  {
    const std::int64_t slice = turn / this->CountTurnsPerSlice();
    const std::int64_t inSlice = turn % this->CountTurnsPerSlice();
    const std::int64_t place = inSlice % this->Devices * this->Share + inSlice / this->Devices;
    const std::int64_t part = slice * this->PartsPerSlice + place;
    return place < this->PartsPerSlice && part < this->Parts ? part : -1;
  }

private:
  std::int64_t CountTurnsPerSlice() const { return this->Share * this->Devices; }

  std::int64_t Parts, PartsPerSlice;
  std::int64_t Share; ///< Of a GPU, in a slice.
  std::int64_t Devices;
};

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
    const std::int64_t parts = (size + step - 1) / step;
    const PartOrder order(parts, parts, this->CountDevices());
    this->Context.Fork();
    for (std::int64_t turn = 0; turn < order.CountTurns(); ++turn)
    {
      const std::int64_t begin = order.FindPart(turn) * step;
      if (begin < 0)
      {
        continue;
      }
      const int slot = this->SlotOf(turn);
      const std::int64_t count = std::min(step, size - begin);
      T* staging = static_cast<T*>(this->Context.Staging[slot].Memory);
      this->WaitFor(slot);
      this->Threads.ForEach(count, [&](std::int64_t i) { staging[i] = get(begin + i); });
      this->Copy(device + begin, staging, count * sizeof(T), cudaMemcpyHostToDevice, slot);
    }
    this->Context.Join();
  }

  /// Calls put(i, value) for the values of i = 0 .. size - 1, from an array of `sliceSize` values:
  /// prepare(first) begins to fill it, on the context's stream, with those from `first` on.
  /// @param sliceSize from GetSliceSize.
  template <typename T, typename Prepare, typename Put>
  void DownloadSlices(std::int64_t size, const T* device, std::int64_t sliceSize,
    const Prepare& prepare, const Put& put) const
  {
    constexpr std::int64_t Step = CudaContext::StagingBytes / sizeof(T);
    const std::int64_t ahead = this->CountSlots() - 1; // copied while one is converted
    const PartOrder order((size + Step - 1) / Step, sliceSize / Step, this->CountDevices());
    for (std::int64_t turn = 0; turn < order.CountTurns() + ahead; ++turn)
    {
      if (turn < order.CountTurns())
      {
        if (order.FindSlice(turn) >= 0)
        {
          this->Context.Join();
          prepare(order.FindSlice(turn) * sliceSize);
          this->Context.Fork();
        }
        this->Fetch(order.FindPart(turn), this->SlotOf(turn), Step, size, device, sliceSize);
      }
      if (turn >= ahead)
      {
        this->Drain<T>(order.FindPart(turn - ahead), this->SlotOf(turn - ahead), Step, size, put);
      }
    }
    this->Context.Join();
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
  std::int64_t CountDevices() const
  {
    return 1 + static_cast<std::int64_t>(this->Context.Others.size());
  }
  std::int64_t CountSlots() const
  {
    return static_cast<std::int64_t>(this->Context.Staging.size());
  }
  int SlotOf(std::int64_t turn) const { return static_cast<int>(turn % this->CountSlots()); }

  /// @param part -1: none.
  template <typename T>
  void Fetch(std::int64_t part, int slot, std::int64_t step, std::int64_t size, const T* device,
    std::int64_t sliceSize) const
  {
    const std::int64_t begin = part * step;
    if (part >= 0)
    {
      this->Copy(this->Context.Staging[slot].Memory, device + begin % sliceSize,
        std::min(step, size - begin) * sizeof(T), cudaMemcpyDeviceToHost, slot);
    }
  }

  template <typename T, typename Put>
  void Drain(
    std::int64_t part, int slot, std::int64_t step, std::int64_t size, const Put& put) const
  {
    if (part < 0)
    {
      return;
    }
    const T* staging = static_cast<const T*>(this->Context.Staging[slot].Memory);
    const std::int64_t begin = part * step;
    this->WaitFor(slot);
    this->Threads.ForEach(
      std::min(step, size - begin), [&](std::int64_t i) { put(begin + i, staging[i]); });
  }

  void Copy(void* to, const void* from, std::size_t bytes, cudaMemcpyKind kind, int slot) const
  {
    const StagingBuffer& staging = this->Context.Staging[slot];
    CallCuda("copy between host and GPU",
      [&] { return cudaMemcpyAsync(to, from, bytes, kind, staging.Stream); });
    CallCuda("record an event", [&] { return cudaEventRecord(staging.Done, staging.Stream); });
  }

  void WaitFor(int slot) const
  {
    CallCuda(
      "wait for a copy", [&] { return cudaEventSynchronize(this->Context.Staging[slot].Done); });
  }

  CudaContext& Context;
  const ThreadBackend& Threads;
};

}

#endif
