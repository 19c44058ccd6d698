// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FailingAllocations.h"

#include <dlfcn.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <new>

namespace
{

std::atomic<bool> isOn{ false };
std::atomic<std::int64_t> left{ 0 };
std::atomic<std::size_t> smallestCounted{ 0 };
thread_local bool isSpared = false;

/// Whether the call from `caller` is the one to fail.
bool ShouldFail(std::size_t bytes, void* caller)
{
  if (!isOn || isSpared || bytes < smallestCounted)
  {
    return false;
  }
  Dl_info info;
  const bool isOurs = dladdr(caller, &info) && info.dli_fname &&
    std::strstr(info.dli_fname, "DelaunayFlipEngineAllocation");
  return isOurs && --left == 0;
}

void* AllocateOrThrow(std::size_t bytes, void* caller)
{
  void* memory = ShouldFail(bytes, caller) ? nullptr : std::malloc(bytes > 0 ? bytes : 1);
  if (!memory)
  {
    throw std::bad_alloc();
  }
  return memory;
}

}

FailingAllocations::FailingAllocations(std::int64_t number, std::size_t smallest)
{
  smallestCounted = smallest;
  left = number;
  isOn = true;
}

FailingAllocations::~FailingAllocations() { isOn = false; }

bool FailingAllocations::HasFailed() { return left <= 0; }

bool FailingAllocations::Stop()
{
  isOn = false;
  return HasFailed();
}

SparedAllocations::SparedAllocations()
  : WasSpared(isSpared)
{
  isSpared = true;
}

SparedAllocations::~SparedAllocations() { isSpared = this->WasSpared; }

void* operator new(std::size_t bytes)
{
  return AllocateOrThrow(bytes, __builtin_return_address(0));
}

void* operator new[](std::size_t bytes)
{
  return AllocateOrThrow(bytes, __builtin_return_address(0));
}

void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept
{
  return ShouldFail(bytes, __builtin_return_address(0)) ? nullptr
                                                        : std::malloc(bytes > 0 ? bytes : 1);
}

void* operator new[](std::size_t bytes, const std::nothrow_t&) noexcept
{
  return ShouldFail(bytes, __builtin_return_address(0)) ? nullptr
                                                        : std::malloc(bytes > 0 ? bytes : 1);
}

void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

// The symbols of this program replace those of its libraries only where they are visible.
#pragma GCC visibility push(default)
extern "C"
{

  void* __libc_memalign(std::size_t alignment, std::size_t bytes);

  int posix_memalign(void** memory, std::size_t alignment, std::size_t bytes)
  {
    *memory =
      ShouldFail(bytes, __builtin_return_address(0)) ? nullptr : __libc_memalign(alignment, bytes);
    return *memory ? 0 : ENOMEM;
  }

  void* mmap(void* place, std::size_t bytes, int protection, int flags, int file, off_t offset)
  {
    if (ShouldFail(bytes, __builtin_return_address(0)))
    {
      errno = ENOMEM;
      return MAP_FAILED;
    }
    return reinterpret_cast<void*>(
      syscall(SYS_mmap, place, bytes, protection, flags, file, offset));
  }
}

#pragma GCC visibility pop

#endif
