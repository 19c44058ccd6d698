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

/// For each of the 256 sets of bytes of a word: which ones, in order, and how many.
class BytePlaces
{
public:
  struct Places
  {
    std::uint8_t Place[8];
    std::uint8_t Count;
  };

  /// @param topBits a set as the top bits of its bytes, the others 0.
  static const Places& Of(std::uint64_t topBits)
  {
    static const BytePlaces table;
    // The product gathers bit 0 of the eight bytes in the last byte.
    return table.Sets[((topBits >> 7) * 0x0102040810204080u) >> 56];
  }

private:
  BytePlaces()
  {
    for (int set = 0; set < 256; ++set)
    {
      Places& places = this->Sets[set];
      places = {};
      for (int i = 0; i < 8; ++i)
      {
        places.Place[places.Count] = static_cast<std::uint8_t>(i);
        places.Count += (set >> i) & 1;
      }
    }
  }

  Places Sets[256];
};

class EdgeWorklist
{
public:
  /// Edges [first, last), every block active.
  EdgeWorklist(const EdgeState* states, std::int64_t first, std::int64_t last)
    : States(states),
      FirstEdge(first),
      LastEdge(last),
      FirstBlock(first >> BlockBits),
      Flags(first < last ? ((last - 1) >> BlockBits) - FirstBlock + 1 : 0, 1)
  {
  }

  static constexpr int BlockBits = 10;

  /// Where steps flag the blocks of edges that they make candidates.
  BlockFlags GetFlags()
  {
    return { this->Flags.data(), this->FirstEdge, this->LastEdge, BlockBits };
  }

  void ActivateAll() { std::fill(this->Flags.begin(), this->Flags.end(), 1); }

  /// Takes the flagged blocks as those of the coming steps; their flags stay.
  void Gather()
  {
    this->Blocks.clear();
    for (std::size_t block = 0; block < this->Flags.size(); ++block)
    {
      if (this->Flags[block])
      {
        this->Blocks.push_back(this->FirstBlock + static_cast<std::int64_t>(block));
      }
    }
  }

  /// Runs the steps on the gathered blocks on threads, all of them on one block before the next:
  /// for steps that write nothing which another edge's step reads. Blocks in which an edge stays
  /// bad or blocked after a CountStep are flagged again. @returns what the steps counted.
  template <typename... Steps>
  StepCounts Run(const ThreadBackend& backend, const Steps&... steps)
  {
    return backend.SumRanges<StepCounts>(
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
  static constexpr std::int64_t BlockSize = std::int64_t(1) << BlockBits;
  static constexpr std::int64_t BlocksPerTask = 8;
  static constexpr std::int64_t WordSize = StatesPerWord;
  static constexpr std::int64_t WordsPerGroup = 8;
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
      counts += block;
    }
    return counts;
  }

  /// Two requests ahead of every edge: its triangles, then what their contents lead to.
  template <typename Step>
  static void RunOnEdges(
    const Step& step, const EdgeId* edges, std::int64_t size, StepCounts& counts)
  {
    decltype(step.Load(0)) items[PrefetchDistance];
    for (std::int64_t i = 0; i < size + 2 * PrefetchDistance; ++i)
    {
      auto& item = items[i % PrefetchDistance];
      if (i >= 2 * PrefetchDistance)
      {
        step(edges[i - 2 * PrefetchDistance], item, counts);
      }
      if (i >= PrefetchDistance && i - PrefetchDistance < size)
      {
        item = step.Load(edges[i - PrefetchDistance]);
        step.Prefetch(item);
      }
      if (i < size)
      {
        PrefetchTriangles(step.Mesh, edges[i]);
      }
    }
  }

  template <typename Step>
  void RunOnBlock(const Step& step, std::int64_t block, StepCounts& counts)
  {
    EdgeId edges[BlockSize + WordSize];
    RunOnEdges(step, edges, this->Find(Step::Wanted, this->GetWords(block), edges), counts);
  }

