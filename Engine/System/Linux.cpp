// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CudaSupport.h"
#include "SystemMemory.h"

#include <cstdlib>
#include <new>
#include <sys/mman.h>

namespace delaunayflip
{

namespace
{
/// Smaller arrays come from the heap, which gives the pages of freed ones to the next: to have them
/// from the system takes a fifth of the time of 100,000 points on two threads.
constexpr std::size_t SmallestMapped = std::size_t(16) << 20;

#if defined(__SANITIZE_ADDRESS__)
constexpr bool MapsMemory = false; // AddressSanitizer guards the ends of heap allocations only
#else
constexpr bool MapsMemory = true;
#endif

constexpr bool IsMapped(std::size_t bytes) { return MapsMemory && bytes >= SmallestMapped; }
}

void* AllocateFromSystem(std::size_t bytes)
{
  void* memory = nullptr;
  if (IsMapped(bytes))
  {
    memory = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED)
    {
      throw std::bad_alloc();
    }
    madvise(memory, bytes, MADV_HUGEPAGE);
    return memory;
  }
  if (posix_memalign(&memory, CacheLine, bytes > 0 ? bytes : 1) != 0)
  {
    throw std::bad_alloc();
  }
  return memory;
}

void FreeToSystem(void* memory, std::size_t bytes) noexcept
{
  if (IsMapped(bytes))
  {
    munmap(memory, bytes);
    return;
  }
  std::free(memory);
}

const char* ExplainNoCuda()
{
#if defined(DELAUNAYFLIP_WITHOUT_CUDA) && !defined(__x86_64__)
  return " (built without CUDA for this platform)";
#else
  return "";
#endif
}

}
