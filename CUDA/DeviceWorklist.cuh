// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_DEVICEWORKLIST_CUH
#define DELAUNAYFLIP_DEVICEWORKLIST_CUH

#include "EdgeBits.h"
#include "EdgeMesh.h"
#include "Team.cuh"

#include <cstdint>

/// @file
/// The edges of a range that have a bit set. A warp takes units of 256 edges, a byte of bits a
/// lane, and lists what is set, in order, so that neighbours in the mesh are neighbours in the
/// warp; then they are worked on: by the warp itself where it has many units, else by all warps of
/// the block, which have equal work so.

namespace delaunayflip
{

/// A lane's eight edges of a unit.
struct EdgeByte
{
  unsigned Index; ///< Of the byte in every array of bits.
  unsigned Mask; ///< Of the edges that belong to the range.

  __device__ unsigned Load(const std::uint32_t* bits) const
  {
    return AtomicLoad(&reinterpret_cast<const std::uint8_t*>(bits)[this->Index]) & this->Mask;
  }

  /// Clears bits of the range. Others may change the rest of a byte that two ranges share.
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

/// Which edges, and how they are found.
class EdgeUnits
{
public:
  static constexpr int UnitBits = 8;
  static constexpr int UnitSize = 1 << UnitBits;
  static constexpr int MostSplits = 3;
  /// Flags that a warp reads at a time.
  static constexpr unsigned FlagsOfWarp = 8 * WarpSize;

  /// Edges [first, last). @param flags one a unit of the mesh: only flagged ones are looked at;
  /// null: all are. @param splits 2^splits warps share a unit where not all are flagged, at most 8.
  __device__ EdgeUnits(EdgeId first, EdgeId last, std::uint8_t* flags, int splits = 0)
    : First(first),
      Last(last),
      Flags(flags),
      Splits(splits)
  {
  }

  /// Makes sure that an edge's unit is looked at.
  __device__ void Activate(EdgeId edge) const
  {
    if (this->Flags)
    {
      AtomicStore(&this->Flags[edge >> UnitBits], std::uint8_t(1));
    }
  }

  /// Takes a unit that is being looked at off the list when no lane has anything to do.
  __device__ void Keep(const EdgeByte& byte, unsigned wanted) const
  {
    if (this->Flags && !__any_sync(WholeWarp, wanted != 0) && threadIdx.x % WarpSize == 0)
    {
      AtomicStore(&this->Flags[byte.Index / WarpSize], std::uint8_t(0));
    }
  }

protected:
  __device__ EdgeByte GetByte(unsigned part) const
  {
    const unsigned lane = threadIdx.x % WarpSize;
    const unsigned unit = part >> this->Splits;
    const EdgeId edge = unit * UnitSize + 8 * lane;
    const unsigned lanesOfPart = WarpSize >> this->Splits;
    unsigned mask = lane / lanesOfPart == (part & ((1u << this->Splits) - 1)) ? 0xFF : 0;
    mask &=
      edge < this->First ? (this->First - edge < 8 ? 0xFFu << (this->First - edge) : 0) : mask;
    mask &=
      edge + 8 > this->Last ? (this->Last > edge ? 0xFFu >> (edge + 8 - this->Last) : 0) : mask;
    return { unit * WarpSize + lane, mask & 0xFF };
  }

  /// Where a warp is in its units: every so many-th unit or part of one, or the flagged units of
  /// every so many-th stretch of 256.
  struct UnitCursor
  {
    unsigned Next, End, Step;
    unsigned Flags; ///< A lane's eight of the stretch before Next that have not been visited.
  };

  __device__ UnitCursor StartUnits(const Team& team) const
  {
    const unsigned first = this->First >> UnitBits;
    const unsigned end = this->First < this->Last ? ((this->Last - 1) >> UnitBits) + 1 : first;
    const unsigned warp = team.GetThread() / WarpSize;
    const unsigned warps = team.GetNumberOfThreads() / WarpSize;
    const unsigned stride = this->Flags ? FlagsOfWarp : 1;
    return { (first << this->Splits) + stride * warp, end << this->Splits, stride * warps, 0 };
  }

