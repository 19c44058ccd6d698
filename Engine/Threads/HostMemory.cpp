// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "HostMemory.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <new>

// AddressSanitizer guards the ends of blocks from the heap only.
#if defined(__linux__) && !defined(__SANITIZE_ADDRESS__)
#define DELAUNAYFLIP_MAPS_MEMORY
#include <sys/mman.h>
#include <unistd.h>
#endif

namespace delaunayflip
{

namespace
{
constexpr std::size_t CacheLine = 64;

void* AllocateFromHeap(std::size_t bytes)
{
  void* memory = nullptr;
  if (posix_memalign(&memory, CacheLine, bytes > 0 ? bytes : 1) != 0)
  {
    throw std::bad_alloc();
  }
  return memory;
}
}

#if defined(DELAUNAYFLIP_MAPS_MEMORY)

namespace
{
constexpr std::size_t HugePage = std::size_t(2) << 20;
constexpr std::size_t SmallestMapped = HugePage / 2;

std::size_t RoundUp(std::size_t bytes, std::size_t unit)
{
  return (bytes + unit - 1) / unit * unit;
}

/// Whole huge pages, where an eighth of the block at most stays unused.
std::size_t GetMappedSize(std::size_t bytes)
{
  const std::size_t size = RoundUp(bytes, HugePage);
  const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  return size - bytes <= bytes / 8 ? size : RoundUp(bytes, page);
}

std::size_t GetHugeSize(std::size_t mapped) { return mapped / HugePage * HugePage; }

/// Address space that begins at a huge page.
char* MapPages(std::size_t bytes)
{
  void* mapped =
    mmap(nullptr, bytes + HugePage, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (mapped == MAP_FAILED)
  {
    throw std::bad_alloc();
  }
  char* begin = static_cast<char*>(mapped);
  const std::size_t before =
    (HugePage - reinterpret_cast<std::uintptr_t>(begin) % HugePage) % HugePage;
  if (before > 0)
  {
    munmap(begin, before);
  }
  munmap(begin + before + bytes, HugePage - before);
  return begin + before;
}
}

HostMemory::~HostMemory()
{
  while (this->Spare)
  {
    SpareSpan* span = this->Spare;
    this->Spare = span->Next;
    munmap(span, span->Bytes);
  }
}

void* HostMemory::Allocate(std::size_t bytes)
{
  if (bytes < SmallestMapped)
  {
    return AllocateFromHeap(bytes);
  }
  const std::size_t size = GetMappedSize(bytes);
  const std::size_t huge = GetHugeSize(size);
  char* begin = MapPages(size);
  const std::size_t moved = this->MoveSpare(begin, huge);
  if (moved < huge)
  {
    madvise(begin + moved, huge - moved, MADV_HUGEPAGE);
  }
  return begin;
}

void HostMemory::Free(void* memory, std::size_t bytes) noexcept
{
  if (bytes < SmallestMapped)
  {
    std::free(memory);
    return;
  }
  const std::size_t size = GetMappedSize(bytes);
  const std::size_t huge = GetHugeSize(size);
  if (huge < size)
  {
    munmap(static_cast<char*>(memory) + huge, size - huge);
  }
  if (huge > 0)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    this->Spare = new (memory) SpareSpan{ this->Spare, huge };
  }
}

/// Moves spare pages to mapped address space. @returns how many bytes of it.
std::size_t HostMemory::MoveSpare(char* target, std::size_t bytes)
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  std::size_t moved = 0;
  while (moved < bytes && this->Spare)
  {
    SpareSpan* span = this->Spare;
    SpareSpan* next = span->Next;
    const std::size_t size = std::min(span->Bytes, bytes - moved);
    span->Bytes -= size;
    char* from = reinterpret_cast<char*>(span) + span->Bytes;
    this->Spare = span->Bytes > 0 ? span : next;
    if (mremap(from, size, size, MREMAP_MAYMOVE | MREMAP_FIXED, target + moved) == MAP_FAILED)
    {
      span->Bytes += size;
      this->Spare = span;
      break;
    }
    moved += size;
  }
  return moved;
}

#else

HostMemory::~HostMemory() = default;

void* HostMemory::Allocate(std::size_t bytes) { return AllocateFromHeap(bytes); }

void HostMemory::Free(void* memory, std::size_t) noexcept { std::free(memory); }

std::size_t HostMemory::MoveSpare(char*, std::size_t) { return 0; }

#endif

}
