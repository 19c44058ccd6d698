// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_EDGEWORKLIST_H
#define DELAUNAYFLIP_EDGEWORKLIST_H

#include "EdgeMesh.h"
#include "FlipSteps.h"
#include "ThreadBackend.h"

#include <algorithm>
#include <cstdint>
#include <vector>

/// @file
/// The worklist of a range of edges: blocks of 1024, a flag for every block that holds something to
/// do. An iteration looks at flagged blocks only and finds its edges by their states, in order,
/// each once, so it costs what is active in it.

namespace delaunayflip
{

class EdgeWorklist
{
public:
  /// Edges [first, last), every block active.
  EdgeWorklist(const EdgeState* states, std::int64_t first, std::int64_t last)
    : States(states),
      FirstEdge(first),
      LastEdge(last),
      FirstBlock(first >> BlockFlags::BlockBits),
      Flags(first < last ? ((last - 1) >> BlockFlags::BlockBits) - FirstBlock + 1 : 0, 1)
  {
  }

  /// Where steps flag the blocks of edges that they make candidates.
  BlockFlags GetFlags() { return { this->Flags.data(), this->FirstEdge, this->LastEdge }; }

  void ActivateAll() { std::fill(this->Flags.begin(), this->Flags.end(), 1); }

  /// Takes the flagged blocks as those of the coming steps and clears the flags.
  void Gather()
  {
    this->Blocks.clear();
    for (std::size_t block = 0; block < this->Flags.size(); ++block)
    {
      if (this->Flags[block])
      {
        this->Blocks.push_back(this->FirstBlock + static_cast<std::int64_t>(block));
        this->Flags[block] = 0;
      }
    }
  }

  /// Runs the steps on the gathered blocks on threads, all of them on one block before the next:
  /// for steps that write nothing which another edge's step reads. Blocks in which an edge stays
  /// bad or blocked after a CountStep are flagged again. @returns what the steps counted.
  template <typename... Steps>
  StepCounts Run(const ThreadBackend& backend, const Steps&... steps)
  {
    return backend.Sum<StepCounts>(
      static_cast<std::int64_t>(this->Blocks.size()),
      [&](std::int64_t begin, std::int64_t end) { return this->RunBlocks(begin, end, steps...); },
      BlocksPerTask);
  }

  /// The same on the calling thread.
  template <typename... Steps>
  StepCounts Run(const Steps&... steps)
  {
    return this->RunBlocks(0, static_cast<std::int64_t>(this->Blocks.size()), steps...);
  }

private:
  static constexpr std::int64_t BlocksPerTask = 8;
  static constexpr std::int64_t WordSize = 8; ///< Edges whose states fill a machine word.
  /// Edges between the request for a cache line and its use.
  static constexpr std::int64_t PrefetchDistance = 8;

  template <typename... Steps>
  StepCounts RunBlocks(std::int64_t begin, std::int64_t end, const Steps&... steps)
  {
    StepCounts counts;
    for (std::int64_t i = begin; i < end; ++i)
    {
      StepCounts block;
      (this->RunOnBlock(steps, this->Blocks[i], block), ...);
      if (block.Bad + block.Blocked > 0)
      {
        this->Flags[this->Blocks[i] - this->FirstBlock] = 1;
      }
      counts += block;
    }
    return counts;
  }

  static void RunOnEdges(
    const CountStep& step, const EdgeId* edges, std::int64_t size, StepCounts& counts)
  {
    for (std::int64_t i = 0; i < size; ++i)
    {
      step(edges[i], counts);
    }
  }

  /// Two requests ahead of every edge: its triangles, then what their contents lead to.
  template <typename Step>
  static void RunOnEdges(
    const Step& step, const EdgeId* edges, std::int64_t size, StepCounts& counts)
  {
    for (std::int64_t i = 0; i < size + 2 * PrefetchDistance; ++i)
    {
      if (i < size)
      {
        PrefetchTriangles(step.Mesh, edges[i]);
      }
      if (i >= PrefetchDistance && i - PrefetchDistance < size)
      {
        step.Prefetch(edges[i - PrefetchDistance]);
      }
      if (i >= 2 * PrefetchDistance)
      {
        step(edges[i - 2 * PrefetchDistance], counts);
      }
    }
  }

  template <typename Step>
  void RunOnBlock(const Step& step, std::int64_t block, StepCounts& counts) const
  {
    EdgeId edges[BlockFlags::BlockSize];
    RunOnEdges(step, edges, this->Find(Step::Wanted, block, edges), counts);
  }

  /// Stores the edges of a block in a wanted state. @returns how many.
  std::int64_t Find(StateRange wanted, std::int64_t block, EdgeId* found) const
  {
    const std::int64_t first = std::max(this->FirstEdge, block << BlockFlags::BlockBits);
    const std::int64_t last = std::min(this->LastEdge, (block + 1) << BlockFlags::BlockBits);
    std::int64_t count = 0;
    for (std::int64_t word = first / WordSize; word * WordSize < last; ++word)
    {
      std::uint64_t matches = this->MatchWord(wanted, word, first, last);
      while (matches != 0)
      {
        found[count++] = static_cast<EdgeId>(word * WordSize + __builtin_ctzll(matches) / WordSize);
        matches &= matches - 1;
      }
    }
    return count;
  }

  /// The eight states of a word at once: the top bit of every byte tells whether that edge lies in
  /// [first, last) and its state in the range. States are below 16, so bytes do not carry.
  std::uint64_t MatchWord(
    StateRange wanted, std::int64_t word, std::int64_t first, std::int64_t last) const
  {
    constexpr std::uint64_t EveryByte = 0x0101010101010101u;
    constexpr std::uint64_t TopBits = 0x80 * EveryByte;
    using Word __attribute__((may_alias)) = std::uint64_t;
    const Word* words = reinterpret_cast<const Word*>(this->States);
    const std::uint64_t states = __atomic_load_n(words + word, __ATOMIC_RELAXED);
    const std::uint64_t atLeastFirst =
      states + (0x80 - static_cast<std::uint64_t>(wanted.First)) * EveryByte;
    const std::uint64_t aboveLast =
      states + (0x7F - static_cast<std::uint64_t>(wanted.Last)) * EveryByte;
    std::uint64_t matches = atLeastFirst & ~aboveLast & TopBits;
    const std::int64_t before = first - word * WordSize;
    const std::int64_t after = (word + 1) * WordSize - last;
    matches &= before > 0 ? ~std::uint64_t(0) << (8 * before) : ~std::uint64_t(0);
    matches &= after > 0 ? ~std::uint64_t(0) >> (8 * after) : ~std::uint64_t(0);
    return matches;
  }

  const EdgeState* States;
  std::int64_t FirstEdge;
  std::int64_t LastEdge;
  std::int64_t FirstBlock;
  std::vector<std::uint8_t> Flags;
  std::vector<std::int64_t> Blocks;
};

}

#endif
