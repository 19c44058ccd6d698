// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CudaContext.h"

#include "CudaDevice.h"
#include "FlipError.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <new>

namespace delaunayflip
{

namespace
{
std::atomic<std::int64_t> NumberOfCalls{ 0 };
std::atomic<std::int64_t> FailingCall{ -1 };
std::atomic<cudaError_t> InjectedError{ cudaSuccess };

/// Advice about errors that users may encounter.
std::string Advise(cudaError_t error)
{
  switch (error)
  {
    case cudaErrorMemoryAllocation:
      return "; the mesh is too large for the free memory of the GPU, unless it is flipped in "
             "pieces";
    case cudaErrorNoDevice:
      return "; does this machine have an NVIDIA GPU?";
    case cudaErrorInvalidDevice:
      return "; CUDA numbers the GPUs of a machine from 0";
    case cudaErrorInsufficientDriver:
      return HasCudaDriver() ? "; update NVIDIA's driver" : "; no NVIDIA driver is installed";
    case cudaErrorNoKernelImageForDevice:
      return "; this build has no code for this GPU, set CMAKE_CUDA_ARCHITECTURES";
    default:
      return "";
  }
}
}

bool HasCudaDriver()
{
  int version = 0;
  return cudaDriverGetVersion(&version) == cudaSuccess && version > 0;
}

void ThrowCudaError(cudaError_t error, const char* action)
{
  cudaGetLastError();
  throw BackendUnavailable(
    std::string("CUDA could not ") + action + ": " + cudaGetErrorString(error) + Advise(error));
}

void InjectCudaError(std::int64_t calls, cudaError_t error)
{
  InjectedError = error;
  FailingCall = calls > 0 ? NumberOfCalls + calls : -1;
}

cudaError_t BeginCudaCall()
{
  return ++NumberOfCalls == FailingCall ? InjectedError.load() : cudaSuccess;
}

//------------------------------------------------------------------------------
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
    static IdleContexts* idle = new IdleContexts;
    return *idle;
  }
};

/// Calls use(contexts) while no other thread does.
template <typename Use>
auto WithIdleContexts(const Use& use)
{
  IdleContexts& idle = IdleContexts::Get();
  const std::lock_guard<std::mutex> lock(idle.Mutex);
  return use(idle.Contexts);
}

CudaStream MakeStream()
{
  cudaStream_t stream = nullptr;
  CallCuda("make a stream", cudaStreamCreateWithFlags, &stream, cudaStreamNonBlocking);
  return CudaStream(stream);
}

CudaEvent MakeEvent()
{
  cudaEvent_t event = nullptr;
  CallCuda("make an event", cudaEventCreateWithFlags, &event, cudaEventDisableTiming);
  return CudaEvent(event);
}

PageLocked LockPages(std::size_t bytes)
{
  void* memory = nullptr;
  CallCuda("allocate page-locked memory",
    [&] { return cudaHostAlloc(&memory, bytes, cudaHostAllocPortable | cudaHostAllocMapped); });
  return PageLocked(memory);
}

}

CudaContext::CudaContext(const std::vector<int>& devices)
  : Devices(devices),
    Device(devices.front())
{
  cudaGetLastError(); // clears errors of other code
  const CurrentDevice current(this->Device); // streams and events belong to it
  cudaDeviceProp properties;
  CallCuda("read the device's properties", cudaGetDeviceProperties, &properties, this->Device);
  this->Name = properties.name;
  this->Multiprocessors = properties.multiProcessorCount;
  this->CacheBytes = static_cast<std::size_t>(properties.l2CacheSize);
  this->Stream = MakeStream();
  this->CallerDone = MakeEvent();
  this->StreamDone = MakeEvent();
  this->Result = LockPages(ResultBytes);
  this->Pool.reset(new DeviceMemory(this->Device, this->Stream));
  for (std::size_t i = 1; i < devices.size(); ++i)
  {
    const CurrentDevice other(devices[i]);
    CudaStream stream = MakeStream();
    this->Others.push_back({ devices[i], std::move(stream), MakeEvent() });
  }
  if (!this->Others.empty())
  {
    this->Shared.reset(new SharedMemory(devices, *this->Pool));
    this->Name = std::to_string(devices.size()) + " x " + this->Name;
  }
  for (std::size_t slot = 0; slot < StagingSlots * devices.size(); ++slot)
  {
    const std::size_t device = slot % devices.size();
    const CurrentDevice owner(devices[device]);
    const cudaStream_t stream = device == 0 ? this->Stream : this->Others[device - 1].Stream;
    this->Staging.push_back({ stream, PageLocked(), MakeEvent() });
  }
}

CudaContext::~CudaContext()
{
  for (const DeviceStreams& other : this->Others)
  {
    cudaStreamSynchronize(other.Stream); // it may still use the memory
  }
}

