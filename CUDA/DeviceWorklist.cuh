// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_DEVICEWORKLIST_CUH
#define DELAUNAYFLIP_DEVICEWORKLIST_CUH

#include "Atomics.h"
#include "EdgeGuard.h"
#include "EdgeMesh.h"
#include "HostDevice.h"
#include "Team.cuh"

#include <cstdint>

/// @file
/// What the loop's kernels share: the states of edges as bits, worklists of the edges with a set
/// bit, and the view of it all.

namespace delaunayflip
{

/// What the loop knows about the edges on a device: the states of EdgeMesh.h, as one bit per edge
/// and state, so that all of them fit into the second-level cache of a GPU.
struct EdgeBits
{
  /// EdgeState::Fixed, and the bits after the last edge; or Deferred. Bits in Candidates are
  /// ignored there.
  std::uint32_t* FixedOrDeferred;
  std::uint32_t* Candidates;
  std::uint32_t* Bad;
  std::uint32_t* Winners; ///< Bad edges that flip in this iteration.
  /// While iterations run within chunks, which have no guard, these are the deferred edges.
  std::uint32_t* BlockedByEdge;
  /// Includes the edges that their deviation blocks. With a rule that blocks none it is the array
  /// above.
  std::uint32_t* BlockedByShape;

  static constexpr int Kinds = 6;

  DELAUNAYFLIP_HOST_DEVICE static void Set(std::uint32_t* bits, EdgeId edge)
  {
    AtomicSet(&bits[edge / 32], std::uint32_t(1) << (edge % 32));
  }
  DELAUNAYFLIP_HOST_DEVICE static bool Has(const std::uint32_t* bits, EdgeId edge)
  {
    return (bits[edge / 32] >> (edge % 32) & 1u) != 0;
  }
};

//------------------------------------------------------------------------------
// The edges of a range that have a bit set. A warp takes units of 256 edges, one byte of bits per
// lane, and lists the edges with a set bit, in order, so that neighbours in the mesh are neighbours
// in the warp. Then it works on the list. If a warp has few units, all warps of the block share one
// list, so that they have equal work.

/// A lane's eight edges of a unit.
struct EdgeByte
{
  unsigned Index; ///< The index of the byte in every array of bits.
  unsigned Mask; ///< The edges that belong to the range.

  __device__ unsigned Load(const std::uint32_t* bits) const
  {
    return AtomicLoad(&reinterpret_cast<const std::uint8_t*>(bits)[this->Index]) & this->Mask;
  }

  /// Clears bits of the range. Other threads may change the other bits of a byte that two ranges
  /// share.
  __device__ void Clear(std::uint32_t* bits, unsigned value, unsigned clear) const
  {
    if (clear == 0)
    {
      return;
    }
    if (this->Mask == 0xFF)
    {
      AtomicStore(&reinterpret_cast<std::uint8_t*>(bits)[this->Index],
        static_cast<std::uint8_t>(value & ~clear));
    }
    else
    {
      AtomicAnd(&bits[this->Index / 4], ~(clear << (8 * (this->Index % 4))));
    }
  }
};

/// The units of a range, and how warps iterate over them.
class EdgeUnits
{
public:
  static constexpr int UnitBits = 8;
  static constexpr int UnitSize = 1 << UnitBits;
  static constexpr int MostSplits = 3;

  /// Edges [first, last).
  /// @param splits 2^splits warps share a unit, at most 8.
  /// @param isSpread whether neighbouring edges go to different blocks, so that all blocks have
  /// equal work where edges crowd: a warp takes each word of a unit from another place.
  __device__ EdgeUnits(EdgeId first, EdgeId last, int splits = 0, bool isSpread = false)
    : First(first),
      Last(last),
      Splits(splits),
      IsSpread(isSpread)
  {
  }

protected:
  __device__ EdgeByte GetByte(unsigned part) const
  {
    const unsigned lane = threadIdx.x % WarpSize;
    const unsigned unit = part >> this->Splits;
    const EdgeId edge = this->IsSpread ? this->FindSpread(unit) : unit * UnitSize + 8 * lane;
    const unsigned lanesOfPart = WarpSize >> this->Splits;
    const unsigned partOfUnit = part & ((1u << this->Splits) - 1);
    if (lane / lanesOfPart != partOfUnit)
    {
      return { edge / 8, 0 };
    }
    return { edge / 8, this->GetMask(edge) };
  }

