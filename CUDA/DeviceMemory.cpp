// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "DeviceMemory.h"

#include "CudaError.h"
#include "FlipError.h"
#include "IdleMemory.h"

#include <algorithm>
#include <cstdint>
#include <string>

namespace delaunayflip
{

DeviceMemory::DeviceMemory(int device, cudaStream_t stream)
  : Device(device),
    Stream(stream)
{
  int supported = 0;
  CallCuda("ask for memory pools",
    [&] { return cudaDeviceGetAttribute(&supported, cudaDevAttrMemoryPoolsSupported, device); });
  if (supported == 0)
  {
    return;
  }
  cudaMemPoolProps properties = {};
  properties.allocType = cudaMemAllocationTypePinned;
  properties.location.type = cudaMemLocationTypeDevice;
  properties.location.id = device;
  CallCuda("make a memory pool", [&] { return cudaMemPoolCreate(&this->Pool, &properties); });
  std::uint64_t keepAll = UINT64_MAX;
  if (cudaMemPoolSetAttribute(this->Pool, cudaMemPoolAttrReleaseThreshold, &keepAll) != cudaSuccess)
  {
    cudaGetLastError(); // it works without, but slower
  }
}

DeviceMemory::~DeviceMemory()
{
  if (this->Pool)
  {
    cudaMemPoolDestroy(this->Pool);
  }
}

void* DeviceMemory::Allocate(std::size_t bytes)
{
  constexpr std::size_t Least = 256;
  const std::size_t size = std::max(bytes, Least);
  return AllocateOrRelease(
    [&]()
    {
      void* memory = nullptr;
      CallCuda("allocate memory",
        [&]
        {
          return this->Pool ? cudaMallocFromPoolAsync(&memory, size, this->Pool, this->Stream)
                            : cudaMalloc(&memory, size);
        });
      return memory;
    });
}

void DeviceMemory::Free(void* memory, std::size_t) noexcept
{
  const cudaError_t error = this->Pool ? cudaFreeAsync(memory, this->Stream) : cudaFree(memory);
  if (error != cudaSuccess)
  {
    cudaGetLastError(); // there is no caller to report to
  }
}

void DeviceMemory::AllowAccess(const std::vector<int>& devices)
{
  if (!this->Pool)
  {
    throw BackendUnavailable(
      "GPU " + std::to_string(this->Device) + " has no memory pools to share; use one GPU");
  }
  for (const int device : devices)
  {
    if (device == this->Device)
    {
      continue;
    }
    cudaMemAccessDesc access = {};
    access.location.type = cudaMemLocationTypeDevice;
    access.location.id = device;
    access.flags = cudaMemAccessFlagsProtReadWrite;
    CallCuda("share memory", [&] { return cudaMemPoolSetAccess(this->Pool, &access, 1); });
  }
}

std::size_t DeviceMemory::TakePeak()
{
  std::uint64_t peak = 0;
  if (this->Pool)
  {
    cudaMemPoolGetAttribute(this->Pool, cudaMemPoolAttrUsedMemHigh, &peak);
    std::uint64_t reset = 0;
    cudaMemPoolSetAttribute(this->Pool, cudaMemPoolAttrUsedMemHigh, &reset);
  }
  return peak;
}

}
