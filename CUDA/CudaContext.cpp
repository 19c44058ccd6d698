// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CudaContext.h"

#include "CudaDevice.h"
#include "IdleMemory.h"

#include <algorithm>
#include <cstdint>
#include <mutex>
#include <new>
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

  std::unique_ptr<CudaContext> Take(const std::vector<int>& devices)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    const auto found = std::find_if(this->Contexts.begin(), this->Contexts.end(),
      [&](const std::unique_ptr<CudaContext>& context)
      { return context->ListDevices() == devices; });
    if (found == this->Contexts.end())
    {
      return nullptr;
    }
    std::unique_ptr<CudaContext> context = std::move(*found);
    this->Contexts.erase(found);
    return context;
  }

  /// Keeps a context; destroys it if there is no memory for the list, as a destructor calls this.
  void Give(std::unique_ptr<CudaContext> context) noexcept
  {
    try
    {
      const std::lock_guard<std::mutex> lock(this->Mutex);
      this->Contexts.push_back(std::move(context));
    }
    catch (const std::bad_alloc&)
    {
    }
  }

  std::size_t TakePeak()
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    std::size_t peak = 0;
    for (const std::unique_ptr<CudaContext>& context : this->Contexts)
    {
      peak = std::max(peak, context->TakePeak());
    }
    return peak;
  }

  std::vector<std::unique_ptr<CudaContext>> TakeAll()
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    return std::move(this->Contexts);
  }
};

cudaEvent_t MakeEvent()
{
  cudaEvent_t event = nullptr;
  CallCuda(
    "make an event", [&] { return cudaEventCreateWithFlags(&event, cudaEventDisableTiming); });
  return event;
}
}

CudaContext::CudaContext(const std::vector<int>& devices)
  : Device(devices.front())
{
  try
  {
    this->Open(devices);
  }
  catch (...)
  {
    this->Close();
    throw;
  }
}

CudaContext::~CudaContext() { this->Close(); }

void CudaContext::Open(const std::vector<int>& devices)
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
  this->CallerDone = MakeEvent();
  this->StreamDone = MakeEvent();
  this->OpenOthers(devices);
  this->OpenStaging(devices);
}

void CudaContext::OpenStaging(const std::vector<int>& devices)
{
  for (std::size_t slot = 0; slot < StagingSlots * devices.size(); ++slot)
  {
    const std::size_t device = slot % devices.size();
    const CurrentDevice current(devices[device]);
    this->Staging.push_back({ device == 0 ? this->Stream : this->Others[device - 1].Stream });
    StagingBuffer& buffer = this->Staging.back();
    CallCuda("allocate page-locked memory",
      [&] { return cudaHostAlloc(&buffer.Memory, StagingBytes, cudaHostAllocPortable); });
    buffer.Done = MakeEvent();
  }
}

void CudaContext::OpenOthers(const std::vector<int>& devices)
{
  if (devices.size() == 1)
  {
    return;
  }
  for (std::size_t i = 1; i < devices.size(); ++i)
  {
    const CurrentDevice current(devices[i]);
    this->Others.push_back({ devices[i] });
    CallCuda("make a stream",
      [&]
      { return cudaStreamCreateWithFlags(&this->Others.back().Stream, cudaStreamNonBlocking); });
    this->Others.back().Done = MakeEvent();
  }
  this->Shared.reset(new SharedMemory(devices, *this->Pool));
  this->Name = std::to_string(devices.size()) + " x " + this->Name;
}

Memory& CudaContext::GetMemory() const
{
  return this->Shared ? static_cast<Memory&>(*this->Shared) : *this->Pool;
}

std::vector<int> CudaContext::ListDevices() const
{
  std::vector<int> devices{ this->Device };
  for (const DeviceStreams& other : this->Others)
  {
    devices.push_back(other.Device);
  }
  return devices;
}

std::size_t CudaContext::TakePeak()
{
  return this->Pool->TakePeak() + (this->Shared ? this->Shared->TakePeak() : 0);
}

void CudaContext::Fork() const
{
  if (this->Others.empty())
  {
    return;
  }
  CallCuda("record an event", [&] { return cudaEventRecord(this->StreamDone, this->Stream); });
  for (const DeviceStreams& other : this->Others)
  {
    CallCuda(
      "wait for an event", [&] { return cudaStreamWaitEvent(other.Stream, this->StreamDone, 0); });
  }
}

void CudaContext::Join() const
{
  for (const DeviceStreams& other : this->Others)
  {
    CallCuda("record an event", [&] { return cudaEventRecord(other.Done, other.Stream); });
    CallCuda("wait for an event", [&] { return cudaStreamWaitEvent(this->Stream, other.Done, 0); });
  }
}

void CudaContext::Close() noexcept
{
  for (const DeviceStreams& other : this->Others)
  {
    if (other.Stream)
    {
      cudaStreamSynchronize(other.Stream); // it may still use the memory
    }
  }
  this->Shared.reset();
  for (const DeviceStreams& other : this->Others)
  {
    if (other.Done)
    {
      cudaEventDestroy(other.Done);
    }
    if (other.Stream)
    {
      cudaStreamDestroy(other.Stream);
    }
  }
  if (this->StreamDone)
  {
    cudaEventDestroy(this->StreamDone);
  }
  if (this->CallerDone)
  {
    cudaEventDestroy(this->CallerDone);
  }
  for (const StagingBuffer& buffer : this->Staging)
  {
    if (buffer.Done)
    {
      cudaEventDestroy(buffer.Done);
    }
    if (buffer.Memory)
    {
      cudaFreeHost(buffer.Memory);
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
  // The previous device need not be usable, e.g. if another process has it alone.
  if (cudaSetDevice(this->Previous) != cudaSuccess)
  {
    cudaGetLastError(); // else the next launch would seem to have failed
  }
}

ContextLease::ContextLease(const std::vector<int>& devices)
  : Context(IdleContexts::Get().Take(devices))
{
  if (!this->Context)
  {
    this->Context.reset(new CudaContext(devices));
  }
}

ContextLease::ContextLease(ContextLease&&) noexcept = default;

namespace
{
/// Waits for all GPUs, also after an exception between Fork and Join. @returns whether nothing
/// failed.
bool Finish(const CudaContext& context)
{
  bool isGood = cudaStreamSynchronize(context.Stream) == cudaSuccess;
  for (const DeviceStreams& other : context.Others)
  {
    isGood = cudaStreamSynchronize(other.Stream) == cudaSuccess && isGood;
  }
  return isGood;
}
}

ContextLease::~ContextLease()
{
  // A context in which something failed is not kept for the next run.
  if (this->Context && Finish(*this->Context))
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

int CountCudaDevices()
{
  int devices = 0;
  const cudaError_t error = HasCudaDriver() ? cudaGetDeviceCount(&devices) : cudaErrorNoDevice;
  cudaGetLastError();
  return error == cudaSuccess ? devices : 0;
}

void ReleaseCudaMemory() { ReleaseIdleMemory(); }

bool ReleaseIdleMemory() { return !IdleContexts::Get().TakeAll().empty(); }

std::size_t TakePeakCudaMemory() { return IdleContexts::Get().TakePeak(); }

}
