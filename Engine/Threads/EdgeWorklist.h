// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_EDGEWORKLIST_H
#define DELAUNAYFLIP_EDGEWORKLIST_H

#include "EdgeMesh.h"
#include "ThreadBackend.h"
#include "ThreadPasses.h"

#include <algorithm>
#include <cstdint>
#include <type_traits>
#include <vector>

/// @file
/// The worklist of a range of edges: units of 1024 edges, with a flag for every unit that may
/// contain work. A detection visits only flagged units, and finds its candidates by their states,
/// in order, so its cost depends only on what is active. It lists the bad edges, one list per task;
/// the rest of an iteration uses these lists.

namespace delaunayflip
{

//------------------------------------------------------------------------------
// The states of 64 edges at once, as a set of bits.

constexpr std::int64_t StatesPerSet = 64;

/// Finds which of 64 states are wanted, by the bytes of machine words. Other threads may meanwhile
/// change states, if the caller ignores their bits.
inline std::uint64_t MatchStates(const EdgeState* states, StateRange wanted)
{
  using Word __attribute__((may_alias)) = std::uint64_t;
  constexpr std::uint64_t EveryByte = 0x0101010101010101u;
  std::uint64_t words[8], all = 0;
  for (int i = 0; i < 8; ++i)
  {
    words[i] = __atomic_load_n(reinterpret_cast<const Word*>(states) + i, __ATOMIC_RELAXED);
    all |= words[i];
  }
  // Most often all of these edges are Good or Fixed, which are 0 and 1.
  static_assert(int(EdgeState::Good) == 0 && int(EdgeState::Fixed) == 1,
    "all bits of Good and Fixed are in EveryByte");
  if (wanted.First > EdgeState::Fixed && (all & ~EveryByte) == 0)
  {
    return 0;
  }
  const std::uint64_t first = (0x80 - static_cast<std::uint64_t>(wanted.First)) * EveryByte;
  const std::uint64_t last = (0x7F - static_cast<std::uint64_t>(wanted.Last)) * EveryByte;
  std::uint64_t set = 0;
  for (int i = 0; i < 8; ++i)
  {
    const std::uint64_t word = words[i];
    // States are below 16, so bytes do not carry into each other, and their top bits have the
    // answer.
    const std::uint64_t matches = (word + first) & ~(word + last) & (0x80 * EveryByte);
    // The product gathers bit 0 of the eight bytes in the last byte.
    set |= (((matches >> 7) * 0x0102040810204080u) >> 56) << (8 * i);
  }
  return set;
}

//------------------------------------------------------------------------------

class EdgeWorklist
{
public:
  /// Edges [first, last), every unit active.
  /// @param mayBlock whether passes may leave edges blocked.
  EdgeWorklist(const EdgeState* states, std::int64_t first, std::int64_t last, bool mayBlock)
    : States(states),
      MayBlock(mayBlock),
      FirstEdge(first),
      LastEdge(last),
      FirstUnit(first >> UnitBits),
      Flags(first < last ? ((last - 1) >> UnitBits) - FirstUnit + 1 : 0, 1)
  {
  }

  /// The flags, which passes set for the units of edges that they make candidates.
  UnitFlags GetFlags() { return { this->Flags.data(), this->FirstUnit }; }

  void ActivateAll() { std::fill(this->Flags.begin(), this->Flags.end(), 1); }

  /// Runs passes on the candidates of flagged units: all passes on a few units, then on the
  /// next. So no pass may write what another edge's pass reads. Then lists and counts the bad
  /// edges. Units with a bad or blocked edge stay flagged. @returns the counts.
  template <typename... Passes>
  StepCounts Detect(const ThreadBackend& backend, const Passes&... passes)
  {
    // A task has so few units that a mesh of 50,000 points has tasks for many threads.
    constexpr std::int64_t WantedTasks = 64;
    this->Gather();
    const auto units = static_cast<std::int64_t>(this->Units.size());
    this->Divide(std::clamp<std::int64_t>(units / WantedTasks, 1, UnitsPerGroup));
    // A unit takes the time of many edges, and each flip has made four candidates.
    const std::int64_t edges = units * UnitSize / 16 + 4 * this->Listed;
    const StepCounts found =
      this->ForTasks(backend, edges, [&](Task& task) { return this->DetectIn(task, passes...); });
    this->Listed = found.Bad;
    return found;
  }

