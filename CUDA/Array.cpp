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
  const std::size_t alignment = bytes >= 2 * HugePage ? HugePage : CacheLine;
  const std::size_t rounded = (bytes / alignment + 1) * alignment;
  if (rounded < bytes)
  {
    throw std::bad_alloc();
  }
  void* memory = std::aligned_alloc(alignment, rounded);
  if (!memory)
  {
    throw std::bad_alloc();
  }
#if defined(__linux__)
  if (alignment == HugePage)
  {
    madvise(memory, rounded, MADV_HUGEPAGE);
  }
#endif
  return memory;
}

void FreeMemory(void* memory) noexcept { std::free(memory); }

}
