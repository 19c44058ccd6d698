// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_MOUNTAINS_H
#define DELAUNAYFLIP_MOUNTAINS_H

#include "EdgeMesh.h"
#include "ExactPredicates.h"
#include "HostDevice.h"
#include "Strips.h"

#include <cstdint>

/// @file
/// The second part of a triangulation of points: the gaps between neighbouring chains.
///
/// The points of two neighbouring chains, merged by (x, y), are the slots of their gap. Wherever
/// two consecutive slots are of different chains, the segment between their points crosses nothing:
/// this is a diagonal. The diagonals cut the gap into mountains: a mountain is a run of slots of
/// one chain and, as its base, the edge of the other chain that spans it. (Fournier and Montuno,
/// ACM Transactions on Graphics 3, 1984; Chazelle and Incerpi, the same volume.) A run of k points
/// is triangulated by k triangles, by cutting ears. The runs at the two ends of a gap have no base;
/// what lies beyond the outermost diagonals is left to Hull.h.

namespace delaunayflip
{

/// The label of an edge of a path that no triangle has yet.
constexpr std::uint32_t OpenEdge = NoCorner;

/// The triangles on both sides of an edge of a chain (below, above) or of a diagonal (left, right).
using SideCorners = CornerPair;

/// Where a gap's triangles are.
struct Gap
{
  std::uint32_t LeftRun, RightRun; ///< Slots of the runs at its ends.
  bool LeftIsLower, RightIsLower; ///< Whether these runs are of the lower chain.
  std::int64_t FirstTriangle;
};

/// What the functions of this file read and write, in the memory of a backend.
template <typename Real>
struct ChainView
{
  const CoordinatePair<Real>* Places;
  const std::uint32_t* Starts; ///< Of every chain its first place, and the number of places.
  std::int64_t Chains;
  const Gap* Gaps; ///< Of every chain but the last one.
  TriangleRecord* Triangles;
  CornerId* SidesOfEdge; ///< Two per place: of the edge that ends there in its chain.
  CornerId* SidesOfDiagonal; ///< Two per slot: of the diagonal between the slot before and it.
  std::int32_t* Failed; ///< Set to 1 if a device cannot decide a turn.

  DELAUNAYFLIP_HOST_DEVICE PlanePoint GetPoint(VertexId place) const
  {
    return { this->Places[place].U, this->Places[place].V, 0.0 };
  }

  DELAUNAYFLIP_HOST_DEVICE int Turn(VertexId a, VertexId b, VertexId c) const
  {
    const int sign = FindOrientation(this->GetPoint(a), this->GetPoint(b), this->GetPoint(c));
    if (sign == UncertainSign)
    {
      *this->Failed = 1;
    }
    return sign;
  }

  /// Whether a place of the lower chain comes before one of the upper chain, by (x, y).
  DELAUNAYFLIP_HOST_DEVICE bool IsBefore(std::uint32_t lower, std::uint32_t upper) const
  {
    return this->Places[lower].U <= this->Places[upper].U;
  }

  /// The first slot of a gap, counted through all gaps.
  DELAUNAYFLIP_HOST_DEVICE std::int64_t FirstSlot(std::int64_t gap) const
  {
    return std::int64_t(this->Starts[gap]) + this->Starts[gap + 1] - this->Starts[1];
  }
  DELAUNAYFLIP_HOST_DEVICE std::int64_t CountSlots() const
  {
    return this->FirstSlot(this->Chains - 1) + this->Starts[0];
  }

  /// Joins two corners across their common edge. NoCorner: there is none on that side.
  DELAUNAYFLIP_HOST_DEVICE void Join(CornerId a, CornerId b) const
  {
    if (a != NoCorner)
    {
      this->Triangles[TriangleOf(a)].HalfEdges[SlotOf(a)] = b;
    }
    if (b != NoCorner)
    {
      this->Triangles[TriangleOf(b)].HalfEdges[SlotOf(b)] = a;
    }
  }
};

/// How many slots of a gap precede its first and follow its last diagonal.
template <typename Real>
DELAUNAYFLIP_HOST_DEVICE Gap MeasureGap(const ChainView<Real>& chains, std::int64_t gap)
{
  const std::uint32_t lower = chains.Starts[gap];
  const std::uint32_t upper = chains.Starts[gap + 1];
  const std::uint32_t end = chains.Starts[gap + 2];
  // How many of the lower chain come before a place of the upper one, and the reverse.
  const auto countLower = [&](std::uint32_t place)
  {
    return FindEnd(
             lower, upper, [&](std::uint32_t other) { return chains.IsBefore(other, place); }) -
      lower;
  };
  const auto countUpper = [&](std::uint32_t place)
  {
    return FindEnd(
             upper, end, [&](std::uint32_t other) { return !chains.IsBefore(place, other); }) -
      upper;
  };
  const std::uint32_t fromUpper = countUpper(lower);
  const std::uint32_t lowerAtEnd = (upper - lower) - countLower(end - 1);
  return { fromUpper > 0 ? fromUpper : countLower(upper),
    lowerAtEnd > 0 ? lowerAtEnd : (end - upper) - countUpper(upper - 1), fromUpper == 0,
    lowerAtEnd > 0, 0 };
}

/// A path of vertices from left to right of which ears are cut until only what is convex, or in a
/// mountain its base, is left. The path between its two ends is kept in records of triangles that
/// are made later: a vertex in InputTriangle, the label of the edge before it in Flips. A label is
/// the corner of the triangle that has been cut off there, or says that there is none yet.
template <typename Real, typename Open>
struct EarCutter
{
  const ChainView<Real>& Chains;
  TriangleRecord* Path;
  std::uint32_t Size; ///< Of the path without its ends.
  VertexId Left, Right;
  std::uint32_t LastLabel; ///< Of the edge before Right.
  int Side; ///< 1: ears turn to the right (a run above its base); -1: to the left.
  TriangleId Next; ///< The number of the next triangle.
  const Open& SetOpen; ///< SetOpen(label, first, last, corner): an open edge got a triangle.

