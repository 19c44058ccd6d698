// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "DeviceMemory.h"

#include "CudaContext.h"
#include "FlipError.h"

#include <cuda.h>

#include <algorithm>
#include <new>
#include <string>
#include <utility>

namespace delaunayflip
{

namespace
{
/// Calls allocate(), and if it fails once more without the memory that is kept for later runs.
/// Other runs, on other sets of GPUs or at the same time, may have left it.
/// @throws BackendUnavailable.
template <typename Allocate>
void* AllocateOrRelease(const Allocate& allocate)
{
  try
  {
    return allocate();
  }
  catch (const BackendUnavailable&)
  {
    if (!ReleaseIdleMemory())
    {
      throw;
    }
    return allocate();
  }
}
}

DeviceMemory::DeviceMemory(int device, cudaStream_t stream)
  : Device(device),
    Stream(stream)
{
  cudaMemPoolProps properties = {};
  properties.allocType = cudaMemAllocationTypePinned;
  properties.location.type = cudaMemLocationTypeDevice;
  properties.location.id = device;
  CallCuda("make a memory pool", cudaMemPoolCreate, &this->Pool, &properties);
  std::uint64_t keepAll = UINT64_MAX;
  if (cudaMemPoolSetAttribute(this->Pool, cudaMemPoolAttrReleaseThreshold, &keepAll) != cudaSuccess)
  {
    cudaGetLastError(); // it works without, but slower
  }
}

DeviceMemory::~DeviceMemory() { cudaMemPoolDestroy(this->Pool); }

void* DeviceMemory::Allocate(std::size_t bytes)
{
  constexpr std::size_t Least = 256;
  const std::size_t size = std::max(bytes, Least);
  return AllocateOrRelease(
    [&]()
    {
      void* memory = nullptr;
      CallCuda("allocate memory",
        [&] { return cudaMallocFromPoolAsync(&memory, size, this->Pool, this->Stream); });
      return memory;
    });
}

void DeviceMemory::Free(void* memory, std::size_t) noexcept
{
  if (cudaFreeAsync(memory, this->Stream) != cudaSuccess)
  {
    cudaGetLastError(); // there is no caller to report to
  }
}

void DeviceMemory::AllowAccess(const std::vector<int>& devices)
{
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
    CallCuda("share memory", cudaMemPoolSetAccess, this->Pool, &access, 1);
  }
}

std::size_t DeviceMemory::TakePeak()
{
  std::uint64_t peak = 0, reset = 0;
  cudaMemPoolGetAttribute(this->Pool, cudaMemPoolAttrUsedMemHigh, &peak);
  cudaMemPoolSetAttribute(this->Pool, cudaMemPoolAttrUsedMemHigh, &reset);
  return peak;
}

namespace
{
/// A function of the driver. The engine is not linked with it, because it must load without one.
struct DriverFunction
{
  void* Found = nullptr;

  explicit DriverFunction(const char* name)
  {
    CallCuda("find a function of the driver",
      [&]
      {
        cudaDriverEntryPointQueryResult status = cudaDriverEntryPointSymbolNotFound;
#if CUDART_VERSION >= 12050
        constexpr unsigned Version = 11000; // has them all
        const cudaError_t error =
          cudaGetDriverEntryPointByVersion(name, &this->Found, Version, cudaEnableDefault, &status);
#else
        const cudaError_t error =
          cudaGetDriverEntryPoint(name, &this->Found, cudaEnableDefault, &status);
#endif
        if (error == cudaSuccess && (status != cudaDriverEntryPointSuccess || !this->Found))
        {
          return cudaErrorNotSupported;
        }
        return error;
      });
  }

  template <typename Function>
  operator Function() const // NOLINT(google-explicit-constructor)
  {
    return reinterpret_cast<Function>(this->Found);
  }
};

struct Driver
{
  const decltype(&cuMemGetAllocationGranularity) GetGranularity =
    DriverFunction("cuMemGetAllocationGranularity");
  const decltype(&cuMemAddressReserve) Reserve = DriverFunction("cuMemAddressReserve");
  const decltype(&cuMemAddressFree) FreeAddress = DriverFunction("cuMemAddressFree");
  const decltype(&cuMemCreate) Create = DriverFunction("cuMemCreate");
  const decltype(&cuMemRelease) Release = DriverFunction("cuMemRelease");
  const decltype(&cuMemMap) Map = DriverFunction("cuMemMap");
  const decltype(&cuMemUnmap) Unmap = DriverFunction("cuMemUnmap");
  const decltype(&cuMemSetAccess) SetAccess = DriverFunction("cuMemSetAccess");

