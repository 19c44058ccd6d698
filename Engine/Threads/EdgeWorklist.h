// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_EDGEWORKLIST_H
#define DELAUNAYFLIP_EDGEWORKLIST_H

#include "EdgeMesh.h"
#include "ThreadBackend.h"
#include "ThreadSteps.h"

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

/// Which of 64 states are wanted, by the bytes of machine words. Other threads may change states
/// meanwhile whose bits the caller ignores.
inline std::uint64_t MatchStates(const EdgeState* states, StateRange wanted)
{
  using Word __attribute__((may_alias)) = std::uint64_t;
  constexpr std::uint64_t EveryByte = 0x0101010101010101u;
  const std::uint64_t first = (0x80 - static_cast<std::uint64_t>(wanted.First)) * EveryByte;
  const std::uint64_t last = (0x7F - static_cast<std::uint64_t>(wanted.Last)) * EveryByte;
  std::uint64_t set = 0;
  for (int i = 0; i < 8; ++i)
  {
    const std::uint64_t word =
      __atomic_load_n(reinterpret_cast<const Word*>(states) + i, __ATOMIC_RELAXED);
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
  /// @param mayBlock whether steps may leave edges blocked.
  EdgeWorklist(const EdgeState* states, std::int64_t first, std::int64_t last, bool mayBlock)
    : States(states),
      MayBlock(mayBlock),
      FirstEdge(first),
      LastEdge(last),
      FirstUnit(first >> UnitBits),
      Flags(first < last ? ((last - 1) >> UnitBits) - FirstUnit + 1 : 0, 1)
  {
  }

  /// The flags, which steps set for the units of edges that they make candidates.
  UnitFlags GetFlags() { return { this->Flags.data(), this->FirstUnit }; }

  void ActivateAll() { std::fill(this->Flags.begin(), this->Flags.end(), 1); }

  /// Runs steps on the candidates of flagged units: all steps on a few units, then on the
  /// next. So no step may write what another edge's step reads. Then lists and counts the bad
  /// edges. Units with a bad or blocked edge stay flagged. @returns the counts.
  template <typename... Steps>
  StepCounts Detect(const ThreadBackend& backend, const Steps&... steps)
  {
    // So few units that a mesh of 50,000 points has tasks for many threads.
    constexpr std::int64_t WantedTasks = 64;
    this->Gather();
    const auto units = static_cast<std::int64_t>(this->Units.size());
    this->Divide(std::clamp<std::int64_t>(units / WantedTasks, 1, UnitsPerGroup));
    // A unit takes the time of many edges, and each flip has made four candidates.
    const std::int64_t edges = units * UnitSize / 16 + 4 * this->Listed;
    const StepCounts found =
      this->ForTasks(backend, edges, [&](Task& task) { return this->DetectIn(task, steps...); });
    this->Listed = found.Bad;
    return found;
  }

  /// Detects on the calling thread, as all functions without a backend do.
  template <typename... Steps>
  StepCounts Detect(const Steps&... steps)
  {
    this->Gather();
    this->Divide(static_cast<std::int64_t>(this->Flags.size()) + 1);
    return this->Tasks.empty() ? StepCounts{} : this->DetectIn(this->Tasks[0], steps...);
  }

  /// Removes edges for which the step returns false from the lists.
  void Choose(const ThreadBackend& backend, const ChooseStep& step)
  {
    this->ForTasks(backend, this->Listed,
      [&](Task& task)
      {
        ChooseIn(task, step, [](std::int64_t, std::int64_t) {});
        return StepCounts();
      });
  }

  /// Chooses winners, which claim their new edges.
  void ChooseAndClaim(const ThreadBackend& backend, const ChooseAndClaimStep& step)
  {
    this->ForTasks(backend, this->Listed,
      [&](Task& task)
      {
        task.Slots.resize(task.Size);
        ChooseIn(task, step,
          [&](std::int64_t begin, std::int64_t end)
          {
            for (std::int64_t i = begin; i < end; ++i)
            {
              step.PrefetchClaim(task.Edges[i]);
            }
            for (std::int64_t i = begin; i < end; ++i)
            {
              task.Slots[i] = step.Claim(task.Edges[i]);
            }
          });
        return StepCounts();
      });
  }

  /// Flips the edges of the lists. Edges with claims flip only if they hold them.
  /// @returns the step's counts.
  template <typename Step>
  StepCounts Flip(const ThreadBackend& backend, const Step& step)
  {
    return this->ForTasks(backend, this->Listed,
      [&](Task& task)
      {
        StepCounts counts;
        ForEdges(step, task.Edges.data(), task.Size,
          [&](std::int64_t i, const Quad& quad)
          {
            if constexpr (std::is_same_v<Step, ConfirmAndFlipStep>)
            {
              step(task.Edges[i], quad, task.Slots[i], counts);
            }
            else
            {
              step(task.Edges[i], quad, counts);
            }
          });
        return counts;
      });
  }

  /// Filters the lists by the step's choice and runs the step on the winners, a few edges at a
  /// time, so that what the choice has read is still in the cache. On the calling thread.
  StepCounts ChooseAndFlip(const ChooseAndFlipStep& step)
  {
    StepCounts counts;
    EdgeId winners[ChoicesAtOnce + 1];
    int size = 0;
    const auto flip = [&]()
    {
      for (int i = 0; i < size; ++i)
      {
        step(winners[i], counts);
      }
      size = 0;
    };
    for (Task& task : this->Tasks)
    {
      EdgeId* edges = task.Edges.data();
      ForEdges(step, edges, task.Size,
        [&](std::int64_t i, const OuterHalfEdges& outer)
        {
          winners[size] = edges[i];
          size += step.Choose(edges[i], outer) ? 1 : 0;
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
  /// Whose edges a step works on together.
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

  /// Keeps the edges that the step chooses. Calls settle(begin, end) for every few of them, so that
  /// what the choice has read is still in the cache.
  template <typename Step, typename Settle>
  static void ChooseIn(Task& task, const Step& step, const Settle& settle)
  {
    EdgeId* edges = task.Edges.data();
    std::int64_t kept = 0, settled = 0;
    ForEdges(step, edges, task.Size,
      [&](std::int64_t i, const OuterHalfEdges& outer)
      {
        const EdgeId edge = edges[i];
        edges[kept] = edge;
        kept += step(edge, outer) ? 1 : 0;
        if (kept == settled + ChoicesAtOnce)
        {
          settle(settled, kept);
          settled = kept;
        }
      });
    settle(settled, kept);
    task.Size = kept;
  }

  template <typename... Steps>
  StepCounts DetectIn(Task& task, const Steps&... steps)
  {
    StepCounts counts;
    for (std::int64_t begin = task.Begin; begin < task.End; begin += UnitsPerGroup)
    {
      StepCounts group;
      const std::int64_t end = std::min(task.End, begin + UnitsPerGroup);
      (this->RunOnUnits(steps, begin, end, group), ...);
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

  /// Calls work(i, item) with what the step loads for each edge. Before that, prefetches the edge's
  /// words, then its triangles, then what those refer to. Writes to the padding at the end.
  template <typename Step, typename Work>
  static void ForEdges(const Step& step, EdgeId* edges, std::int64_t size, const Work& work)
  {
    constexpr std::int64_t Ahead = PrefetchDistance;
    if (size == 0)
    {
      return;
    }
    std::fill_n(edges + size, Padding, edges[size - 1]);
    const auto request = [&](std::int64_t i)
    { Prefetch(&step.Mesh.CornerOfHalfEdge[std::size_t(2) * edges[i]]); };
    const auto requestTriangles = [&](std::int64_t i) { PrefetchTriangles(step.Mesh, edges[i]); };
    decltype(step.Load(0)) items[Ahead];
    const auto load = [&](std::int64_t i)
    {
      items[i % Ahead] = step.Load(edges[i]);
      step.Prefetch(items[i % Ahead]);
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

  template <typename Step>
  void RunOnUnits(const Step& step, std::int64_t begin, std::int64_t end, StepCounts& counts)
  {
    EdgeId edges[UnitsPerGroup * UnitSize + Padding];
    const std::int64_t size = this->FindAll(Step::Wanted, begin, end, edges);
    ForEdges(
      step, edges, size, [&](std::int64_t i, const auto& item) { step(edges[i], item, counts); });
  }

  template <typename Real>
  void RunOnUnits(const JudgeStep<PlanarRule<Real, 2>>& step, std::int64_t begin, std::int64_t end,
    StepCounts& counts)
  {
    using Batch = InCircleBatch<Real>;
    if (!Batch::Suits(step.Decision))
    {
      this->RunOnUnits<JudgeStep<PlanarRule<Real, 2>>>(step, begin, end, counts);
      return;
    }
    EdgeId edges[UnitsPerGroup * UnitSize + Padding];
    const std::int64_t size =
      this->FindAll(JudgeStep<PlanarRule<Real, 2>>::Wanted, begin, end, edges);
    Batch batch(step.Mesh, step.Decision);
    ForEdges(batch, edges, size,
      [&](std::int64_t i, const auto& item) { batch.Add(edges, i, item, counts); });
    batch.Finish(edges, size, counts);
  }

  /// Not inlined, because exact arithmetic is seldom needed.
  template <typename Rule>
  void RunOnUnits(
    const ResolveStep<Rule>& step, std::int64_t begin, std::int64_t end, StepCounts& counts)
  {
    if (counts.Uncertain > 0)
    {
      this->RunOnUnits<ResolveStep<Rule>>(step, begin, end, counts);
    }
  }

  /// Lists the bad edges of a unit, and counts these and the blocked ones.
  void ListBad(std::int64_t unit, std::vector<EdgeId>& list, StepCounts& counts)
  {
    EdgeId edges[UnitSize];
    const std::int64_t found =
      this->Find({ EdgeState::BlockedByDeviation, EdgeState::Bad }, unit, edges);
    std::int64_t bad = this->MayBlock ? 0 : found, byEdge = 0;
    for (std::int64_t i = 0; i < found && this->MayBlock; ++i)
    {
      const EdgeState state = this->States[edges[i]];
      edges[bad] = edges[i];
      bad += state == EdgeState::Bad ? 1 : 0;
      byEdge += state == EdgeState::BlockedByEdge ? 1 : 0;
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
      set &= base < first ? all << (first - base) : all;
      set &= base + SetSize > last ? all >> (base + SetSize - last) : all;
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