  /// Exact arithmetic is asked for seldom.
  template <typename Rule>
  void RunOnBlock(const ResolveStep<Rule>& step, std::int64_t block, StepCounts& counts)
  {
    if (counts.Uncertain > 0)
    {
      EdgeId edges[BlockSize + WordSize];
      const std::int64_t size = this->Find(ResolveStep<Rule>::Wanted, this->GetWords(block), edges);
      RunOnEdges(step, edges, size, counts);
    }
  }

  void RunOnBlock(const CountStep&, std::int64_t block, StepCounts& counts)
  {
    const WordRange words = this->GetWords(block);
    std::int64_t bad = 0;
    std::int64_t all = 0;
    for (std::int64_t word = words.First; word < words.End; ++word)
    {
      bad += CountBytes(this->Match({ EdgeState::Bad, EdgeState::Bad }, word, words));
      all += CountBytes(this->Match(CountStep::Wanted, word, words));
    }
    counts.Bad += bad;
    counts.Blocked += all - bad;
    this->Flags[block - this->FirstBlock] = all > 0;
  }

  static std::int64_t CountBytes(std::uint64_t topBits)
  {
    return static_cast<std::int64_t>(((topBits >> 7) * EveryByte) >> 56);
  }

  /// The words of states of a block, and which bytes of the first and the last belong to the range.
  struct WordRange
  {
    std::int64_t First, End;
    std::uint64_t FirstMask, LastMask;
  };

  WordRange GetWords(std::int64_t block) const
  {
    const std::int64_t first = std::max(this->FirstEdge, block << BlockBits);
    const std::int64_t last = std::min(this->LastEdge, (block + 1) << BlockBits);
    const std::uint64_t all = ~std::uint64_t(0);
    return { first / WordSize, (last + WordSize - 1) / WordSize, all << (8 * (first % WordSize)),
      all >> (8 * ((WordSize - last % WordSize) % WordSize)) };
  }

  /// Stores the edges in a wanted state. @returns how many.
  std::int64_t Find(StateRange wanted, const WordRange& words, EdgeId* found) const
  {
    std::int64_t count = 0;
    for (std::int64_t word = words.First; word < words.End;)
    {
      const std::int64_t end = std::min(words.End, word + WordsPerGroup);
      if (this->AreAtRest(word, end))
      {
        word = end;
        continue;
      }
      for (; word < end; ++word)
      {
        count += Store(this->Match(wanted, word, words), word, found + count);
      }
    }
    return count;
  }

  /// Whether no edge of the words [word, end) has anything to do.
  bool AreAtRest(std::int64_t word, std::int64_t end) const
  {
    static_assert(static_cast<int>(EdgeState::Deferred) < 4 &&
        static_cast<int>(EdgeState::Candidate) == 4 && static_cast<int>(EdgeState::Winner) < 12,
      "the states at rest are those without bits 2 and 3");
    std::uint64_t states = 0;
    for (; word < end; ++word)
    {
      states |= this->LoadWord(word);
    }
    return (states & (0x0C * EveryByte)) == 0;
  }

  /// Without a branch per edge: all eight places are written, those beyond the count again later.
  static std::int64_t Store(std::uint64_t matches, std::int64_t word, EdgeId* found)
  {
    const BytePlaces::Places& places = BytePlaces::Of(matches);
    for (std::int64_t i = 0; i < WordSize; ++i)
    {
      found[i] = static_cast<EdgeId>(word * WordSize + places.Place[i]);
    }
    return places.Count;
  }

  std::uint64_t LoadWord(std::int64_t word) const
  {
    using Word __attribute__((may_alias)) = std::uint64_t;
    return __atomic_load_n(reinterpret_cast<const Word*>(this->States) + word, __ATOMIC_RELAXED);
  }

  /// MatchStates for the edges of the range.
  std::uint64_t Match(StateRange wanted, std::int64_t word, const WordRange& words) const
  {
    std::uint64_t matches = MatchStates(this->LoadWord(word), wanted);
    matches &= word == words.First ? words.FirstMask : ~std::uint64_t(0);
    matches &= word == words.End - 1 ? words.LastMask : ~std::uint64_t(0);
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
