// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_CUDAPASSES_CUH
#define DELAUNAYFLIP_CUDAPASSES_CUH

#include "Atomics.h"
#include "DeviceWorklist.cuh"
#include "EdgeMesh.h"
#include "EdgePasses.h"
#include "StepCounts.h"
#include "Team.cuh"

#include <cstddef>
#include <cstdint>

/// @file
/// The passes of an iteration (FlipLoop.h), on a worklist of the device; FlipKernels.cuh runs them.
/// Within a pass a thread works on one edge at a time. Results depend only on the order of the
/// passes, which the team's waits keep.

namespace delaunayflip
{

//------------------------------------------------------------------------------
// Pass 1: judge the candidates.

/// Records the state of an edge that was judged. @returns whether the edge is bad.
template <typename Rule>
__device__ bool NoteState(
  const LoopView<Rule>& loop, EdgeId edge, EdgeState state, unsigned& blockedByShape)
{
  if (state == EdgeState::BlockedByEdge)
  {
    EdgeBits::Set(loop.Bits.BlockedByEdge, edge);
  }
  if (state == EdgeState::Bad)
  {
    EdgeBits::Set(loop.Bits.Bad, edge);
  }
  if (Rule::MayBlock &&
    (state == EdgeState::BlockedByShape || state == EdgeState::BlockedByDeviation))
  {
    EdgeBits::Set(loop.Bits.BlockedByShape, edge);
    ++blockedByShape;
  }
  return state == EdgeState::Bad;
}

/// Judges exactly the edges that JudgeCandidates could not decide and left as candidates. This is a
/// separate function, because it is large and seldom called: inlined it would take the registers of
/// everything else there.
template <typename Rule, typename Worklist>
__device__ __noinline__ void ResolveUncertain(
  const LoopView<Rule>& loop, Worklist worklist, Team team)
{
  unsigned uncertain = 0, isBad = 0, isBlockedByShape = 0;
  worklist.Run(
    team, loop.Mesh,
    [&](const EdgeByte& byte)
    {
      const unsigned marked = byte.Load(loop.Bits.Candidates);
      const unsigned fixedOrDeferred = byte.Load(loop.Bits.FixedOrDeferred);
      byte.Clear(loop.Bits.Candidates, marked, marked);
      return marked & ~fixedOrDeferred;
    },
    [&](EdgeId edge, const CornerPair& corners)
    {
      if (edge == NoEdge)
      {
        return;
      }
      const EdgeState state = loop.Decision.JudgeExactly(loop.Mesh.GetQuad(corners));
      isBad += unsigned(NoteState(loop, edge, state, isBlockedByShape));
      uncertain += unsigned(state == EdgeState::Uncertain);
    });
  team.Warn(uncertain > 0);
  team.Add(IterationSum::Uncertain, uncertain);
  team.Add(IterationSum::IsBad, isBad);
  team.Add(IterationSum::IsBlockedByShape, isBlockedByShape);
}

/// The counts of a thread in a detection.
struct DetectionCounts
{
  unsigned Tested = 0, WasBad = 0, IsBad = 0, WasBlockedByShape = 0, IsBlockedByShape = 0;
  bool Uncertain = false;