  /// @returns false at the end.
  __device__ bool GetNextUnit(UnitCursor& cursor, unsigned& unit) const
  {
    if (this->Flags)
    {
      return this->GetNextFlagged(cursor, unit);
    }
    unit = cursor.Next;
    cursor.Next += cursor.Step;
    return unit < cursor.End;
  }

  /// Eight flags a lane: few warps have many to look at. Of the whole mesh, from unit 0 on.
  __device__ bool GetNextFlagged(UnitCursor& cursor, unsigned& unit) const
  {
    const auto* words = reinterpret_cast<const std::uint64_t*>(this->Flags);
    unsigned lanes = __ballot_sync(WholeWarp, cursor.Flags != 0);
    for (; lanes == 0; lanes = __ballot_sync(WholeWarp, cursor.Flags != 0))
    {
      if (cursor.Next >= cursor.End)
      {
        return false;
      }
      const unsigned own = cursor.Next + 8 * (threadIdx.x % WarpSize);
      const std::uint64_t word = own < cursor.End ? AtomicLoad(&words[own / 8]) : 0;
      cursor.Flags = static_cast<unsigned>((word * 0x0102040810204080u) >> 56);
      cursor.Next += cursor.Step;
    }
    const int lane = __ffs(lanes) - 1;
    const int flag = __ffs(__shfl_sync(WholeWarp, cursor.Flags, lane)) - 1;
    unit = cursor.Next - cursor.Step + 8 * lane + flag;
    cursor.Flags &= threadIdx.x % WarpSize == lane ? cursor.Flags - 1 : ~0u;
    return true;
  }

  /// Writes a lane's edges, in order, from `next` on.
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
      end += lane >= distance ? other : 0;
    }
    return end;
  }

  /// Calls work for every `step`-th edge. The next one's corners are on their way meanwhile.
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
  EdgeId First, Last;
  std::uint8_t* Flags;
  int Splits;
};

/// Every warp works on what it finds.
class WarpWorklist : public EdgeUnits
{
public:
  using EdgeUnits::EdgeUnits;
  static constexpr bool MayGuard = true; ///< Whether flips may have a guard.

  /// Calls look(byte) for every lane of every unit, which returns the bits of the edges to work on,
  /// then work(edge, corners) for these; other units may have been looked at before. All lanes of a
  /// warp call work at a time, some with NoEdge.
  template <typename Look, typename Work>
  __device__ void Run(
    const Team& team, const EdgeMeshView& mesh, const Look& look, const Work& work) const
  {
    EdgeId* found = team.GetList();
    UnitCursor cursor = this->StartUnits(team);
    for (bool goOn = true; goOn;)
    {
      int size = 0;
      unsigned unit = 0;
      while (size <= Enough && (goOn = this->GetNextUnit(cursor, unit)))
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

  /// Whether any thread says so of those that share a list.
  __device__ static bool IsAny(bool own) { return __any_sync(WholeWarp, own) != 0; }

private:
  /// A warp works on what it has rather than look at one more unit, which is far away: what all
  /// warps are at should fit the second-level cache.
  static constexpr int Enough = WarpSize;
};

/// All warps of a block work on what they find.
class BlockWorklist : public EdgeUnits
{
public:
  using EdgeUnits::EdgeUnits;
  static constexpr bool MayGuard = false;

  /// As WarpWorklist::Run.
  template <typename Look, typename Work>
  __device__ void Run(
    const Team& team, const EdgeMeshView& mesh, const Look& look, const Work& work) const
  {
    EdgeId* found = team.GetListOfBlock();
    UnitCursor cursor = this->StartUnits(team);
    bool goOn = true;
    for (bool anyGoesOn = true; anyGoesOn;)
    {
      int* size = team.GetSizeOfList();
      unsigned unit = 0;
      while (__shfl_sync(WholeWarp, AtomicLoad(size), 0) <= MostBeforeUnit &&
        (goOn = goOn && this->GetNextUnit(cursor, unit)))
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
      anyGoesOn = __syncthreads_or(goOn) != 0;
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
  /// So many leave room for a unit of every warp.
  static constexpr int MostBeforeUnit = LoopWarps * (WarpListSize - UnitSize);
};

}

#endif