  /// The position of a warp in its units, or in parts of them.
  struct UnitCursor
  {
    unsigned Next, End, Step;
  };

  __device__ UnitCursor StartUnits(const Team& team) const
  {
    const unsigned first = this->First >> UnitBits;
    const unsigned end = first + this->CountUnits();
    const unsigned warp = this->IsSpread ? team.GetSpreadWarp() : team.GetThread() / WarpSize;
    return { (first << this->Splits) + warp, end << this->Splits,
      team.GetNumberOfThreads() / WarpSize };
  }

  /// @returns false at the end.
  __device__ static bool GetNextUnit(UnitCursor& cursor, unsigned& unit)
  {
    unit = cursor.Next;
    cursor.Next += cursor.Step;
    return unit < cursor.End;
  }

  /// Writes a lane's edges, in order, to `next` and the following places.
  __device__ static void Write(unsigned bits, const EdgeByte& byte, EdgeId* next)
  {
    for (; bits != 0; bits &= bits - 1)
    {
      *next++ = 8 * byte.Index + (__ffs(bits) - 1);
    }
  }

  /// The number of edges of this lane and those before it.
  __device__ static int CountUpTo(int own)
  {
    const unsigned lane = threadIdx.x % WarpSize;
    int end = own;
    for (unsigned distance = 1; distance < WarpSize; distance *= 2)
    {
      const int other = __shfl_up_sync(WholeWarp, end, distance);
      if (lane >= distance)
      {
        end += other;
      }
    }
    return end;
  }

  /// Calls work for every `step`-th edge, while the corners of the next one are being loaded.
  template <typename Work>
  __device__ static void WorkOn(
    const EdgeMeshView& mesh, const EdgeId* found, int size, int step, int thread, const Work& work)
  {
    const auto getEdge = [&](int i) { return i < size ? found[i] : NoEdge; };
    const auto getCorners = [&](EdgeId edge)
    { return edge == NoEdge ? CornerPair{} : mesh.GetCorners(edge); };
    EdgeId next = getEdge(thread);
    CornerPair nextCorners = getCorners(next);
    for (int i = thread; i - thread % WarpSize < size; i += step)
    {
      const EdgeId edge = next;
      const CornerPair corners = nextCorners;
      next = getEdge(i + step);
      nextCorners = getCorners(next);
      work(edge, corners);
    }
  }

private:
  __device__ unsigned CountUnits() const
  {
    if (this->First >= this->Last)
    {
      return 0;
    }
    return ((this->Last - 1) >> UnitBits) + 1 - (this->First >> UnitBits);
  }

  /// The bits of those of eight edges, from `edge` on, that belong to the range.
  __device__ unsigned GetMask(EdgeId edge) const
  {
    if (edge + 8 <= this->First || edge >= this->Last)
    {
      return 0;
    }
    unsigned mask = 0xFF;
    if (edge < this->First)
    {
      mask <<= this->First - edge;
    }
    if (edge + 8 > this->Last)
    {
      mask &= 0xFFu >> (edge + 8 - this->Last);
    }
    return mask & 0xFF;
  }

  /// The first edge of this lane.
  __device__ EdgeId FindSpread(unsigned unit) const
  {
    constexpr unsigned LanesOfWord = 4;
    const unsigned lane = threadIdx.x % WarpSize;
    const unsigned first = this->First >> UnitBits;
    const unsigned word =
      first * (UnitSize / 32) + lane / LanesOfWord * this->CountUnits() + unit - first;
    return 32 * word + 8 * (lane % LanesOfWord);
  }

  EdgeId First, Last;
  int Splits;
  bool IsSpread;
};

/// Every warp works on the edges that it finds.
class WarpWorklist : public EdgeUnits
{
public:
  using EdgeUnits::EdgeUnits;