  template <typename Rule>
  __device__ void AddTo(const Team& team) const
  {
    team.Add(IterationSum::Tested, this->Tested);
    team.Add(IterationSum::WasBad, this->WasBad);
    team.Add(IterationSum::IsBad, this->IsBad);
    if (Rule::MayBlock)
    {
      team.Add(IterationSum::WasBlockedByShape, this->WasBlockedByShape);
      team.Add(IterationSum::IsBlockedByShape, this->IsBlockedByShape);
    }
  }
};

/// Judges an edge by floating-point arithmetic. An edge that this cannot decide stays a candidate.
/// @param asksGuard whether the guard decides about a bad edge, too.
template <typename Rule>
__device__ EdgeState JudgeAndNote(const LoopView<Rule>& loop, EdgeId edge, const Quad& quad,
  bool asksGuard, DetectionCounts& counts)
{
  EdgeState state = loop.Decision.Judge(quad);
  if (asksGuard && state == EdgeState::Bad)
  {
    state = DecideByGuard(loop.Guard.Edges, loop.Mesh, quad);
  }
  if (state == EdgeState::Uncertain)
  {
    EdgeBits::Set(loop.Bits.Candidates, edge);
    counts.Uncertain = true;
  }
  counts.IsBad += unsigned(NoteState(loop, edge, state, counts.IsBlockedByShape));
  return state;
}

/// Takes the edges to judge from a byte and clears their bits: its candidates and, with takeBad,
/// the other bad edges and those that the guard blocks. Edges that have flipped since the last
/// detection are no longer bad.
template <bool IsGuarded, typename Rule>
__device__ unsigned TakeCandidates(
  const LoopView<Rule>& loop, const EdgeByte& byte, bool takeBad, DetectionCounts& counts)
{
  // All loads are issued before any result is used.
  const EdgeBits& bits = loop.Bits;
  const unsigned marked = byte.Load(bits.Candidates);
  const unsigned fixedOrDeferred = byte.Load(bits.FixedOrDeferred);
  const unsigned winners = byte.Load(bits.Winners);
  const unsigned seenBad = byte.Load(bits.Bad);
  const unsigned blockedByShape = Rule::MayBlock ? byte.Load(bits.BlockedByShape) : 0;
  const unsigned blockedByEdge = IsGuarded ? byte.Load(bits.BlockedByEdge) : 0;
  const unsigned candidates = marked & ~fixedOrDeferred;
  const unsigned bad = seenBad & ~winners;
  unsigned judged = candidates;
  if (takeBad)
  {
    judged |= bad | blockedByEdge;
  }
  byte.Clear(bits.Candidates, marked, marked);
  byte.Clear(bits.Winners, winners, winners);
  byte.Clear(bits.Bad, seenBad, winners | (judged & bad));
  byte.Clear(bits.BlockedByShape, blockedByShape, candidates & blockedByShape);
  byte.Clear(bits.BlockedByEdge, blockedByEdge, judged & blockedByEdge);
  counts.Tested += __popc(candidates);
  counts.WasBad += __popc(judged & bad);
  counts.WasBlockedByShape += __popc(candidates & blockedByShape);
  return judged;
}

/// Judges the candidates by floating-point arithmetic.
/// @returns whether this thread could not decide some of them.
template <bool IsGuarded, typename Rule, typename Worklist>
__device__ bool JudgeCandidates(
  const LoopView<Rule>& loop, const Worklist& worklist, const Team& team)
{
  DetectionCounts counts;
  worklist.Run(
    team, loop.Mesh,
    [&](const EdgeByte& byte) { return TakeCandidates<IsGuarded>(loop, byte, false, counts); },
    [&](EdgeId edge, const CornerPair& corners)
    {
      if (edge != NoEdge)
      {
        JudgeAndNote(loop, edge, loop.Mesh.GetQuad(corners), false, counts);
      }
    });
  counts.AddTo<Rule>(team);
  return counts.Uncertain;
}

//------------------------------------------------------------------------------
// Pass 2: guard.

/// Checks every edge that is bad or blocked by the guard again, and blocks or frees it.
template <typename Rule, typename Worklist>
__device__ void GuardBadEdges(
  const LoopView<Rule>& loop, const Worklist& worklist, const Team& team)
{
  const EdgeBits& bits = loop.Bits;
  unsigned wasBad = 0, allBad = 0, allBlockedByEdge = 0;
  worklist.Run(
    team, loop.Mesh,
    [&](const EdgeByte& byte)
    {
      const unsigned bad = byte.Load(bits.Bad);
      const unsigned blockedByEdge = byte.Load(bits.BlockedByEdge);
      byte.Clear(bits.Bad, bad, bad);
      byte.Clear(bits.BlockedByEdge, blockedByEdge, blockedByEdge);
      wasBad += __popc(bad);
      return bad | blockedByEdge;
    },
    [&](EdgeId edge, const CornerPair& corners)
    {
      if (edge == NoEdge)
      {
        return;
      }
      const bool isBad =
        DecideByGuard(loop.Guard.Edges, loop.Mesh, loop.Mesh.GetQuad(corners)) == EdgeState::Bad;
      EdgeBits::Set(isBad ? bits.Bad : bits.BlockedByEdge, edge);
      allBad += unsigned(isBad);
      allBlockedByEdge += unsigned(!isBad);
    });
  team.Add(IterationSum::WasBad, wasBad);
  team.Add(IterationSum::IsBad, allBad);
  team.Add(IterationSum::AllBlockedByEdge, allBlockedByEdge);
}

//------------------------------------------------------------------------------
// Pass 3: count. Passes 1 and 2 count what they change, so that all edges are counted only once.

/// Counts the bad and the blocked edges in a range.
template <typename Rule, typename Worklist>
__device__ void CountAll(const LoopView<Rule>& loop, const Worklist& worklist, const Team& team)
{
  unsigned bad = 0, blockedByShape = 0, blockedByEdge = 0;
  worklist.Run(
    team, loop.Mesh,
    [&](const EdgeByte& byte)
    {
      bad += __popc(byte.Load(loop.Bits.Bad));
      if (Rule::MayBlock)
      {
        blockedByShape += __popc(byte.Load(loop.Bits.BlockedByShape));
      }
      blockedByEdge += __popc(byte.Load(loop.Bits.BlockedByEdge));
      return 0u;
    },
    [](EdgeId, const CornerPair&) {});
  team.Add(IterationSum::AllBad, bad);
  team.Add(IterationSum::AllBlockedByShape, blockedByShape);
  team.Add(IterationSum::AllBlockedByEdge, blockedByEdge);
}

//------------------------------------------------------------------------------
// How the threads of a warp load the triangles that they flip, and store them.

// Half of a record may be loaded while another thread stores it, so each access must be atomic: as
// a number of 128 bits, which PTX has from CUDA 12.3 on. Before that, vectors of four words give
// the same instructions.
#if __CUDACC_VER_MAJOR__ > 12 || (__CUDACC_VER_MAJOR__ == 12 && __CUDACC_VER_MINOR__ >= 3)
#define DELAUNAYFLIP_HAS_B128 1
#else
#define DELAUNAYFLIP_HAS_B128 0
#endif

/// Stores with one instruction for all lanes, whatever branch chose their values.
__device__ inline void StoreHalf(uint4* address, const uint4& value)
{
#if DELAUNAYFLIP_HAS_B128
  const std::uint64_t low = value.x | std::uint64_t(value.y) << 32;
  const std::uint64_t high = value.z | std::uint64_t(value.w) << 32;
  asm volatile("{\n\t"
               ".reg .b128 half;\n\t"
               "mov.b128 half, {%1, %2};\n\t"
               "st.relaxed.sys.global.b128 [%0], half;\n\t"
               "}"
               :
               : "l"(__cvta_generic_to_global(address)), "l"(low), "l"(high)
               : "memory");
#else
  asm volatile(
    "st.relaxed.sys.global.v4.b32 [%0], {%1, %2, %3, %4};"
    :
    : "l"(__cvta_generic_to_global(address)), "r"(value.x), "r"(value.y), "r"(value.z), "r"(value.w)
    : "memory");
#endif
}

__device__ inline uint4 LoadHalf(const uint4* address)
{
  uint4 value;
#if DELAUNAYFLIP_HAS_B128
  std::uint64_t low, high;
  asm volatile("{\n\t"
               ".reg .b128 half;\n\t"
               "ld.relaxed.sys.global.b128 half, [%2];\n\t"
               "mov.b128 {%0, %1}, half;\n\t"
               "}"
               : "=l"(low), "=l"(high)
               : "l"(__cvta_generic_to_global(address))
               : "memory");
  value = { static_cast<unsigned>(low), static_cast<unsigned>(low >> 32),
    static_cast<unsigned>(high), static_cast<unsigned>(high >> 32) };
#else
  asm volatile("ld.relaxed.sys.global.v4.b32 {%0, %1, %2, %3}, [%4];"
               : "=r"(value.x), "=r"(value.y), "=r"(value.z), "=r"(value.w)
               : "l"(__cvta_generic_to_global(address))
               : "memory");
#endif
  return value;
}

/// A record that two neighbouring lanes store together, one half each, so that whole sectors are
/// written at once.
__device__ inline void StorePaired(
  TriangleRecord* triangles, TriangleId triangle, const TriangleRecord& record)
{
  const bool isOdd = threadIdx.x % 2 != 0;
  const uint4 first{ record.Vertices[0], record.Vertices[1], record.Vertices[2],
    record.InputTriangle };
  const uint4 second{ record.HalfEdges[0], record.HalfEdges[1], record.HalfEdges[2], record.Flips };
  const auto exchange = [](std::uint32_t value) { return __shfl_xor_sync(WholeWarp, value, 1); };
  const TriangleId other = exchange(triangle);
  // The even lane stores the first halves of both records, the odd lane the second halves.
  const uint4 mine = isOdd ? second : first;
  const uint4 given = isOdd ? first : second;
  const uint4 taken{ exchange(given.x), exchange(given.y), exchange(given.z), exchange(given.w) };
  auto* halves = reinterpret_cast<uint4*>(triangles) + int(isOdd);
  const TriangleId ofEven = isOdd ? other : triangle;
  const TriangleId ofOdd = isOdd ? triangle : other;
  if (ofEven != NoTriangle)
  {
    StoreHalf(&halves[2 * std::size_t(ofEven)], isOdd ? taken : mine);
  }
  if (ofOdd != NoTriangle)
  {
    StoreHalf(&halves[2 * std::size_t(ofOdd)], isOdd ? mine : taken);
  }
}

/// Holds what a flip writes to its two records until the whole warp stores them.
struct FlippedRecords
{
  TriangleId Triangles[2] = { NoTriangle, NoTriangle };
  TriangleRecord Records[2] = {};

