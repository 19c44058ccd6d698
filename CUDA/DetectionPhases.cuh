// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_DETECTIONPHASES_CUH
#define DELAUNAYFLIP_DETECTIONPHASES_CUH

#include "DeviceWorklist.cuh"
#include "EdgeMesh.h"
#include "FlipSteps.h"
#include "Team.cuh"

/// @file
/// The passes of an iteration that judge edges and count the bad ones (1 to 3 of FlipLoop.h), on a
/// worklist of the device.

namespace delaunayflip
{

/// Records the state of an edge that was judged. @returns whether the edge is bad.
template <typename Rule>
__device__ bool NoteState(
  const LoopView<Rule>& loop, EdgeId edge, EdgeState state, unsigned& blockedByShape)
{
  if (state == EdgeState::Bad)
  {
    EdgeBits::Set(loop.Bits.Bad, edge);
  }
  if (Rule::MayBlock && state == EdgeState::BlockedByShape)
  {
    EdgeBits::Set(loop.Bits.BlockedByShape, edge);
    ++blockedByShape;
  }
  return state == EdgeState::Bad;
}

/// Judges exactly the edges that Detect could not decide and left as candidates. A separate
/// function, because it is large and seldom called: inlined into Detect's loop it would take the
/// registers of everything else there.
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
      isBad += NoteState(loop, edge, state, isBlockedByShape) ? 1 : 0;
      uncertain += state == EdgeState::Uncertain ? 1 : 0;
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
template <typename Rule>
__device__ EdgeState JudgeAndNote(
  const LoopView<Rule>& loop, EdgeId edge, const CornerPair& corners, DetectionCounts& counts)
{
  const EdgeState state = loop.Decision.Judge(loop.Mesh.GetQuad(corners));
  if (state == EdgeState::Uncertain)
  {
    EdgeBits::Set(loop.Bits.Candidates, edge);
    counts.Uncertain = true;
  }
  counts.IsBad += NoteState(loop, edge, state, counts.IsBlockedByShape) ? 1 : 0;
  return state;
}

/// Takes the edges to judge from a byte and clears their bits: its candidates and, with takeBad,
/// the other bad edges. Edges that have flipped since the last detection are no longer bad.
template <typename Rule>
__device__ unsigned TakeCandidates(const LoopView<Rule>& loop, const EdgeByte& byte, bool takeBad,
  bool hasGuard, DetectionCounts& counts)
{
  // All loads are issued before any result is used.
  const EdgeBits& bits = loop.Bits;
  const unsigned marked = byte.Load(bits.Candidates);
  const unsigned fixedOrDeferred = byte.Load(bits.FixedOrDeferred);
  const unsigned winners = byte.Load(bits.Winners);
  const unsigned seenBad = byte.Load(bits.Bad);
  const unsigned blockedByShape = Rule::MayBlock ? byte.Load(bits.BlockedByShape) : 0;
  const unsigned blockedByEdge = hasGuard ? byte.Load(bits.BlockedByEdge) : 0;
  const unsigned candidates = marked & ~fixedOrDeferred;
  const unsigned bad = seenBad & ~winners;
  byte.Clear(bits.Candidates, marked, marked);
  byte.Clear(bits.Winners, winners, winners);
  byte.Clear(bits.Bad, seenBad, takeBad ? seenBad : winners | (candidates & bad));
  byte.Clear(bits.BlockedByShape, blockedByShape, candidates & blockedByShape);
  byte.Clear(bits.BlockedByEdge, blockedByEdge, candidates & blockedByEdge);
  counts.Tested += __popc(candidates);
  counts.WasBad += __popc(takeBad ? bad : candidates & bad);
  counts.WasBlockedByShape += __popc(candidates & blockedByShape);
  return takeBad ? candidates | bad : candidates;
}

/// Judges the candidates.
template <typename Rule, typename Worklist>
__device__ void Detect(const LoopView<Rule>& loop, const Worklist& worklist, const Team& team)
{
  DetectionCounts counts;
  worklist.Run(
    team, loop.Mesh,
    [&](const EdgeByte& byte)
    { return TakeCandidates(loop, byte, false, HasGuard<Worklist>(loop), counts); },
    [&](EdgeId edge, const CornerPair& corners)
    {
      if (edge != NoEdge)
      {
        JudgeAndNote(loop, edge, corners, counts);
      }
    });
  counts.AddTo<Rule>(team);
  if constexpr (Rule::MayBeUncertain)
  {
    if (worklist.IsAny(counts.Uncertain))
    {
      ResolveUncertain(loop, worklist, team);
    }
  }
}

/// Checks every edge that is bad or blocked by the guard again, and blocks or frees it.
template <typename Rule, typename Worklist>
__device__ void GuardBadEdges(
  const LoopView<Rule>& loop, const Worklist& worklist, const Team& team)
{
  const EdgeBits& bits = loop.Bits;
  unsigned allBad = 0, allBlockedByEdge = 0;
  worklist.Run(
    team, loop.Mesh,
    [&](const EdgeByte& byte)
    {
      const unsigned bad = byte.Load(bits.Bad);
      const unsigned blockedByEdge = byte.Load(bits.BlockedByEdge);
      byte.Clear(bits.Bad, bad, bad);
      byte.Clear(bits.BlockedByEdge, blockedByEdge, blockedByEdge);
      return bad | blockedByEdge;
    },
    [&](EdgeId edge, const CornerPair& corners)
    {
      if (edge == NoEdge)
      {
        return;
      }
      const bool isBad = DecideByGuard(loop.Guard.Edges, loop.Mesh.GetQuad(edge)) == EdgeState::Bad;
      EdgeBits::Set(isBad ? bits.Bad : bits.BlockedByEdge, edge);
      allBad += isBad ? 1 : 0;
      allBlockedByEdge += isBad ? 0 : 1;
    });
  team.Add(IterationSum::AllBad, allBad);
  team.Add(IterationSum::AllBlockedByEdge, allBlockedByEdge);
}

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
      blockedByShape += __popc(byte.Load(loop.Bits.BlockedByShape));
      blockedByEdge += __popc(byte.Load(loop.Bits.BlockedByEdge));
      return 0u;
    },
    [](EdgeId, const CornerPair&) {});
  team.Add(IterationSum::AllBad, bad);
  team.Add(IterationSum::AllBlockedByShape, blockedByShape);
  team.Add(IterationSum::AllBlockedByEdge, blockedByEdge);
}

}

#endif