  /// Detects on the calling thread, as all functions without a backend do.
  template <typename... Passes>
  StepCounts Detect(const Passes&... passes)
  {
    this->Gather();
    this->Divide(static_cast<std::int64_t>(this->Flags.size()) + 1);
    return this->Tasks.empty() ? StepCounts{} : this->DetectIn(this->Tasks[0], passes...);
  }

  /// Removes edges for which the pass returns false from the lists.
  void Choose(const ThreadBackend& backend, const ChoosePass& pass)
  {
    this->ForTasks(backend, this->Listed,
      [&](Task& task)
      {
        ChooseIn(task, pass, [](std::int64_t, std::int64_t) {});
        return StepCounts();
      });
  }

  /// Chooses winners, which claim their new edges.
  void ChooseAndClaim(const ThreadBackend& backend, const ChooseAndClaimPass& pass)
  {
    this->ForTasks(backend, this->Listed,
      [&](Task& task)
      {
        task.Slots.resize(task.Size);
        ChooseIn(task, pass,
          [&](std::int64_t begin, std::int64_t end)
          {
            for (std::int64_t i = begin; i < end; ++i)
            {
              pass.PrefetchClaim(task.Edges[i]);
            }
            for (std::int64_t i = begin; i < end; ++i)
            {
              task.Slots[i] = pass.Claim(task.Edges[i]);
            }
          });
        return StepCounts();
      });
  }

  /// Flips the edges of the lists. Edges with claims flip only if they hold them.
  /// @returns the pass's counts.
  template <typename Pass>
  StepCounts Flip(const ThreadBackend& backend, const Pass& pass)
  {
    return this->ForTasks(backend, this->Listed,
      [&](Task& task)
      {
        StepCounts counts;
        ForEdges(pass, task.Edges.data(), task.Size,
          [&](std::int64_t i, const Quad& quad)
          {
            if constexpr (std::is_same_v<Pass, ConfirmAndFlipPass>)
            {
              pass(task.Edges[i], quad, task.Slots[i], counts);
            }
            else
            {
              pass(task.Edges[i], quad, counts);
            }
          });
        return counts;
      });
  }

  /// Filters the lists by the pass's choice and runs the pass on the winners, a few edges at a
  /// time, so that what the choice has read is still in the cache. On the calling thread.
  StepCounts ChooseAndFlip(const ChooseAndFlipPass& pass)
  {
    StepCounts counts;
    EdgeId winners[ChoicesAtOnce + 1];
    int size = 0;
    const auto flip = [&]()
    {
      for (int i = 0; i < size; ++i)
      {
        pass(winners[i], counts);
      }
      size = 0;
    };
    for (Task& task : this->Tasks)
    {
      EdgeId* edges = task.Edges.data();
      ForEdges(pass, edges, task.Size,
        [&](std::int64_t i, const OuterHalfEdges& outer)
        {
          winners[size] = edges[i];
          size += int(pass.Choose(edges[i], outer));
          if (size == ChoicesAtOnce)
          {
            flip();
          }
        });
      flip();
    }
    return counts;
  }

private:
  static constexpr int UnitBits = UnitFlags::UnitBits;
  static constexpr std::int64_t UnitSize = std::int64_t(1) << UnitBits;
  /// A pass works on the edges of so many units together.
  static constexpr std::int64_t UnitsPerGroup = 8;
  static constexpr std::int64_t SetSize = StatesPerSet;
  /// Edges between the request for a cache line and its use.
  static constexpr std::int64_t PrefetchDistance = 16;
  /// Winners that wait for their flips.
  static constexpr int ChoicesAtOnce = 32;
  /// Room at the end of lists, for edges that are prefetched but not worked on.
  static constexpr std::int64_t Padding = 3 * PrefetchDistance;

  /// A task: some of the gathered units.
  struct Task
  {
    std::int64_t Begin, End;
    std::vector<EdgeId> Edges; ///< In order, and Padding.
    std::vector<std::uint32_t> Slots; ///< The slots of the winners' claims.
    std::int64_t Size = 0; ///< Without padding.
  };

  /// Lists the flagged units.
  void Gather()
  {
    this->Units.clear();
    for (std::size_t unit = 0; unit < this->Flags.size(); ++unit)
    {
      if (this->Flags[unit])
      {
        this->Units.push_back(this->FirstUnit + static_cast<std::int64_t>(unit));
      }
    }
  }