  /// For FlipEdge.
  __device__ auto Keep()
  {
    return [this](int i, TriangleId triangle, const TriangleRecord& record)
    {
      this->Triangles[i] = triangle;
      this->Records[i] = record;
    };
  }

  __device__ void Store(TriangleRecord* triangles) const
  {
    StorePaired(triangles, this->Triangles[0], this->Records[0]);
    StorePaired(triangles, this->Triangles[1], this->Records[1]);
  }
};

/// A triangle that another thread may be flipping. Its half-edges are all from before or all from
/// after that flip; its vertices are valid only if no thread flips it.
__device__ inline TriangleRecord LoadRecord(const TriangleRecord* triangle)
{
  const auto* halves = reinterpret_cast<const uint4*>(triangle);
  const uint4 first = halves[0];
  const uint4 second = LoadHalf(&halves[1]);
  return { { first.x, first.y, first.z }, first.w, { second.x, second.y, second.z }, second.w };
}

/// The complete records of both triangles of an edge.
struct RecordPair
{
  CornerPair Corners;
  TriangleRecord Upper, Lower; ///< The triangles of Corners.A and Corners.B.

  __device__ RecordPair(const EdgeMeshView& mesh, const CornerPair& corners)
    : Corners(corners),
      Upper(LoadRecord(&mesh.Triangles[TriangleOf(corners.A)])),
      Lower(LoadRecord(&mesh.Triangles[TriangleOf(corners.B)]))
  {
  }