  /// Rounds that cut every second ear, so that the triangles are balanced like a tournament: a
  /// stack alone makes fans, the worst start for flips along a convex curve. When a round cuts
  /// less than a quarter of the path, a stack does the rest, so that all is linear.
  DELAUNAYFLIP_HOST_DEVICE void Cut()
  {
    for (bool goesOn = this->Size > 0; goesOn;)
    {
      const std::uint32_t before = this->Size;
      this->CutRound();
      goesOn = this->Size > 0 && 4 * (before - this->Size) >= before + 2;
    }
    this->CutByStack();
  }

private:
  DELAUNAYFLIP_HOST_DEVICE bool IsEar(VertexId a, VertexId b, VertexId c) const
  {
    return this->Chains.Turn(a, b, c) == -this->Side;
  }

  /// Makes a triangle of two consecutive edges. @returns the label of the edge that replaces them.
  DELAUNAYFLIP_HOST_DEVICE std::uint32_t Emit(
    VertexId a, VertexId b, VertexId c, std::uint32_t first, std::uint32_t second)
  {
    const bool swaps = this->Side > 0;
    TriangleRecord& made = this->Chains.Triangles[this->Next];
    made.Vertices[0] = a;
    made.Vertices[1] = swaps ? c : b;
    made.Vertices[2] = swaps ? b : c;
    this->Attach(first, a, b, MakeCorner(this->Next, swaps ? 1 : 2));
    this->Attach(second, b, c, MakeCorner(this->Next, 0));
    return MakeCorner(this->Next++, swaps ? 2 : 1);
  }

  DELAUNAYFLIP_HOST_DEVICE void Attach(
    std::uint32_t label, VertexId first, VertexId last, CornerId corner) const
  {
    if (this->SetOpen.IsOpen(label))
    {
      this->SetOpen(label, first, last, corner);
    }
    else
    {
      this->Chains.Join(label, corner);
    }
  }

  DELAUNAYFLIP_HOST_DEVICE void CutRound()
  {
    std::uint32_t kept = 0;
    VertexId previous = this->Left;
    for (std::uint32_t i = 0; i < this->Size;)
    {
      const VertexId here = this->Path[i].InputTriangle;
      const std::uint32_t label = this->Path[i].Flips;
      const bool isLast = i + 1 == this->Size;
      const VertexId next = isLast ? this->Right : this->Path[i + 1].InputTriangle;
      if (!this->IsEar(previous, here, next))
      {
        this->Path[kept].InputTriangle = here;
        this->Path[kept++].Flips = label;
        previous = here;
        ++i;
        continue;
      }
      const std::uint32_t nextLabel = isLast ? this->LastLabel : this->Path[i + 1].Flips;
      const std::uint32_t made = this->Emit(previous, here, next, label, nextLabel);
      if (isLast)
      {
        this->LastLabel = made;
      }
      else
      {
        this->Path[kept].InputTriangle = next;
        this->Path[kept++].Flips = made;
        previous = next;
      }
      i += 2;
    }
    this->Size = kept;
  }

  DELAUNAYFLIP_HOST_DEVICE void CutByStack()
  {
    std::uint32_t top = 0;
    for (std::uint32_t i = 0; i <= this->Size; ++i)
    {
      const bool isLast = i == this->Size;
      const VertexId next = isLast ? this->Right : this->Path[i].InputTriangle;
      std::uint32_t label = isLast ? this->LastLabel : this->Path[i].Flips;
      while (top > 0)
      {
        const VertexId before = top > 1 ? this->Path[top - 2].InputTriangle : this->Left;
        const VertexId here = this->Path[top - 1].InputTriangle;
        if (!this->IsEar(before, here, next))
        {
          break;
        }
        label = this->Emit(before, here, next, this->Path[top - 1].Flips, label);
        --top;
      }
      if (isLast)
      {
        this->LastLabel = label;
        break;
      }
      this->Path[top].InputTriangle = next;
      this->Path[top++].Flips = label;
    }
    this->Size = top;
  }
};

/// The open edges of a mountain: its two diagonals, and edges of its chain.
struct MountainEdges
{
  CornerId* SidesOfEdge;
  CornerId* SidesOfDiagonal; ///< Those of the mountain's first slot.
  std::uint32_t Slots;
  VertexId Left, Right;
  bool IsAbove; ///< Whether the mountain's run lies above its base, so the mountain below the run.