  /// Divides them into tasks.
  void Divide(std::int64_t unitsPerTask)
  {
    const auto size = static_cast<std::int64_t>(this->Units.size());
    this->Tasks.resize((size + unitsPerTask - 1) / unitsPerTask);
    std::int64_t begin = 0;
    for (Task& task : this->Tasks)
    {
      task.Begin = begin;
      task.End = std::min(size, begin + unitsPerTask);
      begin = task.End;
      task.Edges.clear();
      task.Size = 0;
    }
  }

  /// Sum of work(task), called on threads unless there are so few edges that the others would
  /// start too late to help.
  template <typename Work>
  StepCounts ForTasks(const ThreadBackend& backend, std::int64_t edges, const Work& work)
  {
    constexpr std::int64_t FewestShared = 512;
    if (edges < FewestShared)
    {
      StepCounts counts;
      for (Task& task : this->Tasks)
      {
        counts += work(task);
      }
      return counts;
    }
    return backend.SumRanges<StepCounts>(
      static_cast<std::int64_t>(this->Tasks.size()),
      [&](std::int64_t task, std::int64_t) { return work(this->Tasks[task]); }, 1);
  }

  /// Keeps the edges that the pass chooses. Calls settle(begin, end) for every few of them, so that
  /// what the choice has read is still in the cache.
  template <typename Pass, typename Settle>
  static void ChooseIn(Task& task, const Pass& pass, const Settle& settle)
  {
    EdgeId* edges = task.Edges.data();
    std::int64_t kept = 0, settled = 0;
    ForEdges(pass, edges, task.Size,
      [&](std::int64_t i, const OuterHalfEdges& outer)
      {
        const EdgeId edge = edges[i];
        edges[kept] = edge;
        kept += int(pass(edge, outer));
        if (kept == settled + ChoicesAtOnce)
        {
          settle(settled, kept);
          settled = kept;
        }
      });
    settle(settled, kept);
    task.Size = kept;
  }

  template <typename... Passes>
  StepCounts DetectIn(Task& task, const Passes&... passes)
  {
    StepCounts counts;
    for (std::int64_t begin = task.Begin; begin < task.End; begin += UnitsPerGroup)
    {
      StepCounts group;
      const std::int64_t end = std::min(task.End, begin + UnitsPerGroup);
      (this->RunOnUnits(passes, begin, end, group), ...);
      for (std::int64_t i = begin; i < end; ++i)
      {
        this->ListBad(this->Units[i], task.Edges, group);
      }
      counts += group;
    }
    task.Size = static_cast<std::int64_t>(task.Edges.size());
    task.Edges.resize(task.Size + Padding);
    return counts;
  }

  /// Calls work(i, item) with what the pass loads for each edge. Before that, prefetches the edge's
  /// words, then its triangles, then what those refer to. Writes to the padding at the end.
  template <typename Pass, typename Work>
  static void ForEdges(const Pass& pass, EdgeId* edges, std::int64_t size, const Work& work)
  {
    constexpr std::int64_t Ahead = PrefetchDistance;
    if (size == 0)
    {
      return;
    }
    std::fill_n(edges + size, Padding, edges[size - 1]);
    const auto request = [&](std::int64_t i)
    { Prefetch(&pass.Mesh.CornerOfHalfEdge[std::size_t(2) * edges[i]]); };
    const auto requestTriangles = [&](std::int64_t i) { PrefetchTriangles(pass.Mesh, edges[i]); };
    decltype(pass.Load(0)) items[Ahead];
    const auto load = [&](std::int64_t i)
    {
      items[i % Ahead] = pass.Load(edges[i]);
      pass.Prefetch(items[i % Ahead]);
    };
    for (std::int64_t i = 0; i < std::min(size, 3 * Ahead); ++i)
    {
      request(i);
    }
    for (std::int64_t i = 0; i < std::min(size, 2 * Ahead); ++i)
    {
      requestTriangles(i);
    }
    for (std::int64_t i = 0; i < std::min(size, Ahead); ++i)
    {
      load(i);
    }
    for (std::int64_t i = 0; i < size; ++i)
    {
      work(i, items[i % Ahead]);
      load(i + Ahead);
      requestTriangles(i + 2 * Ahead);
      request(i + 3 * Ahead);
    }
  }