  __device__ Quad GetQuad() const
  {
    const int slot = SlotOf(this->Corners.A);
    return { this->Corners.A, this->Corners.B, GetAt(this->Upper.Vertices, slot),
      GetAt(this->Upper.Vertices, NextSlot(slot)), GetAt(this->Upper.Vertices, PreviousSlot(slot)),
      GetAt(this->Lower.Vertices, SlotOf(this->Corners.B)) };
  }
  __device__ OuterHalfEdges GetOuter() const
  {
    return GetOuterHalfEdges(this->Upper.HalfEdges, SlotOf(this->Corners.A), this->Lower.HalfEdges,
      SlotOf(this->Corners.B));
  }
  /// Whether both triangles have the edge there.
  __device__ bool Hold(EdgeId edge) const
  {
    return EdgeOf(GetAt(this->Upper.HalfEdges, SlotOf(this->Corners.A))) == edge &&
      EdgeOf(GetAt(this->Lower.HalfEdges, SlotOf(this->Corners.B))) == edge;
  }
};

//------------------------------------------------------------------------------
// Passes 4 to 6: choose, claim and confirm, flip.

/// Makes the outer edges of a flip candidates.
template <typename Rule>
__device__ void MarkOuter(const LoopView<Rule>& loop, const OuterHalfEdges& outer)
{
  EdgeBits::Set(loop.Bits.Candidates, EdgeOf(outer.AP));
  EdgeBits::Set(loop.Bits.Candidates, EdgeOf(outer.QA));
  EdgeBits::Set(loop.Bits.Candidates, EdgeOf(outer.PB));
  EdgeBits::Set(loop.Bits.Candidates, EdgeOf(outer.BQ));
}

/// Whether a bad edge has a smaller priority than its bad neighbours. Bad does not change
/// meanwhile.
template <typename Rule>
__device__ bool Wins(const LoopView<Rule>& loop, EdgeId edge, const OuterHalfEdges& outer)
{
  const auto isBad = [&](HalfEdgeId halfEdge)
  { return EdgeBits::Has(loop.Bits.Bad, EdgeOf(halfEdge)); };
  const bool ap = isBad(outer.AP), qa = isBad(outer.QA);
  const bool pb = isBad(outer.PB), bq = isBad(outer.BQ);
  return IsFirst(edge, outer, ap, qa, pb, bq);
}

/// Passes 4 and 6 in one: chooses among the bad edges and flips the winners. These stay marked as
/// bad until the next detection, because other choices depend on it.
///
/// So a thread may examine an edge while a neighbour flips. The edge must lose then, and it does,
/// whether the thread reads its words and triangles from before that flip or from after it. Before
/// and after, a flipping triangle contains the flipped edge, which is bad and comes first; or the
/// triangle has given the examined edge to its partner. No thread changes what a winner reads.
template <typename Rule, typename Worklist>
__device__ void ChooseAndFlip(
  const LoopView<Rule>& loop, const Worklist& worklist, const Team& team)
{
  unsigned flips = 0;
  worklist.Run(
    team, loop.Mesh, [&](const EdgeByte& byte) { return byte.Load(loop.Bits.Bad); },
    [&](EdgeId edge, const CornerPair& corners)
    {
      FlippedRecords flipped;
      OuterHalfEdges outer{};
      bool wins = false;
      if (edge != NoEdge)
      {
        const RecordPair records(loop.Mesh, corners);
        outer = records.GetOuter();
        wins = Wins(loop, edge, outer) && records.Hold(edge);
        if (wins)
        {
          FlipEdge(
            loop.Mesh, edge, records.GetQuad(), records.Upper, records.Lower, flipped.Keep());
        }
      }
      flipped.Store(loop.Mesh.Triangles);
      if (wins)
      {
        ++flips;
        EdgeBits::Set(loop.Bits.Winners, edge);
        MarkOuter(loop, outer);
      }
    });
  team.Add(IterationSum::Flipped, flips);
}

/// Passes 4 and 5: chooses without flipping, and winners claim their new edges. Sets Winners.
template <typename Rule, typename Worklist>
__device__ void ChooseAndClaim(
  const LoopView<Rule>& loop, const Worklist& worklist, const Team& team)
{
  worklist.Run(
    team, loop.Mesh, [&](const EdgeByte& byte) { return byte.Load(loop.Bits.Bad); },
    [&](EdgeId edge, const CornerPair& corners)
    {
      if (edge != NoEdge && Wins(loop, edge, GetOuterHalfEdges(loop.Mesh, corners.A, corners.B)))
      {
        const Quad quad = loop.Mesh.GetQuad(corners);
        bool isContested = false;
        loop.Guard.Claims.Claim(quad.A, quad.B, Priority(edge), isContested);
        EdgeBits::Set(loop.Bits.Winners, edge);
      }
    });
}

/// Pass 5: removes the winners that lost their claim; they stay bad.
template <typename Rule, typename Worklist>
__device__ void Confirm(const LoopView<Rule>& loop, const Worklist& worklist, const Team& team)
{
  worklist.Run(
    team, loop.Mesh, [&](const EdgeByte& byte) { return byte.Load(loop.Bits.Winners); },
    [&](EdgeId edge, const CornerPair& corners)
    {
      if (edge == NoEdge)
      {
        return;
      }
      const Quad quad = loop.Mesh.GetQuad(corners);
      if (!loop.Guard.Claims.Holds(quad.A, quad.B, Priority(edge)))
      {
        AtomicAnd(&loop.Bits.Winners[edge / 32], ~(1u << (edge % 32)));
      }
    });
}

template <bool IsGuarded>
__device__ void AddFlips(const Team& team, const StepCounts& counts)
{
  team.Add(IterationSum::Flipped, static_cast<unsigned>(counts.Flipped));
  if (IsGuarded)
  {
    team.Add(IterationSum::FreshSlots, static_cast<unsigned>(counts.FreshSlots));
    team.Add(IterationSum::FreedSlots, static_cast<unsigned>(counts.FreedSlots));
    team.Add(IterationSum::LostInserts, static_cast<unsigned>(counts.LostInserts));
  }
}

/// Pass 6: flips the winners of a Confirm and makes their outer edges candidates.
template <typename Rule, typename Worklist>
__device__ void FlipWinners(const LoopView<Rule>& loop, const Worklist& worklist, const Team& team)
{
  StepCounts counts;
  worklist.Run(
    team, loop.Mesh,
    [&](const EdgeByte& byte)
    {
      const unsigned winners = byte.Load(loop.Bits.Winners);
      if (winners != 0)
      {
        byte.Clear(loop.Bits.Winners, winners, winners);
        byte.Clear(loop.Bits.Bad, byte.Load(loop.Bits.Bad), winners);
      }
      return winners;
    },
    [&](EdgeId edge, const CornerPair& corners)
    {
      Quad quad{};
      OuterHalfEdges outer{};
      FlippedRecords flipped;
      if (edge != NoEdge)
      {
        const RecordPair records(loop.Mesh, corners);
        quad = records.GetQuad();
        outer = FlipEdge(loop.Mesh, edge, quad, records.Upper, records.Lower, flipped.Keep());
      }
      flipped.Store(loop.Mesh.Triangles);
      if (edge != NoEdge)
      {
        ++counts.Flipped;
        loop.Guard.Claims.Release(quad.A, quad.B, Priority(edge));
        UpdateGuard(loop.Guard.Edges, edge, quad, counts);
        MarkOuter(loop, outer);
      }
    });
  AddFlips<true>(team, counts);
}

}

#endif