  /// Calls look(byte) for every lane of every unit, which returns the bits of the edges to work on,
  /// then work(edge, corners) for these edges; several units may be looked at before. All lanes of
  /// a warp call work together, some with NoEdge.
  template <typename Look, typename Work>
  __device__ void Run(
    const Team& team, const EdgeMeshView& mesh, const Look& look, const Work& work) const
  {
    EdgeId* found = team.GetList();
    UnitCursor cursor = this->StartUnits(team);
    for (bool hasMore = true; hasMore;)
    {
      int size = 0;
      unsigned unit = 0;
      while (size <= Enough && (hasMore = GetNextUnit(cursor, unit)))
      {
        const EdgeByte byte = this->GetByte(unit);
        const unsigned bits = look(byte);
        const int end = CountUpTo(__popc(bits));
        Write(bits, byte, found + size + end - __popc(bits));
        size += __shfl_sync(WholeWarp, end, WarpSize - 1);
      }
      __syncwarp();
      WorkOn(mesh, found, size, WarpSize, threadIdx.x % WarpSize, work);
      __syncwarp();
    }
  }

  /// Whether `own` is true for any of the threads that share a list.
  __device__ static bool IsAny(bool own) { return __any_sync(WholeWarp, own) != 0; }

private:
  /// With this many edges a warp starts to work instead of visiting one more unit, which is far
  /// away in memory: what all warps work on should fit into the second-level cache.
  static constexpr int Enough = WarpSize;
};

/// All warps of a block work on the edges that they find together.
class BlockWorklist : public EdgeUnits
{
public:
  using EdgeUnits::EdgeUnits;

  /// Does what WarpWorklist::Run does.
  template <typename Look, typename Work>
  __device__ void Run(
    const Team& team, const EdgeMeshView& mesh, const Look& look, const Work& work) const
  {
    EdgeId* found = team.GetListOfBlock();
    UnitCursor cursor = this->StartUnits(team);
    bool hasMore = true;
    for (bool anyHasMore = true; anyHasMore;)
    {
      int* size = team.GetSizeOfList();
      unsigned unit = 0;
      while (__shfl_sync(WholeWarp, AtomicLoad(size), 0) <= MostBeforeUnit &&
        (hasMore = hasMore && GetNextUnit(cursor, unit)))
      {
        const EdgeByte byte = this->GetByte(unit);
        const unsigned bits = look(byte);
        const int end = CountUpTo(__popc(bits));
        int before = 0;
        if (threadIdx.x % WarpSize == WarpSize - 1 && end > 0)
        {
          before = atomicAdd(size, end);
        }
        before = __shfl_sync(WholeWarp, before, WarpSize - 1);
        Write(bits, byte, found + before + end - __popc(bits));
      }
      anyHasMore = __syncthreads_or(hasMore) != 0;
      const int total = *size;
      WorkOn(mesh, found, total, LoopThreads, threadIdx.x, work);
      __syncthreads();
      if (threadIdx.x == 0)
      {
        *size = 0;
      }
      __syncthreads();
    }
  }

  __device__ static bool IsAny(bool own) { return __syncthreads_or(own) != 0; }

private:
  /// Leaves room for one unit of every warp.
  static constexpr int MostBeforeUnit = LoopWarps * (WarpListSize - UnitSize);
};

/// The edges of a chunk of FlipLoop's schedule.
struct DeviceChunk
{
  EdgeId FirstEdge, LastEdge;
};

/// What the loop's kernels read and write.
template <typename Rule>
struct LoopView
{
  EdgeMeshView Mesh; ///< Its States are the initial ones.
  Rule Decision;
  EdgeGuardView Guard;
  EdgeBits Bits;
  int Splits; ///< 2^Splits warps share a unit.
  int Devices; ///< How many GPUs iterate on the whole mesh together.
  EdgeId FirstEdge, LastEdge; ///< The range of this GPU.
  DeviceChunk* Chunks;
  int FirstChunk, LastChunk; ///< The range of this GPU.
  TeamState* Teams; ///< Zero before a launch.
  IterationSums* Sums; ///< One per iteration, and those of a detection; zero before a launch.
  int* EntriesUsed; ///< How many of Sums IterateKernel has used.

  __device__ WarpWorklist GetWorklist() const
  {
    return { this->FirstEdge, this->LastEdge, this->Splits };
  }
  __device__ WarpWorklist GetSpreadWorklist() const
  {
    return { this->FirstEdge, this->LastEdge, this->Splits, true };
  }
  __device__ BlockWorklist GetWorklist(const DeviceChunk& chunk) const
  {
    return { chunk.FirstEdge, chunk.LastEdge };
  }
};

}

#endif