const StagingBuffer& CudaContext::GetBuffer(std::int64_t i)
{
  StagingBuffer& buffer = this->Staging[i % this->Staging.size()];
  if (!buffer.Memory)
  {
    buffer.Memory = LockPages(StagingBytes);
  }
  return buffer;
}

Memory& CudaContext::GetMemory() const
{
  if (this->Shared)
  {
    return *this->Shared;
  }
  return *this->Pool;
}

std::size_t CudaContext::TakePeak()
{
  std::size_t peak = this->Pool->TakePeak();
  if (this->Shared)
  {
    peak += this->Shared->TakePeak();
  }
  return peak;
}

void CudaContext::LetWait(cudaStream_t stream, cudaStream_t other, cudaEvent_t event)
{
  CallCuda("record an event", cudaEventRecord, event, other);
  CallCuda("wait for an event", cudaStreamWaitEvent, stream, event, 0);
}

void CudaContext::Fork() const
{
  for (const DeviceStreams& other : this->Others)
  {
    LetWait(other.Stream, this->Stream, this->StreamDone);
  }
}

void CudaContext::Join() const
{
  for (const DeviceStreams& other : this->Others)
  {
    LetWait(this->Stream, other.Stream, other.Done);
  }
}

CurrentDevice::CurrentDevice(int device)
{
  CallCuda("ask for the current device", cudaGetDevice, &this->Previous);
  CallCuda("use the device", cudaSetDevice, device);
}

CurrentDevice::~CurrentDevice()
{
  // The previous device need not be usable, e.g. if another process has it alone.
  if (cudaSetDevice(this->Previous) != cudaSuccess)
  {
    cudaGetLastError(); // else the next launch would seem to have failed
  }
}

ContextLease LeaseContext(const std::vector<int>& devices)
{
  ContextLease idle = WithIdleContexts(
    [&](auto& contexts)
    {
      const auto found = std::find_if(contexts.begin(), contexts.end(),
        [&](const auto& context) { return context->Devices == devices; });
      ContextLease taken;
      if (found != contexts.end())
      {
        taken.reset(found->release());
        contexts.erase(found);
      }
      return taken;
    });
  if (idle)
  {
    return idle;
  }
  return ContextLease(new CudaContext(devices));
}

void ContextReturn::operator()(CudaContext* context) const noexcept
{
  std::unique_ptr<CudaContext> returned(context);
  bool isGood = cudaStreamSynchronize(context->Stream) == cudaSuccess;
  for (const DeviceStreams& other : context->Others)
  {
    isGood = cudaStreamSynchronize(other.Stream) == cudaSuccess && isGood;
  }
  if (!isGood)
  {
    return;
  }
  try
  {
    WithIdleContexts([&](auto& contexts) { contexts.push_back(std::move(returned)); });
  }
  catch (const std::bad_alloc&) // no memory for the list
  {
  }
}

namespace
{
cudaError_t CountDevices(int& devices)
{
  devices = 0;
  const cudaError_t error = HasCudaDriver() ? cudaGetDeviceCount(&devices) : cudaErrorNoDevice;
  cudaGetLastError();
  return error;
}
}

bool HasCudaDevice()
{
  // A driver that is installed but too old deserves a warning.
  int devices = 0;
  return CountDevices(devices) != cudaErrorNoDevice;
}

int CountCudaDevices()
{
  int devices = 0;
  return CountDevices(devices) == cudaSuccess ? devices : 0;
}

void ReleaseCudaMemory() { ReleaseIdleMemory(); }

bool ReleaseIdleMemory()
{
  return !WithIdleContexts([](auto& contexts) { return std::move(contexts); }).empty();
}

std::size_t TakePeakCudaMemory()
{
  return WithIdleContexts(
    [](auto& contexts)
    {
      std::size_t peak = 0;
      for (const auto& context : contexts)
      {
        peak = std::max(peak, context->TakePeak());
      }
      return peak;
    });
}

int FindDeviceOf(const void* memory)
{
  cudaPointerAttributes attributes = {};
  CallCuda("find the GPU that has an array", cudaPointerGetAttributes, &attributes, memory);
  const bool isOnDevice =
    attributes.type == cudaMemoryTypeDevice || attributes.type == cudaMemoryTypeManaged;
  return isOnDevice ? attributes.device : -1;
}

void CopyMemory(const void* from, std::int64_t bytes, void* to, const DeviceStream& stream)
{
  if (bytes == 0)
  {
    return;
  }
  // The device that the default stream belongs to.
  const CurrentDevice current(std::max(FindDeviceOf(from), FindDeviceOf(to)));
  const auto handle = static_cast<cudaStream_t>(stream.Handle);
  CallCuda(
    "copy between host and GPU", cudaMemcpyAsync, to, from, bytes, cudaMemcpyDefault, handle);
  CallCuda("finish a copy", cudaStreamSynchronize, handle);
}

}
