// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CudaContext.h"

#include "CudaDevice.h"

#include <algorithm>
#include <cstdint>
#include <mutex>
#include <vector>

namespace delaunayflip
{

namespace
{
/// Contexts that no run uses. Never destroyed: at the end of the process the driver may already be
/// unloaded.
struct IdleContexts
{
  std::mutex Mutex;
  std::vector<std::unique_ptr<CudaContext>> Contexts;

  static IdleContexts& Get()
  {
    static IdleContexts* contexts = new IdleContexts;
    return *contexts;
  }

  std::unique_ptr<CudaContext> Take(int device)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    const auto found = std::find_if(this->Contexts.begin(), this->Contexts.end(),
      [device](const std::unique_ptr<CudaContext>& context) { return context->Device == device; });
    if (found == this->Contexts.end())
    {
      return nullptr;
    }
    std::unique_ptr<CudaContext> context = std::move(*found);
    this->Contexts.erase(found);
    return context;
  }

  void Give(std::unique_ptr<CudaContext> context)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    this->Contexts.push_back(std::move(context));
  }

  std::size_t TakePeak()
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    std::size_t peak = 0;
    for (const std::unique_ptr<CudaContext>& context : this->Contexts)
    {
      peak = std::max(peak, context->Pool->TakePeak());
    }
    return peak;
  }

  std::vector<std::unique_ptr<CudaContext>> TakeAll()
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    return std::move(this->Contexts);
  }
};
}

DeviceMemory::DeviceMemory(int device, cudaStream_t stream)
  : Stream(stream)
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
  cudaMemPoolSetAttribute(this->Pool, cudaMemPoolAttrReleaseThreshold, &keepAll);
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
  void* memory = nullptr;
  CallCuda("allocate memory",
    [&]
    {
      return this->Pool ? cudaMallocFromPoolAsync(&memory, size, this->Pool, this->Stream)
                        : cudaMalloc(&memory, size);
    });
  return memory;
}

void DeviceMemory::Free(void* memory, std::size_t) noexcept
{
  const cudaError_t error = this->Pool ? cudaFreeAsync(memory, this->Stream) : cudaFree(memory);
  if (error != cudaSuccess)
  {
    cudaGetLastError(); // there is no caller to report to
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

namespace
{
cudaEvent_t MakeEvent()
{
  cudaEvent_t event = nullptr;
  CallCuda(
    "make an event", [&] { return cudaEventCreateWithFlags(&event, cudaEventDisableTiming); });
  return event;
}
}

CudaContext::CudaContext(int device)
  : Device(device)
{
  try
  {
    this->Open();
  }
  catch (...)
  {
    this->Close();
    throw;
  }
}

CudaContext::~CudaContext() { this->Close(); }

void CudaContext::Open()
{
  cudaGetLastError(); // clears errors of other code
  const CurrentDevice current(this->Device); // streams and events belong to it
  cudaDeviceProp properties;
  CallCuda("read the device's properties",
    [&] { return cudaGetDeviceProperties(&properties, this->Device); });
  this->Name = properties.name;
  this->Multiprocessors = properties.multiProcessorCount;
  this->CacheBytes = static_cast<std::size_t>(properties.l2CacheSize);
  CallCuda("make a stream",
    [&] { return cudaStreamCreateWithFlags(&this->Stream, cudaStreamNonBlocking); });
  this->Pool.reset(new DeviceMemory(this->Device, this->Stream));
  for (int slot = 0; slot < StagingSlots; ++slot)
  {
    CallCuda("allocate page-locked memory",
      [&] { return cudaHostAlloc(&this->Staging[slot], StagingBytes, cudaHostAllocPortable); });
    this->StagingDone[slot] = MakeEvent();
  }
  this->CallerDone = MakeEvent();
}

void CudaContext::Close() noexcept
{
  if (this->CallerDone)
  {
    cudaEventDestroy(this->CallerDone);
  }
  for (int slot = 0; slot < StagingSlots; ++slot)
  {
    if (this->StagingDone[slot])
    {
      cudaEventDestroy(this->StagingDone[slot]);
    }
    if (this->Staging[slot])
    {
      cudaFreeHost(this->Staging[slot]);
    }
  }
  this->Pool.reset();
  if (this->Stream)
  {
    cudaStreamDestroy(this->Stream);
  }
  cudaGetLastError();
}

CurrentDevice::CurrentDevice(int device)
{
  CallCuda("ask for the current device", [&] { return cudaGetDevice(&this->Previous); });
  CallCuda("use the device", [&] { return cudaSetDevice(device); });
}

CurrentDevice::~CurrentDevice()
{
  if (this->Previous >= 0)
  {
    cudaSetDevice(this->Previous);
  }
}

ContextLease::ContextLease(int device)
  : Context(IdleContexts::Get().Take(device))
{
  if (!this->Context)
  {
    this->Context.reset(new CudaContext(device));
  }
}

ContextLease::ContextLease(ContextLease&&) noexcept = default;

ContextLease::~ContextLease()
{
  // A context in which something failed is not kept for the next run.
  if (this->Context && cudaStreamSynchronize(this->Context->Stream) == cudaSuccess)
  {
    IdleContexts::Get().Give(std::move(this->Context));
  }
}

bool HasCudaDevice()
{
  // A driver that is installed but too old deserves a warning.
  int devices = 0;
  const cudaError_t error = HasCudaDriver() ? cudaGetDeviceCount(&devices) : cudaErrorNoDevice;
  cudaGetLastError();
  return error != cudaErrorNoDevice;
}

void ReleaseCudaMemory() { IdleContexts::Get().TakeAll().clear(); }

std::size_t TakePeakCudaMemory() { return IdleContexts::Get().TakePeak(); }

}