  static const Driver& Get()
  {
    static const Driver driver{};
    return driver;
  }
};

/// The driver's errors have the numbers of the runtime's.
template <typename Call>
void CallDriver(const char* action, const Call& call)
{
  CallCuda(action, [&] { return static_cast<cudaError_t>(call()); });
}

CUmemAllocationProp DescribeMemory(int device)
{
  CUmemAllocationProp properties = {};
  properties.type = CU_MEM_ALLOCATION_TYPE_PINNED;
  properties.location.type = CU_MEM_LOCATION_TYPE_DEVICE;
  properties.location.id = device;
  return properties;
}

CUdeviceptr ToAddress(const void* memory) { return reinterpret_cast<CUdeviceptr>(memory); }

/// @throws BackendUnavailable.
void RequireConnected(const std::vector<int>& devices)
{
  const auto ask = [](cudaDeviceP2PAttr attribute, int first, int second)
  {
    int answer = 0;
    CallCuda(
      "ask how GPUs are connected", cudaDeviceGetP2PAttribute, &answer, attribute, first, second);
    return answer;
  };
  for (const int first : devices)
  {
    for (const int second : devices)
    {
      if (first != second &&
        (ask(cudaDevP2PAttrAccessSupported, first, second) == 0 ||
          ask(cudaDevP2PAttrNativeAtomicSupported, first, second) == 0))
      {
        throw BackendUnavailable("GPUs " + std::to_string(first) + " and " +
          std::to_string(second) +
          " cannot share a mesh, because they cannot do atomic operations in each other's memory "
          "(that needs NVLink); use one of them");
      }
    }
  }
}

}

SharedMemory::SharedMemory(std::vector<int> devices, DeviceMemory& small)
  : Devices(std::move(devices)),
    Small(small)
{
  RequireConnected(this->Devices);
  this->Small.AllowAccess(this->Devices);
  for (const int device : this->Devices)
  {
    const CUmemAllocationProp properties = DescribeMemory(device);
    std::size_t granularity = 0;
    CallDriver("ask for the granularity of memory",
      [&]
      {
        return Driver::Get().GetGranularity(
          &granularity, &properties, CU_MEM_ALLOC_GRANULARITY_RECOMMENDED);
      });
    this->Granularity = std::max(this->Granularity, granularity);
  }
}

SharedMemory::~SharedMemory() { this->ReleaseIdle(); }

bool SharedMemory::IsSmall(std::size_t bytes) const
{
  return bytes < this->Devices.size() * this->Granularity;
}

std::size_t SharedMemory::GetPartSize(std::size_t bytes) const
{
  const std::size_t step = this->Devices.size() * this->Granularity;
  return (bytes + step - 1) / step * this->Granularity;
}

void* SharedMemory::Allocate(std::size_t bytes)
{
  if (this->IsSmall(bytes))
  {
    return this->Small.Allocate(bytes);
  }
  const std::size_t part = this->GetPartSize(bytes);
  const auto idle = this->Idle.find(part);
  void* memory = nullptr;
  if (idle != this->Idle.end())
  {
    memory = idle->second;
    this->Idle.erase(idle);
  }
  else
  {
    try
    {
      memory = this->Map(part);
    }
    catch (const BackendUnavailable&)
    {
      this->ReleaseIdle();
      memory = AllocateOrRelease([&]() { return this->Map(part); });
    }
  }
  this->Used += part * this->Devices.size();
  this->Peak = std::max(this->Peak, this->Used);
  return memory;
}

void SharedMemory::Free(void* memory, std::size_t bytes) noexcept
{
  if (this->IsSmall(bytes))
  {
    this->Small.Free(memory, bytes);
    return;
  }
  const std::size_t part = this->GetPartSize(bytes);
  this->Used -= part * this->Devices.size();
  try
  {
    this->Idle.emplace(part, memory);
  }
  catch (const std::bad_alloc&)
  {
    this->Unmap(memory, part);
  }
}

std::size_t SharedMemory::TakePeak() { return std::exchange(this->Peak, this->Used); }

void* SharedMemory::Map(std::size_t part) const
{
  const Driver& driver = Driver::Get();
  const std::size_t size = part * this->Devices.size();
  CUdeviceptr base = 0;
  CallDriver("reserve addresses", [&] { return driver.Reserve(&base, size, 0, 0, 0); });
  std::size_t mapped = 0;
  try
  {
    std::vector<CUmemAccessDesc> access;
    for (const int device : this->Devices)
    {
      const CUmemAllocationProp properties = DescribeMemory(device);
      CUmemGenericAllocationHandle handle = 0;
      CallDriver("allocate memory", [&] { return driver.Create(&handle, part, &properties, 0); });
      const CUresult result = driver.Map(base + mapped, part, 0, handle, 0);
      driver.Release(handle); // the mapping keeps it
      CallDriver("map memory", [&] { return result; });
      mapped += part;
      access.push_back({ properties.location, CU_MEM_ACCESS_FLAGS_PROT_READWRITE });
    }
    CallDriver(
      "share memory", [&] { return driver.SetAccess(base, size, access.data(), access.size()); });
  }
  catch (...)
  {
    if (mapped > 0)
    {
      driver.Unmap(base, mapped);
    }
    driver.FreeAddress(base, size);
    throw;
  }
  return reinterpret_cast<void*>(base);
}

/// Waits for the stream that gives the work of all GPUs its order: the driver does not know whether
/// one of them still uses the memory.
void SharedMemory::Unmap(void* memory, std::size_t part) const noexcept
{
  const Driver& driver = Driver::Get();
  const std::size_t size = part * this->Devices.size();
  this->Small.Synchronize();
  driver.Unmap(ToAddress(memory), size);
  driver.FreeAddress(ToAddress(memory), size);
}

void SharedMemory::ReleaseIdle() noexcept
{
  for (const auto& [part, memory] : this->Idle)
  {
    this->Unmap(memory, part);
  }
  this->Idle.clear();
}

}
