// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Atomics.h"
#include "SectorRates.h"

#include "CudaDevice.h"
#include "CudaError.h"
#include "HostDevice.h"

#include <cuda_runtime.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <type_traits>

namespace delaunayflip
{
namespace
{

constexpr std::size_t SectorBytes = 32;
constexpr int Threads = 384; // As many a block, and blocks, as the loop's kernels have.
constexpr int BlocksOfMultiprocessor = 2;
constexpr int Steps = 50;
constexpr int AtOnce = 8; // Sectors that a thread asks for before it waits.

struct LoadSector
{
  static constexpr const char* Name = "loads";
  __device__ static std::uint32_t Touch(std::uint32_t* word) { return AtomicLoad(word); }
};
struct StoreSector
{
  static constexpr const char* Name = "stores";
  __device__ static std::uint32_t Touch(std::uint32_t* word)
  {
    AtomicStore(word, std::uint32_t(0));
    return 0;
  }
};
struct MarkSector
{
  static constexpr const char* Name = "atomic marks";
  __device__ static std::uint32_t Touch(std::uint32_t* word)
  {
    AtomicSet(word, std::uint32_t(1));
    return 0;
  }
};

template <typename Access>
__global__ void TouchKernel(std::uint32_t* words, std::uint32_t sectors)
{
  // A linear congruential generator (Numerical Recipes), of which the high bits choose.
  std::uint32_t random = (blockIdx.x * blockDim.x + threadIdx.x) * 2654435761u;
  std::uint32_t all = 0;
  for (int step = 0; step < Steps; ++step)
  {
    std::uint32_t seen[AtOnce];
#pragma unroll
    for (int i = 0; i < AtOnce; ++i)
    {
      random = random * 1664525u + 1013904223u;
      const std::uint64_t sector = (std::uint64_t(random) * sectors) >> 32;
      seen[i] = Access::Touch(&words[sector * (SectorBytes / sizeof(std::uint32_t))]);
    }
#pragma unroll
    for (int i = 0; i < AtOnce; ++i)
    {
      all ^= seen[i];
    }
  }
  if (all == 2) // Never: words are 0 or 1. Else the loads would be dropped.
  {
    words[0] = all;
  }
}

struct FreeOnDevice
{
  void operator()(void* memory) const { cudaFree(memory); }
};
struct DestroyEvent
{
  void operator()(cudaEvent_t event) const { cudaEventDestroy(event); }
};
using Event = std::unique_ptr<std::remove_pointer_t<cudaEvent_t>, DestroyEvent>;

Event RecordEvent()
{
  cudaEvent_t event = nullptr;
  CallCuda("make an event", [&] { return cudaEventCreate(&event); });
  Event owner(event);
  CallCuda("record an event", [&] { return cudaEventRecord(event); });
  return owner;
}

/// Sectors a second, in billions; the first of two launches warms up.
template <typename Access>
double MeasureRate(std::uint32_t* words, std::size_t bytes, int blocks)
{
  float milliseconds = 0;
  for (int run = 0; run < 2; ++run)
  {
    const Event begin = RecordEvent();
    TouchKernel<Access>
      <<<blocks, Threads>>>(words, static_cast<std::uint32_t>(bytes / SectorBytes));
    CallCuda("start a kernel", [] { return cudaGetLastError(); });
    const Event end = RecordEvent();
    CallCuda("run a kernel", [&] { return cudaEventSynchronize(end.get()); });
    CallCuda(
      "read a clock", [&] { return cudaEventElapsedTime(&milliseconds, begin.get(), end.get()); });
  }
  return 1e-6 * blocks * Threads * Steps * AtOnce / milliseconds;
}

template <typename Access>
void PrintRates(std::uint32_t* words, std::size_t cached, std::size_t all, int blocks)
{
  std::printf("%-14s %8.1f %8.1f\n", Access::Name, MeasureRate<Access>(words, cached, blocks),
    MeasureRate<Access>(words, all, blocks));
}

}

void PrintSectorRates()
{
  if (!HasCudaDevice())
  {
    std::printf("no GPU: skipped\n");
    return;
  }
  constexpr std::size_t Cached = std::size_t(8) << 20;
  constexpr std::size_t All = std::size_t(440) << 20; // 10 M records, 15 M pairs of words.
  int device = 0;
  int multiprocessors = 0;
  void* memory = nullptr;
  CallCuda("ask for the current device", [&] { return cudaGetDevice(&device); });
  CallCuda("ask for its multiprocessors",
    [&]
    { return cudaDeviceGetAttribute(&multiprocessors, cudaDevAttrMultiProcessorCount, device); });
  CallCuda("allocate memory", [&] { return cudaMalloc(&memory, All); });
  const std::unique_ptr<void, FreeOnDevice> owner(memory);
  CallCuda("clear memory", [&] { return cudaMemset(memory, 0, All); });
  auto* words = static_cast<std::uint32_t*>(memory);
  const int blocks = BlocksOfMultiprocessor * multiprocessors;
  std::printf(
    "random sectors of 32 bytes, G a second\n%-14s %5zu MB %5zu MB\n", "", Cached >> 20, All >> 20);
  PrintRates<LoadSector>(words, Cached, All, blocks);
  PrintRates<StoreSector>(words, Cached, All, blocks);
  PrintRates<MarkSector>(words, Cached, All, blocks);
}

}
