// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "HostMemory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <new>
#include <vector>

#if defined(__linux__)
#include <cerrno>
#include <sys/mman.h>
#endif

namespace delaunayflip
{
namespace
{

constexpr std::size_t Megabyte = std::size_t(1) << 20;

TEST(HostMemory, AllocationsAreAlignedAndDisjoint)
{
  HostMemory memory;
  std::vector<Array<std::uint8_t>> arrays;
  // Some allocations come from the heap, others are pages.
  for (const std::size_t bytes : { std::size_t(0), std::size_t(1), Megabyte - 1, Megabyte,
         Megabyte + 1, 2 * Megabyte, 3 * Megabyte - 1, 5 * Megabyte })
  {
    arrays.emplace_back(bytes, memory);
    ASSERT_EQ(0u, reinterpret_cast<std::uintptr_t>(arrays.back().Data()) % 64) << bytes;
    std::fill_n(arrays.back().Data(), bytes, static_cast<std::uint8_t>(arrays.size()));
  }
  for (std::size_t i = 0; i < arrays.size(); ++i)
  {
    const Array<std::uint8_t>& array = arrays[i];
    EXPECT_TRUE(std::all_of(
      array.Data(), array.Data() + array.Size(), [i](std::uint8_t byte) { return byte == i + 1; }))
      << i;
  }
}

#if defined(__linux__) && !defined(__SANITIZE_ADDRESS__)
TEST(HostMemory, TooMuchIsBadAlloc)
{
  HostMemory memory;
  EXPECT_THROW(memory.Allocate(std::numeric_limits<std::size_t>::max() / 4), std::bad_alloc);
}

TEST(HostMemory, LargeAllocationsGoBackToTheSystem)
{
  HostMemory memory;
  constexpr std::size_t Bytes = 64 * Megabyte;
  void* pages = memory.Allocate(Bytes);
  unsigned char isResident = 0;
  static_cast<char*>(pages)[0] = 1;
  EXPECT_EQ(0, mincore(pages, 1, &isResident));
  EXPECT_EQ(1, isResident & 1);
  memory.Free(pages, Bytes);
  // No longer mapped.
  EXPECT_EQ(-1, mincore(pages, 1, &isResident));
  EXPECT_EQ(ENOMEM, errno);
}
#endif

}
}
