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

TEST(HostMemory, BlocksAreAlignedAndApart)
{
  HostMemory memory;
  std::vector<Array<std::uint8_t>> blocks;
  // Some from the heap, some of pages.
  for (const std::size_t bytes : { std::size_t(0), std::size_t(1), Megabyte - 1, Megabyte,
         Megabyte + 1, 2 * Megabyte, 3 * Megabyte - 1, 5 * Megabyte })
  {
    blocks.emplace_back(bytes, memory);
    ASSERT_EQ(0u, reinterpret_cast<std::uintptr_t>(blocks.back().Data()) % 64) << bytes;
    std::fill_n(blocks.back().Data(), bytes, static_cast<std::uint8_t>(blocks.size()));
  }
  for (std::size_t i = 0; i < blocks.size(); ++i)
  {
    const Array<std::uint8_t>& block = blocks[i];
    EXPECT_TRUE(std::all_of(
      block.Data(), block.Data() + block.Size(), [i](std::uint8_t byte) { return byte == i + 1; }))
      << i;
  }
}

#if defined(__linux__) && !defined(__SANITIZE_ADDRESS__)
TEST(HostMemory, TooMuchIsBadAlloc)
{
  HostMemory memory;
  EXPECT_THROW(memory.Allocate(std::numeric_limits<std::size_t>::max() / 4), std::bad_alloc);
}

TEST(HostMemory, LargeBlocksGoBackToTheSystem)
{
  HostMemory memory;
  constexpr std::size_t Bytes = 64 * Megabyte;
  void* block = memory.Allocate(Bytes);
  unsigned char isResident = 0;
  static_cast<char*>(block)[0] = 1;
  EXPECT_EQ(0, mincore(block, 1, &isResident));
  EXPECT_EQ(1, isResident & 1);
  memory.Free(block, Bytes);
  // Not mapped any more.
  EXPECT_EQ(-1, mincore(block, 1, &isResident));
  EXPECT_EQ(ENOMEM, errno);
}
#endif

}
}
