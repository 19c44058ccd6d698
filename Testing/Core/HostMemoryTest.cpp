// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "HostMemory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <thread>
#include <vector>

#if defined(__linux__)
#include <sys/mman.h>
#include <unistd.h>
#endif

namespace delaunayflip
{
namespace
{

constexpr std::size_t Megabyte = std::size_t(1) << 20;

Array<std::uint8_t> MakeBlock(std::size_t bytes, std::uint8_t value, HostMemory& memory)
{
  Array<std::uint8_t> block(bytes, memory);
  std::fill_n(block.Data(), bytes, value);
  return block;
}

bool Holds(const Array<std::uint8_t>& block, std::uint8_t value)
{
  return std::all_of(block.Data(), block.Data() + block.Size(),
    [value](std::uint8_t byte) { return byte == value; });
}

TEST(HostMemory, BlocksKeepWhatTheyHoldWhilePagesMove)
{
  HostMemory memory;
  std::vector<Array<std::uint8_t>> blocks;
  // Some from the heap, some of pages, and larger ones made of what was freed.
  std::size_t size = Megabyte - 1;
  for (int round = 0; round < 60; ++round)
  {
    blocks.push_back(MakeBlock(size, static_cast<std::uint8_t>(round), memory));
    ASSERT_EQ(reinterpret_cast<std::uintptr_t>(blocks.back().Data()) % 64, 0u);
    if (round % 3 == 2)
    {
      blocks.erase(blocks.begin() + round % 5);
    }
    for (const Array<std::uint8_t>& block : blocks)
    {
      ASSERT_TRUE(Holds(block, block[0])) << "round " << round;
    }
    size = size * 7 / 3 % (13 * Megabyte) + 1;
  }
}

TEST(HostMemory, ServesThreadsAtOnce)
{
  HostMemory memory;
  std::vector<std::thread> threads;
  std::vector<int> damaged(4, 0);
  for (std::size_t i = 0; i < damaged.size(); ++i)
  {
    threads.emplace_back(
      [&, i]
      {
        for (std::size_t round = 1; round <= 50; ++round)
        {
          const auto value = static_cast<std::uint8_t>(10 * i + round);
          const Array<std::uint8_t> block = MakeBlock(round * i * 100000, value, memory);
          damaged[i] += Holds(block, value) ? 0 : 1;
        }
      });
  }
  for (std::thread& thread : threads)
  {
    thread.join();
  }
  EXPECT_EQ(damaged, std::vector<int>(4, 0));
}

#if defined(__linux__) && !defined(__SANITIZE_ADDRESS__)
/// How many of a block's pages are in memory.
std::size_t CountResident(Array<std::uint8_t>& block)
{
  const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  std::vector<unsigned char> resident((block.Size() + page - 1) / page);
  EXPECT_EQ(mincore(block.Data(), block.Size(), resident.data()), 0);
  return std::count_if(
    resident.begin(), resident.end(), [](unsigned char flags) { return (flags & 1) != 0; });
}

TEST(HostMemory, PagesOfFreedBlocksServeTheNext)
{
  HostMemory memory;
  const Array<std::uint8_t> other = MakeBlock(4 * Megabyte, 1, memory);
  MakeBlock(6 * Megabyte, 2, memory);
  MakeBlock(4 * Megabyte, 3, memory);
  Array<std::uint8_t> next(10 * Megabyte, memory);
  const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  // The second block took pages of the first.
  EXPECT_EQ(CountResident(next), 6 * Megabyte / page);
  EXPECT_TRUE(Holds(other, 1));
}
#endif

}
}