  template <typename Pass>
  void RunOnUnits(const Pass& pass, std::int64_t begin, std::int64_t end, StepCounts& counts)
  {
    EdgeId edges[UnitsPerGroup * UnitSize + Padding];
    const std::int64_t size = this->FindAll(Pass::Wanted, begin, end, edges);
    ForEdges(
      pass, edges, size, [&](std::int64_t i, const auto& item) { pass(edges[i], item, counts); });
  }

  template <typename Real>
  void RunOnUnits(const JudgePass<PlanarRule<Real, 2>>& pass, std::int64_t begin, std::int64_t end,
    StepCounts& counts)
  {
    using Batch = InCircleBatch<Real>;
    if (!Batch::Suits(pass.Decision))
    {
      this->RunOnUnits<JudgePass<PlanarRule<Real, 2>>>(pass, begin, end, counts);
      return;
    }
    EdgeId edges[UnitsPerGroup * UnitSize + Padding];
    const std::int64_t size =
      this->FindAll(JudgePass<PlanarRule<Real, 2>>::Wanted, begin, end, edges);
    Batch batch(pass.Mesh, pass.Decision);
    ForEdges(batch, edges, size,
      [&](std::int64_t i, const auto& item) { batch.Add(edges, i, item, counts); });
    batch.Finish(edges, size, counts);
  }

  /// This is not inlined, because exact arithmetic is seldom needed.
  template <typename Rule>
  void RunOnUnits(
    const ResolvePass<Rule>& pass, std::int64_t begin, std::int64_t end, StepCounts& counts)
  {
    if (counts.Uncertain > 0)
    {
      this->RunOnUnits<ResolvePass<Rule>>(pass, begin, end, counts);
    }
  }

  /// Lists the bad edges of a unit, and counts these and the blocked ones.
  void ListBad(std::int64_t unit, std::vector<EdgeId>& list, StepCounts& counts)
  {
    EdgeId edges[UnitSize];
    const std::int64_t found =
      this->Find({ EdgeState::BlockedByDeviation, EdgeState::Bad }, unit, edges);
    std::int64_t bad = found, byEdge = 0;
    if (this->MayBlock)
    {
      bad = 0;
      for (std::int64_t i = 0; i < found; ++i)
      {
        const EdgeState state = this->States[edges[i]];
        edges[bad] = edges[i];
        bad += int(state == EdgeState::Bad);
        byEdge += int(state == EdgeState::BlockedByEdge);
      }
    }
    list.insert(list.end(), edges, edges + bad);
    counts.Bad += bad;
    counts.BlockedByEdge += byEdge;
    counts.BlockedByShape += found - bad - byEdge;
    this->Flags[unit - this->FirstUnit] = found > 0;
  }

  /// Calls Find for the gathered units [begin, end).
  std::int64_t FindAll(StateRange wanted, std::int64_t begin, std::int64_t end, EdgeId* found) const
  {
    std::int64_t size = 0;
    for (std::int64_t i = begin; i < end; ++i)
    {
      size += this->Find(wanted, this->Units[i], found + size);
    }
    return size;
  }

  /// Stores the edges of a unit that are in a wanted state. @returns how many.
  std::int64_t Find(StateRange wanted, std::int64_t unit, EdgeId* found) const
  {
    const std::int64_t first = std::max(this->FirstEdge, unit << UnitBits);
    const std::int64_t last = std::min(this->LastEdge, (unit + 1) << UnitBits);
    const std::uint64_t all = ~std::uint64_t(0);
    EdgeId* end = found;
    for (std::int64_t base = first / SetSize * SetSize; base < last; base += SetSize)
    {
      std::uint64_t set = MatchStates(this->States + base, wanted);
      if (base < first)
      {
        set &= all << (first - base);
      }
      if (base + SetSize > last)
      {
        set &= all >> (base + SetSize - last);
      }
      for (; set != 0; set &= set - 1)
      {
        *end++ = static_cast<EdgeId>(base + __builtin_ctzll(set));
      }
    }
    return end - found;
  }

  const EdgeState* States;
  bool MayBlock;
  std::int64_t FirstEdge;
  std::int64_t LastEdge;
  std::int64_t FirstUnit;
  std::vector<std::uint8_t> Flags;
  std::vector<std::int64_t> Units; ///< The flagged units.
  std::vector<Task> Tasks;
  std::int64_t Listed = 0; ///< Bad edges that the last detection on threads has listed.
};

}

#endif
