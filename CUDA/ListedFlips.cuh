// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_LISTEDFLIPS_CUH
#define DELAUNAYFLIP_LISTEDFLIPS_CUH

#include "DetectionPhases.cuh"
#include "FlipPhases.cuh"

/// @file
/// Iterations with few bad edges. The detection lists the bad edges with everything that a choice
/// reads except the states of the neighbours, which do not change before the next detection. So
/// winners may flip while other threads still choose, and there are fewer dependent loads, which
/// are most of the time of such an iteration.

namespace delaunayflip
{

/// The bad edges that a warp has found, in shared memory.
class BadList
{
public:
  __device__ BadEdge& operator[](int i) const
  {
    return GetTeamMemory().Listed[threadIdx.x / WarpSize][i];
  }
  __device__ int GetSize() const { return this->Size; }
  __device__ bool HasOverflown() const { return this->Size > MostListedByWarp; }
  __device__ void Clear() { this->Size = 0; }

  /// Adds the bad edges among those of the warp's lanes, as long as there is room.
  __device__ void Add(bool isBad, const BadEdge& edge)
  {
    const unsigned bad = __ballot_sync(WholeWarp, isBad);
    const int place = this->Size + __popc(bad & ((1u << (threadIdx.x % WarpSize)) - 1));
    if (isBad && place < MostListedByWarp)
    {
      (*this)[place] = edge;
    }
    this->Size += __popc(bad);
  }

private:
  int Size = 0; ///< The same in all lanes.
};

/// The same as Detect, but also lists the bad edges, and warns if the list is too short. Bad edges
/// that are not candidates are judged again to be listed; they do not count as tested.
template <typename Rule>
__device__ void DetectAndList(
  const LoopView<Rule>& loop, const WarpWorklist& worklist, const Team& team, BadList& list)
{
  DetectionCounts counts;
  list.Clear();
  worklist.Run(
    team, loop.Mesh,
    [&](const EdgeByte& byte) { return TakeCandidates(loop, byte, true, false, counts); },
    [&](EdgeId edge, const CornerPair& corners)
    {
      BadEdge found{ edge, corners, {} };
      EdgeState state = EdgeState::Good;
      if (edge != NoEdge)
      {
        found.Outer = GetOuterHalfEdges(loop.Mesh, corners.A, corners.B);
        state = JudgeAndNote(loop, edge, corners, counts);
      }
      list.Add(state == EdgeState::Bad, found);
    });
  counts.AddTo<Rule>(team);
  team.Warn(counts.Uncertain || list.HasOverflown());
  if constexpr (Rule::MayBeUncertain)
  {
    if (worklist.IsAny(counts.Uncertain))
    {
      ResolveUncertain(loop, worklist, team);
    }
  }
}

/// Chooses among the bad edges, all of which are in the lists of the warps, and flips the winners.
/// Winners stay marked as bad until the next DetectAndList, because other choices depend on it.
template <typename Rule>
__device__ void FlipListed(const LoopView<Rule>& loop, const Team& team, const BadList& list)
{
  unsigned flips = 0;
  const int lane = threadIdx.x % WarpSize;
  for (int i = lane; i - lane < list.GetSize(); i += WarpSize)
  {
    FlippedRecords flipped;
    bool wins = false;
    BadEdge bad{};
    if (i < list.GetSize())
    {
      bad = list[i];
      const RecordPair records(loop.Mesh, bad.Corners);
      wins = Wins(loop, bad.Edge, bad.Outer);
      if (wins)
      {
        FlipEdge(
          loop.Mesh, bad.Edge, records.GetQuad(), records.Upper, records.Lower, flipped.Keep());
      }
    }
    flipped.Store(loop.Mesh.Triangles);
    if (wins)
    {
      ++flips;
      EdgeBits::Set(loop.Bits.Winners, bad.Edge);
      MarkOuter(loop, bad.Outer);
    }
  }
  team.Add(IterationSum::Flipped, flips);
}

}

#endif