  DELAUNAYFLIP_HOST_DEVICE static bool IsOpen(std::uint32_t label) { return label == OpenEdge; }

  DELAUNAYFLIP_HOST_DEVICE void operator()(
    std::uint32_t, VertexId first, VertexId last, CornerId corner) const
  {
    if (first == this->Left)
    {
      this->SidesOfDiagonal[1] = corner;
    }
    else if (last == this->Right)
    {
      this->SidesOfDiagonal[std::size_t(2) * this->Slots] = corner;
    }
    else
    {
      this->SidesOfEdge[std::size_t(2) * last + (this->IsAbove ? 0 : 1)] = corner;
    }
  }
};

/// Triangulates the mountain of `size` places from `first` on.
/// @param base the places of the other chain before and after them.
template <typename Real>
DELAUNAYFLIP_HOST_DEVICE void CutMountain(const ChainView<Real>& chains, std::uint32_t first,
  std::uint32_t size, const std::uint32_t (&base)[2], bool isAbove, std::int64_t slot,
  TriangleId triangle)
{
  const MountainEdges open{ chains.SidesOfEdge, chains.SidesOfDiagonal + 2 * slot, size, base[0],
    base[1], isAbove };
  TriangleRecord* path = chains.Triangles + triangle;
  for (std::uint32_t i = 0; i < size; ++i)
  {
    path[i].InputTriangle = first + i;
    path[i].Flips = OpenEdge;
  }
  EarCutter<Real, MountainEdges> cutter{ chains, path, size, base[0], base[1], OpenEdge,
    isAbove ? 1 : -1, triangle, open };
  cutter.Cut();
  chains.SidesOfEdge[std::size_t(2) * base[1] + (isAbove ? 1 : 0)] = cutter.LastLabel;
}

/// Triangulates all mountains that begin in a range of slots.
template <typename Real>
DELAUNAYFLIP_HOST_DEVICE void CutMountains(
  const ChainView<Real>& chains, std::int64_t begin, std::int64_t end)
{
  // The last gap that begins by `begin`.
  std::int64_t gap = FindEnd(std::int64_t(1), chains.Chains - 1,
                       [&](std::int64_t other) { return chains.FirstSlot(other) <= begin; }) -
    1;
  for (std::int64_t slot = begin; slot < end; ++gap)
  {
    const std::uint32_t lower = chains.Starts[gap], upper = chains.Starts[gap + 1];
    const std::uint32_t last = chains.Starts[gap + 2];
    const std::int64_t firstSlot = chains.FirstSlot(gap);
    const std::int64_t nextGap = firstSlot + (last - lower);
    const std::int64_t endOfMountains = nextGap - chains.Gaps[gap].RightRun;
    slot =
      slot > firstSlot + chains.Gaps[gap].LeftRun ? slot : firstSlot + chains.Gaps[gap].LeftRun;
    // How many of the slots before are of the lower chain: on the merge path.
    const auto before = static_cast<std::uint32_t>(slot - firstSlot);
    const std::uint32_t a = FindEnd(before > last - upper ? before - (last - upper) : 0,
      before < upper - lower ? before : upper - lower,
      [&](std::uint32_t lowerOnes)
      { return chains.IsBefore(lower + lowerOnes, upper + (before - lowerOnes) - 1); });
    std::uint32_t place[2] = { lower + a, upper + (before - a) };
    const std::uint32_t ends[2] = { upper, last };
    const auto chainAt = [&]()
    {
      return place[0] == ends[0] || (place[1] < ends[1] && !chains.IsBefore(place[0], place[1]))
        ? 1
        : 0;
    };
    int previous =
      place[0] == lower || (place[1] > upper && chains.IsBefore(place[0] - 1, place[1] - 1)) ? 1
                                                                                             : 0;
    const std::int64_t stop = end < endOfMountains ? end : endOfMountains;
    while (slot < stop)
    {
      const int chain = chainAt();
      if (chain == previous)
      {
        ++place[chain];
        ++slot;
        continue;
      }
      const std::uint32_t first = place[chain];
      while (chainAt() == chain)
      {
        ++place[chain];
      }
      const std::uint32_t size = place[chain] - first;
      const std::uint32_t base[2] = { place[1 - chain] - 1, place[1 - chain] };
      CutMountain(chains, first, size, base, chain == 1, slot,
        static_cast<TriangleId>(
          chains.Gaps[gap].FirstTriangle + (slot - firstSlot) - chains.Gaps[gap].LeftRun));
      slot += size;
      previous = chain;
    }
    slot = slot < nextGap ? nextGap : slot;
    if (end < nextGap)
    {
      break;
    }
  }
}

}

#endif
