// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_STAGEDCOPIES_H
#define DELAUNAYFLIP_STAGEDCOPIES_H

#include "Array.h"
#include "CudaContext.h"
#include "ThreadBackend.h"

#include <cuda_runtime_api.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace delaunayflip
{

/// The order in which the parts of an array are copied. One GPU after the other copies a part of
/// its share of a slice, so that all of them copy at the same time.
/// @returns the part that is copied as number i, or -1 if there is none.
inline std::int64_t FindPart(
  std::int64_t i, std::int64_t parts, std::int64_t partsPerSlice, std::int64_t devices)
{
  const std::int64_t share = (partsPerSlice + devices - 1) / devices;
  const std::int64_t slice = i / (share * devices);
  const std::int64_t inSlice = i % (share * devices);
  const std::int64_t place = inSlice % devices * share + inSlice / devices;
  const std::int64_t part = slice * partsPerSlice + place;
  return place < partsPerSlice && part < parts ? part : -1;
}

/// Copies between arrays on the host and device memory through the page-locked buffers of a
/// context: threads convert one buffer while others are being copied. This is several times as fast
/// as the driver's copies from pageable memory.
class StagedCopies
{
public:
  StagedCopies(CudaContext& context, const ThreadBackend& threads)
    : Context(context),
      Threads(threads)
  {
  }

  /// Sends get(i) for i = 0 .. size - 1. When it returns, get is no longer needed.
  template <typename T, typename Get>
  void Send(std::int64_t size, T* device, const Get& get) const
  {
    constexpr std::int64_t Step = CudaContext::StagingBytes / sizeof(T);
    const std::int64_t parts = (size + Step - 1) / Step;
    const std::int64_t devices = static_cast<std::int64_t>(this->Context.Devices.size());
    const std::int64_t copies = (parts + devices - 1) / devices * devices;
    this->Context.Fork();
    for (std::int64_t copy = 0; copy < copies; ++copy)
    {
      const std::int64_t begin = FindPart(copy, parts, parts, devices) * Step;
      if (begin >= 0)
      {
        const StagingBuffer& buffer = this->Context.GetBuffer(copy);
        const std::int64_t count = std::min(Step, size - begin);
        auto* values = static_cast<T*>(buffer.Memory.Get());
        WaitForCopy(buffer);
        this->Threads.ForEach(count, [&](std::int64_t i) { values[i] = get(begin + i); });
        StartCopy(buffer, device + begin, values, count * sizeof(T), cudaMemcpyHostToDevice);
      }
    }
    this->Context.Join();
  }

  /// Calls put(i, value) on the host for i = 0 .. size - 1, with the values of a device array.
  template <typename T, typename Put>
  void Receive(std::int64_t size, const T* device, const Put& put) const
  {
    constexpr std::int64_t LargestStep = CudaContext::StagingBytes / sizeof(T);
    constexpr std::int64_t SmallestStep = LargestStep / 16;
    constexpr std::int64_t WantedParts = 8;
    const std::int64_t step = std::clamp(size / WantedParts + 1, SmallestStep, LargestStep);
    const std::int64_t parts = (size + step - 1) / step;
    const std::int64_t ahead = this->Context.CountBuffers() - 1; // copied while one is converted
    this->Context.Fork();
    for (std::int64_t i = 0; i < parts + ahead; ++i)
    {
      if (i < parts)
      {
        const StagingBuffer& buffer = this->Context.GetBuffer(i);
        const std::int64_t count = std::min(step, size - i * step);
        StartCopy(
          buffer, buffer.Memory, device + i * step, count * sizeof(T), cudaMemcpyDeviceToHost);
      }
      if (i >= ahead)
      {
        const std::int64_t begin = (i - ahead) * step;
        const StagingBuffer& buffer = this->Context.GetBuffer(i - ahead);
        const auto* staged = static_cast<const T*>(buffer.Memory.Get());
        WaitForCopy(buffer);
        this->Threads.ForEach(
          std::min(step, size - begin), [&](std::int64_t k) { put(begin + k, staged[k]); });
      }
    }
    this->Context.Join();
  }

  /// Calls put(i, value) on the host for i = 0 .. size - 1. The values are copied in slices, to
  /// save memory: fill(slice) launches a kernel over all triangles that sets the values of one
  /// slice, while the host still converts the slice before it.
  /// @param areInOrder whether a slice takes only its own triangles, so that there can be many.
  template <typename Fill, typename Put>
  void DownloadSlices(std::int64_t size, bool areInOrder, const Fill& fill, const Put& put) const
  {
    using Value = std::uint32_t;
    constexpr std::int64_t LargestStep = CudaContext::StagingBytes / sizeof(Value);
    constexpr std::int64_t SmallestStep = LargestStep / 16;
    std::int64_t steps = 4; // about
    std::int64_t mostSlices = 8;
    if (areInOrder)
    {
      steps = 16;
      mostSlices = std::numeric_limits<std::int64_t>::max();
    }
    const std::int64_t step = std::clamp(size / steps + 1, SmallestStep, LargestStep);
    const std::int64_t parts = (size + step - 1) / step;
    const std::int64_t partsPerSlice = std::max<std::int64_t>(1, (parts - 1) / mostSlices + 1);
    const std::int64_t sliceSize = partsPerSlice * step;
    Array<Value> values(
      static_cast<std::size_t>(std::min(size, sliceSize)), this->Context.GetMemory());
    const std::int64_t ahead = this->Context.CountBuffers() - 1; // copied while one is converted
    const std::int64_t devices = static_cast<std::int64_t>(this->Context.Devices.size());
    const std::int64_t copiesPerSlice = (partsPerSlice + devices - 1) / devices * devices;
    const std::int64_t copies = (parts + partsPerSlice - 1) / partsPerSlice * copiesPerSlice;
    for (std::int64_t i = 0; i < copies + ahead; ++i)
    {
      std::int64_t fetched = -1, drained = -1;
      if (i < copies)
      {
        fetched = FindPart(i, parts, partsPerSlice, devices);
      }
      if (i >= ahead)
      {
        drained = FindPart(i - ahead, parts, partsPerSlice, devices);
      }
      if (i < copies && i % copiesPerSlice == 0)
      {
        const std::int64_t first = i / copiesPerSlice * sliceSize;
        this->Context.Join();
        fill(OutputSlice{ values.Data(), first, std::min(size, first + sliceSize) });
        this->Context.Fork();
      }
      if (fetched >= 0)
      {
        const StagingBuffer& buffer = this->Context.GetBuffer(i);
        const std::int64_t begin = fetched * step;
        StartCopy(buffer, buffer.Memory, values.Data() + begin % sliceSize,
          std::min(step, size - begin) * sizeof(Value), cudaMemcpyDeviceToHost);
      }
      if (drained >= 0)
      {
        const StagingBuffer& buffer = this->Context.GetBuffer(i - ahead);
        const auto* staged = static_cast<const Value*>(buffer.Memory.Get());
        const std::int64_t begin = drained * step;
        WaitForCopy(buffer);
        this->Threads.ForEach(
          std::min(step, size - begin), [&](std::int64_t i) { put(begin + i, staged[i]); });
      }
    }
    this->Context.Join();
  }

private:
  static void StartCopy(
    const StagingBuffer& buffer, void* to, const void* from, std::size_t bytes, cudaMemcpyKind kind)
  {
    CallCuda("copy between host and GPU", cudaMemcpyAsync, to, from, bytes, kind, buffer.Stream);
    CallCuda("record an event", cudaEventRecord, buffer.Done, buffer.Stream);
  }

  static void WaitForCopy(const StagingBuffer& buffer)
  {
    CallCuda("wait for a copy", cudaEventSynchronize, buffer.Done);
  }

  CudaContext& Context;
  const ThreadBackend& Threads;
};

}

#endif
