// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Array.h"

#include <cstdint>

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
constexpr std::size_t HugePage = std::size_t(2) << 20;

#if defined(DELAUNAYFLIP_MAPS_MEMORY)
constexpr std::size_t SmallestMapped = std::size_t(1) << 18;

/// Maps memory that begins at a huge page if it is to have any. The address space before it stays
/// unused; what follows the block does too, and none of it costs memory.
void* MapMemory(std::size_t bytes)
{
  const std::size_t slack = bytes >= 2 * HugePage ? HugePage : 0;
  void* mapped =
    mmap(nullptr, bytes + slack, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (mapped == MAP_FAILED)
  {
    throw std::bad_alloc();
  }
  char* begin = static_cast<char*>(mapped);
  if (slack > 0)
  {
    const std::size_t skipped =
      (HugePage - reinterpret_cast<std::uintptr_t>(begin) % HugePage) % HugePage;
    if (skipped > 0)
    {
      munmap(begin, skipped);
    }
    begin += skipped;
    // The block's last page may be shared with the slack behind it.
    const std::size_t page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
    char* end = begin + (bytes + page - 1) / page * page;
    char* mappedEnd = static_cast<char*>(mapped) + bytes + slack;
    if (end < mappedEnd)
    {
      munmap(end, mappedEnd - end);
    }
    madvise(begin, bytes / HugePage * HugePage, MADV_HUGEPAGE);
  }
  return begin;
}
#endif

class HostMemory : public Memory
{
public:
  void* Allocate(std::size_t bytes) override
  {
#if defined(DELAUNAYFLIP_MAPS_MEMORY)
    if (bytes >= SmallestMapped)
    {
      return MapMemory(bytes);
    }
#endif
    void* memory = nullptr;
    if (posix_memalign(&memory, CacheLine, bytes > 0 ? bytes : 1) != 0)
    {
      throw std::bad_alloc();
    }
    return memory;
  }

  void Free(void* memory, std::size_t bytes) noexcept override
  {
#if defined(DELAUNAYFLIP_MAPS_MEMORY)
    if (bytes >= SmallestMapped)
    {
      munmap(memory, bytes);
      return;
    }
#endif
    (void)bytes;
    std::free(memory);
  }
};
}

Memory& Memory::OfHost()
{
  static HostMemory memory;
  return memory;
}

}
