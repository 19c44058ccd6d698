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
/// warp; when the list is full, or at the end, it works on the edges of several units at once.

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

class DeviceWorklist
{
public:
  static constexpr int UnitBits = 8;
  static constexpr int UnitSize = 1 << UnitBits;

  /// Edges [first, last). @param flags one a unit of the mesh: only flagged ones are looked at;
  /// null: all are.
  __device__ DeviceWorklist(EdgeId first, EdgeId last, std::uint8_t* flags)
    : First(first),
      Last(last),
      Flags(flags)
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

  /// Calls look(byte) for every lane of every unit, which returns the bits of the edges to work on,
  /// then work(edge) for these; other units may have been looked at before.
  template <typename Look, typename Work>
  __device__ void Run(const Team& team, const Look& look, const Work& work) const
  {
    EdgeId* found = team.GetList();
    int size = 0;
    this->ForUnits(team,
      [&](unsigned unit)
      {
        const EdgeByte byte = this->GetByte(unit);
        size = Append(look(byte), byte, found, size);
        if (size > Team::ListSize - UnitSize)
        {
          ForList(found, size, work);
          size = 0;
        }
      });
    ForList(found, size, work);
  }

  /// Takes a unit that is being looked at off the list when no lane has anything to do.
  __device__ void Keep(const EdgeByte& byte, unsigned wanted) const
  {
    if (this->Flags && !__any_sync(WholeWarp, wanted != 0) && threadIdx.x % WarpSize == 0)
    {
      AtomicStore(&this->Flags[byte.Index / WarpSize], std::uint8_t(0));
    }
  }

private:
  __device__ EdgeByte GetByte(unsigned unit) const
  {
    const unsigned lane = threadIdx.x % WarpSize;
    const EdgeId edge = unit * UnitSize + 8 * lane;
    unsigned mask = 0xFF;
    mask &=
      edge < this->First ? (this->First - edge < 8 ? 0xFFu << (this->First - edge) : 0) : mask;
    mask &=
      edge + 8 > this->Last ? (this->Last > edge ? 0xFFu >> (edge + 8 - this->Last) : 0) : mask;
    return { unit * WarpSize + lane, mask & 0xFF };
  }

  template <typename Work>
  __device__ void ForUnits(const Team& team, const Work& work) const
  {
    const unsigned first = this->First >> UnitBits;
    const unsigned end = this->First < this->Last ? ((this->Last - 1) >> UnitBits) + 1 : first;
    const unsigned warps = team.GetNumberOfThreads() / WarpSize;
    const unsigned warp = team.GetThread() / WarpSize;
    if (this->Flags)
    {
      this->ForFlaggedUnits(warp, warps, end, work);
      return;
    }
    for (unsigned unit = first + warp; unit < end; unit += warps)
    {
      work(unit);
    }
  }

  /// Eight flags a lane: few warps have many to look at. Of the whole mesh, from unit 0 on.
  template <typename Work>
  __device__ void ForFlaggedUnits(
    unsigned warp, unsigned warps, unsigned end, const Work& work) const
  {
    constexpr unsigned Step = 8 * WarpSize;
    const auto* words = reinterpret_cast<const std::uint64_t*>(this->Flags);
    for (unsigned base = warp * Step; base < end; base += warps * Step)
    {
      const unsigned own = base + 8 * (threadIdx.x % WarpSize);
      const std::uint64_t word = own < end ? AtomicLoad(&words[own / 8]) : 0;
      const auto flags = static_cast<unsigned>((word * 0x0102040810204080u) >> 56);
      for (unsigned lanes = __ballot_sync(WholeWarp, flags != 0); lanes != 0; lanes &= lanes - 1)
      {
        const int lane = __ffs(lanes) - 1;
        for (unsigned left = __shfl_sync(WholeWarp, flags, lane); left != 0; left &= left - 1)
        {
          work(base + 8 * lane + (__ffs(left) - 1));
        }
      }
    }
  }

  /// Appends the edges of all lanes, in order. @returns the new size.
  __device__ static int Append(unsigned bits, const EdgeByte& byte, EdgeId* found, int size)
  {
    const unsigned lane = threadIdx.x % WarpSize;
    const int own = __popc(bits);
    int end = own;
    for (unsigned distance = 1; distance < WarpSize; distance *= 2)
    {
      const int other = __shfl_up_sync(WholeWarp, end, distance);
      end += lane >= distance ? other : 0;
    }
    for (EdgeId* next = found + size + (end - own); bits != 0; bits &= bits - 1)
    {
      *next++ = 8 * byte.Index + (__ffs(bits) - 1);
    }
    return size + __shfl_sync(WholeWarp, end, WarpSize - 1);
  }

  template <typename Work>
  __device__ static void ForList(const EdgeId* found, int size, const Work& work)
  {
    __syncwarp();
    for (int i = threadIdx.x % WarpSize; i < size; i += WarpSize)
    {
      work(found[i]);
    }
    __syncwarp();
  }

  EdgeId First, Last;
  std::uint8_t* Flags;
};

}

#endif
