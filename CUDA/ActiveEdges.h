// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_ACTIVEEDGES_H
#define DELAUNAYFLIP_ACTIVEEDGES_H

#include "Array.h"
#include "EdgeMesh.h"
#include "FlipSteps.h"
#include "ThreadBackend.h"

#include <algorithm>
#include <cstdint>
#include <vector>

/// @file
/// The worklist: edges in blocks of 1024, a flag for every block that holds something to do. An
/// iteration looks at flagged blocks only, finds its edges by their states, in order, each once.

namespace delaunayflip
{

class ActiveEdges
{
public:
  static constexpr int BlockBits = 10;
  static constexpr std::int64_t BlockSize = std::int64_t(1) << BlockBits;

  /// Every block of `states` (size edges) is active at first.
  ActiveEdges(const EdgeState* states, std::int64_t size, const ThreadBackend& backend)
    : States(states),
      Size(size),
      Backend(backend),
      Flags((size + BlockSize - 1) / BlockSize, 1)
  {
  }

  /// One flag a block; a step sets that of a block to make it active from the next Gather on.
  std::uint8_t* GetFlags() { return this->Flags.data(); }

  /// Takes the flagged blocks as those of the coming iteration and clears the flags.
  void Gather()
  {
    this->Blocks.clear();
    for (std::size_t block = 0; block < this->Flags.size(); ++block)
    {
      if (this->Flags[block])
      {
        this->Blocks.push_back(static_cast<std::uint32_t>(block));
        this->Flags[block] = 0;
      }
    }
  }

  /// Flags the gathered blocks in which an edge is bad or blocked, so that they stay active.
  void KeepBadBlocks()
  {
    this->Backend.ForRange(
      static_cast<std::int64_t>(this->Blocks.size()),
      [this](std::int64_t begin, std::int64_t end)
      {
        EdgeId found[BlockSize];
        for (std::int64_t i = begin; i < end; ++i)
        {
          const std::uint32_t block = this->Blocks[i];
          this->Flags[block] = Find<CountStep>(this->First(block), this->Last(block), found) > 0;
        }
      },
      BlocksPerTask);
  }

  /// Runs the steps on the gathered blocks, all of them on one block before the next: for steps
  /// that write nothing which another edge's step reads. @returns what they counted.
  template <typename... Steps>
  StepCounts Run(const Steps&... steps) const
  {
    return this->Backend.Sum<StepCounts>(
      static_cast<std::int64_t>(this->Blocks.size()),
      [&](std::int64_t begin, std::int64_t end)
      {
        StepCounts counts;
        for (std::int64_t i = begin; i < end; ++i)
        {
          (this->RunOnBlock(steps, this->Blocks[i], counts), ...);
        }
        return counts;
      },
      BlocksPerTask);
  }

private:
  static constexpr std::int64_t BlocksPerTask = 8;
  /// Edges between the request for a cache line and its use.
  static constexpr std::int64_t PrefetchDistance = 8;

  std::int64_t First(std::uint32_t block) const { return std::int64_t(block) << BlockBits; }
  std::int64_t Last(std::uint32_t block) const
  {
    return std::min(this->Size, std::int64_t(block + 1) << BlockBits);
  }

  /// Stores the edges of [first, last) that `Step` wants. @returns how many.
  template <typename Step>
  std::int64_t Find(std::int64_t first, std::int64_t last, EdgeId* found) const
  {
    std::int64_t count = 0;
    for (std::int64_t e = first; e < last; e += 8)
    {
      const std::int64_t end = std::min(e + 8, last);
      if (end == e + 8 && this->AreAtRest(e))
      {
        continue;
      }
      for (std::int64_t i = e; i < end; ++i)
      {
        found[count] = static_cast<EdgeId>(i);
        count += Step::Wants(AtomicLoad(&this->States[i])) ? 1 : 0;
      }
    }
    return count;
  }

  /// Whether eight edges are all Good or Fixed: their states differ in the last bit only.
  bool AreAtRest(std::int64_t first) const
  {
    static_assert(
      static_cast<int>(EdgeState::Good) == 0 && static_cast<int>(EdgeState::Fixed) == 1, "");
    using Word __attribute__((may_alias)) = std::uint64_t;
    const Word* word = reinterpret_cast<const Word*>(this->States + first);
    return (__atomic_load_n(word, __ATOMIC_RELAXED) & 0xFEFEFEFEFEFEFEFEu) == 0;
  }

  template <typename Step>
  void RunOnBlock(const Step& step, std::uint32_t block, StepCounts& counts) const
  {
    EdgeId edges[BlockSize];
    const std::int64_t size = this->Find<Step>(this->First(block), this->Last(block), edges);
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

  const EdgeState* States;
  std::int64_t Size;
  const ThreadBackend& Backend;
  std::vector<std::uint8_t> Flags;
  std::vector<std::uint32_t> Blocks;
};

}

#endif
