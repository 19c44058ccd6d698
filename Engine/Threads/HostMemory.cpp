// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "HostMemory.h"

#include <cstdlib>
#include <new>

// AddressSanitizer guards the ends of heap allocations only.
#if defined(__linux__) && !defined(__SANITIZE_ADDRESS__)
#define DELAUNAYFLIP_MAPS_MEMORY
#include <sys/mman.h>
#endif

namespace delaunayflip
{

namespace
{
constexpr std::size_t CacheLine = 64;

#if defined(DELAUNAYFLIP_MAPS_MEMORY)

constexpr std::size_t SmallestMapped = std::size_t(1) << 20; // half a huge page

bool IsMapped(std::size_t bytes) { return bytes >= SmallestMapped; }

/// Null where there is none.
void* MapPages(std::size_t bytes, bool areHuge)
{
  void* pages = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (pages == MAP_FAILED)
  {
    return nullptr;
  }
  madvise(pages, bytes, areHuge ? MADV_HUGEPAGE : MADV_NOHUGEPAGE);
  return pages;
}

void UnmapPages(void* pages, std::size_t bytes) { munmap(pages, bytes); }

#else

bool IsMapped(std::size_t) { return false; }
void* MapPages(std::size_t, bool) { return nullptr; }
void UnmapPages(void*, std::size_t) {}

#endif

/// Null where there is none.
void* AllocateFromHeap(std::size_t bytes)
{
  void* memory = nullptr;
  return posix_memalign(&memory, CacheLine, bytes > 0 ? bytes : 1) == 0 ? memory : nullptr;
}

void* Require(void* memory)
{
  if (!memory)
  {
    throw std::bad_alloc();
  }
  return memory;
}
}

void* HostMemory::Allocate(std::size_t bytes)
{
  return Require(IsMapped(bytes) ? MapPages(bytes, true) : AllocateFromHeap(bytes));
}

void* HostMemory::AllocateSparse(std::size_t bytes)
{
  return Require(IsMapped(bytes) ? MapPages(bytes, false) : AllocateFromHeap(bytes));
}

void HostMemory::Free(void* memory, std::size_t bytes) noexcept
{
  if (IsMapped(bytes))
  {
    UnmapPages(memory, bytes);
    return;
  }
  std::free(memory);
}

}
