// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Array.h"

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace delaunayflip
{

namespace
{
constexpr std::size_t CacheLine = 64;
constexpr std::size_t HugePage = std::size_t(2) << 20;
}

void* AllocateMemory(std::size_t bytes)
{
  // Only the address is aligned: a rounded size would touch up to a huge page more.
  const std::size_t alignment = bytes >= 2 * HugePage ? HugePage : CacheLine;
  void* memory = nullptr;
  if (posix_memalign(&memory, alignment, bytes > 0 ? bytes : 1) != 0)
  {
    throw std::bad_alloc();
  }
#if defined(__linux__)
  if (alignment == HugePage)
  {
    madvise(memory, bytes / HugePage * HugePage, MADV_HUGEPAGE);
  }
#endif
  return memory;
}

void FreeMemory(void* memory) noexcept { std::free(memory); }

}
