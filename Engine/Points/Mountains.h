// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_MOUNTAINS_H
#define DELAUNAYFLIP_MOUNTAINS_H

#include "Atomics.h"
#include "EdgeMesh.h"
#include "ExactPredicates.h"
#include "HostDevice.h"
#include "Strips.h"

#include <algorithm>
#include <cstdint>

/// @file
/// The second part of a triangulation of points: the gaps between neighbouring chains.
///
/// The points of two neighbouring chains, merged by (x, y), are the slots of their gap. Wherever
/// two consecutive slots are of different chains, the segment between their points crosses nothing:
/// this is a diagonal. The diagonals cut the gap into mountains, which the literature calls
/// unimonotone polygons: a mountain is a run of slots of one chain and, as its base, the edge of
/// the other chain that spans it. (Fournier and Montuno, ACM Transactions on Graphics 3, 1984;
/// Chazelle and Incerpi, the same volume.) A run of k points is triangulated by k triangles, by
/// cutting ears. The runs at the two ends of a gap have no base. Hull.h fills what lies beyond the
/// outermost diagonals.

namespace delaunayflip
{

/// Where a gap's triangles are.
struct Gap
{
  std::uint32_t LeftRun, RightRun; ///< Slots of the runs at its ends.
  /// Whether these runs are of the lower chain. Words, so that copies have no undefined bytes.
  std::uint32_t LeftIsLower, RightIsLower;
  std::int64_t FirstTriangle;
};

/// The label of an edge of a path is the corner of the triangle that has been cut off there. Where
/// there is none yet, it names the edge, by a corner that no triangle has: edge i of a chain ends
/// at place i, and diagonal i, between slots i - 1 and i, counts on from the number of places.
DELAUNAYFLIP_HOST_DEVICE inline bool IsOpen(CornerId label) { return SlotOf(label) == 3; }
DELAUNAYFLIP_HOST_DEVICE inline CornerId LabelChainEdge(std::uint32_t place)
{
  return 4 * place + 3;
}
DELAUNAYFLIP_HOST_DEVICE inline CornerId LabelDiagonal(std::uint32_t places, std::int64_t slot)
{
  return 4 * (places + static_cast<std::uint32_t>(slot)) + 3;
}

/// What the functions of this file read and write, in the memory of a backend.
template <typename Real>
struct ChainView
{
  const CoordinatePair<Real>* Places;
  const std::uint32_t* Starts; ///< By chain: its first place. The number of places comes last.
  std::int64_t Chains;
  std::uint32_t Count; ///< How many places there are.
  const Gap* Gaps; ///< By chain: the gap above it. The last chain has none.
  TriangleRecord* Triangles;
  TriangleId FirstTriangle; ///< The number of Triangles[0].
  /// The corners on both sides of every edge of a chain (below, above) and of every diagonal (left,
  /// right); or null.
  CornerPair* Sides;
  std::int32_t* Failed; ///< Set to 1 if a device cannot decide an orientation.

  DELAUNAYFLIP_HOST_DEVICE PlanePoint GetPoint(VertexId place) const
  {
    const CoordinatePair<Real> point = this->Places[place];
    return { point.U, point.V, 0.0 };
  }

  DELAUNAYFLIP_HOST_DEVICE int Orient(VertexId a, VertexId b, VertexId c) const
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

  DELAUNAYFLIP_HOST_DEVICE TriangleRecord& GetTriangle(TriangleId number) const
  {
    return this->Triangles[number - this->FirstTriangle];
  }

  /// Sets the corner of the triangle on one side of an edge, which leads from `from` to `to`.
  DELAUNAYFLIP_HOST_DEVICE void Attach(
    CornerId label, VertexId from, VertexId to, bool onRight, CornerId corner) const
  {
    if (!IsOpen(label))
    {
      if (TriangleOf(label) >= this->FirstTriangle)
      {
        AtomicStore(&this->GetTriangle(TriangleOf(label)).HalfEdges[SlotOf(label)], corner);
      }
    }
    else if (this->Sides && label != NoCorner)
    {
      // Edges of chains lead to the right where their places ascend, diagonals up.
      const bool isDiagonal = label >> 2 >= this->Count;
      const bool isSecond = ((from < to) == isDiagonal) == onRight;
      CornerPair& sides = this->Sides[label >> 2];
      CornerId& side = isSecond ? sides.B : sides.A;
      side = corner;
    }
  }

  /// Does so for all edges of a triangle. Its HalfEdges are the labels of its edges. A neighbour
  /// may be attached at the same time: then a label is read before or after that, with the same
  /// result.
  DELAUNAYFLIP_HOST_DEVICE void AttachTriangle(TriangleId number) const
  {
    const TriangleRecord& triangle = this->GetTriangle(number);
    for (int slot = 0; slot < 3; ++slot)
    {
      const CornerId label = AtomicLoad(&triangle.HalfEdges[slot]);
      this->Attach(label, triangle.Vertices[NextSlot(slot)], triangle.Vertices[PreviousSlot(slot)],
        false, MakeCorner(number, slot));
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
  // How many places of one chain come before a place of the other one.
  const auto countLower = [&](std::uint32_t place)
  {
    return FindEnd(lower, upper, [&](auto other) { return chains.IsBefore(other, place); }) - lower;
  };
  const auto countUpper = [&](std::uint32_t place) {
    return FindEnd(upper, end, [&](auto other) { return !chains.IsBefore(place, other); }) - upper;
  };
  // The first slots are of one chain, and so are the last ones: one of two counts is 0.
  const std::uint32_t lowerAtBegin = countLower(upper);
  const std::uint32_t upperAtBegin = countUpper(lower);
  const std::uint32_t lowerAtEnd = (upper - lower) - countLower(end - 1);
  const std::uint32_t upperAtEnd = (end - upper) - countUpper(upper - 1);
  return { lowerAtBegin + upperAtBegin, lowerAtEnd + upperAtEnd, lowerAtBegin > 0, lowerAtEnd > 0,
    0 };
}

/// A vertex of a path, and the label of the edge before it.
struct LabelledVertex
{
  VertexId Vertex;
  CornerId Label;
};

/// The list from which an EarCutter works: the inner vertices of a path with their labels.
struct PathList
{
  VertexId* Vertices;
  CornerId* Labels;
  std::uint32_t Stride; ///< From one vertex, or label, to the next.

  /// A list in memory of its own.
  DELAUNAYFLIP_HOST_DEVICE explicit PathList(LabelledVertex* memory)
    : Vertices(&memory->Vertex),
      Labels(&memory->Label),
      Stride(sizeof(LabelledVertex) / sizeof(VertexId))
  {
  }
  /// A list in two members of the triangles that are made from it. A vertex of the list makes one
  /// triangle, so there is room. Both members get their values later (NumberJoinedEdges).
  DELAUNAYFLIP_HOST_DEVICE explicit PathList(TriangleRecord* triangles)
    : Vertices(&triangles->InputTriangle),
      Labels(&triangles->Flips),
      Stride(TriangleStride)
  {
  }

  DELAUNAYFLIP_HOST_DEVICE bool IsInTriangles() const { return this->Stride == TriangleStride; }
  DELAUNAYFLIP_HOST_DEVICE VertexId GetVertex(std::uint32_t i) const
  {
    return this->Vertices[std::size_t(i) * this->Stride];
  }
  DELAUNAYFLIP_HOST_DEVICE CornerId GetLabel(std::uint32_t i) const
  {
    return this->Labels[std::size_t(i) * this->Stride];
  }
  DELAUNAYFLIP_HOST_DEVICE void Set(std::uint32_t i, VertexId vertex, CornerId label) const
  {
    this->Vertices[std::size_t(i) * this->Stride] = vertex;
    this->Labels[std::size_t(i) * this->Stride] = label;
  }

private:
  static constexpr std::uint32_t TriangleStride = sizeof(TriangleRecord) / sizeof(VertexId);
};

/// A path of vertices from left to right. Ears are cut from it until it is convex. The path of a
/// mountain is cut until only the base is left.
template <typename Real>
struct EarCutter
{
  const ChainView<Real>& Chains;
  PathList List;
  std::uint32_t Size; ///< How many vertices are in the list, which is the path without its ends.
  VertexId Left, Right;
  CornerId LastLabel; ///< The label of the edge before Right.
  bool IsOnRight; ///< Whether the triangles are right of the path (a run above its base).
  CornerId Base; ///< The label of a mountain's base, NoCorner for other paths.
  TriangleId Next; ///< The number of the next triangle.

  /// Cuts every second ear in a round, so that the triangles are balanced like a tournament. A
  /// stack alone would make fans, the worst start for flips along a convex curve. When a round cuts
  /// less than a quarter of the path, a stack does the rest, so that the time is linear.
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
  /// The vertex of the list at `i`, or Right after its last one.
  DELAUNAYFLIP_HOST_DEVICE VertexId GetVertexOrRight(std::uint32_t i) const
  {
    return i == this->Size ? this->Right : this->List.GetVertex(i);
  }
  /// The label of the edge before this vertex.
  DELAUNAYFLIP_HOST_DEVICE CornerId GetLabelOrLast(std::uint32_t i) const
  {
    return i == this->Size ? this->LastLabel : this->List.GetLabel(i);
  }
  /// The vertex of the list before `i`, or Left before its first one.
  DELAUNAYFLIP_HOST_DEVICE VertexId GetVertexBefore(std::uint32_t i) const
  {
    return i == 0 ? this->Left : this->List.GetVertex(i - 1);
  }

  DELAUNAYFLIP_HOST_DEVICE bool IsEar(VertexId a, VertexId b, VertexId c) const
  {
    const int earOrientation = this->IsOnRight ? -1 : 1;
    return this->Chains.Orient(a, b, c) == earOrientation;
  }

  /// Makes a triangle of two consecutive edges. @returns the label of the edge that replaces them.
  DELAUNAYFLIP_HOST_DEVICE CornerId Emit(
    VertexId a, VertexId b, VertexId c, CornerId first, CornerId second)
  {
    const TriangleId number = this->Next++;
    TriangleRecord made{ { a, b, c }, number, { second, this->Base, first }, 0 };
    int slotOfB = 1, slotOfC = 2;
    if (this->IsOnRight) // a, c, b is counter-clockwise
    {
      made = { { a, c, b }, number, { second, first, this->Base }, 0 };
      slotOfB = 2;
      slotOfC = 1;
    }
    TriangleRecord& record = this->Chains.GetTriangle(number);
    if (this->List.IsInTriangles())
    {
      made.InputTriangle = record.InputTriangle;
      made.Flips = record.Flips;
    }
    record = made;
    this->Chains.Attach(first, a, b, this->IsOnRight, MakeCorner(number, slotOfC));
    this->Chains.Attach(second, b, c, this->IsOnRight, MakeCorner(number, 0));
    return MakeCorner(number, slotOfB);
  }

  DELAUNAYFLIP_HOST_DEVICE void CutRound()
  {
    const bool isSure = this->Size == 1 && this->Base != NoCorner;
    std::uint32_t kept = 0;
    VertexId previous = this->Left;
    for (std::uint32_t i = 0; i < this->Size;)
    {
      const VertexId here = this->List.GetVertex(i);
      const CornerId label = this->List.GetLabel(i);
      const VertexId next = this->GetVertexOrRight(i + 1);
      if (!isSure && !this->IsEar(previous, here, next))
      {
        this->List.Set(kept++, here, label);
        previous = here;
        ++i;
        continue;
      }
      const CornerId made = this->Emit(previous, here, next, label, this->GetLabelOrLast(i + 1));
      if (i + 1 == this->Size)
      {
        this->LastLabel = made;
      }
      else
      {
        this->List.Set(kept++, next, made);
        previous = next;
      }
      i += 2;
    }
    this->Size = kept;
  }

  /// The stack is the beginning of the list.
  DELAUNAYFLIP_HOST_DEVICE void CutByStack()
  {
    std::uint32_t top = 0;
    for (std::uint32_t i = 0; i <= this->Size; ++i)
    {
      const VertexId next = this->GetVertexOrRight(i);
      CornerId label = this->GetLabelOrLast(i);
      while (top > 0)
      {
        const VertexId before = this->GetVertexBefore(top - 1);
        const VertexId here = this->List.GetVertex(top - 1);
        if (!this->IsEar(before, here, next))
        {
          break;
        }
        label = this->Emit(before, here, next, this->List.GetLabel(top - 1), label);
        --top;
      }
      if (i == this->Size)
      {
        this->LastLabel = label;
        break;
      }
      this->List.Set(top++, next, label);
    }
    this->Size = top;
  }
};

/// A run of slots over its base.
struct Mountain
{
  std::uint32_t First, Size; ///< The places of the run.
  std::uint32_t Base[2]; ///< The places of the other chain before and after them.
  bool IsAbove; ///< Whether the run is above its base.
  std::int64_t Slot; ///< The slot of its first place.
};

/// Triangulates a mountain.
/// @param triangle the number of its first triangle.
template <typename Real>
DELAUNAYFLIP_HOST_DEVICE void CutMountain(
  const ChainView<Real>& chains, const Mountain& mountain, TriangleId triangle)
{
  // A short list fits into registers and caches. Only long ones are in the triangles, because a
  // device would write these to memory often.
  constexpr std::uint32_t LongestOwn = 8;
  LabelledVertex own[LongestOwn];
  PathList list(own);
  if (mountain.Size > LongestOwn)
  {
    list = PathList(&chains.Triangles[triangle]);
  }
  list.Set(0, mountain.First, LabelDiagonal(chains.Count, mountain.Slot));
  for (std::uint32_t i = 1; i < mountain.Size; ++i)
  {
    list.Set(i, mountain.First + i, LabelChainEdge(mountain.First + i));
  }
  const CornerId baseLabel = LabelChainEdge(mountain.Base[1]);
  EarCutter<Real> cutter{ chains, list, mountain.Size, mountain.Base[0], mountain.Base[1],
    LabelDiagonal(chains.Count, mountain.Slot + mountain.Size), mountain.IsAbove, baseLabel,
    triangle };
  cutter.Cut();
  chains.Attach(baseLabel, mountain.Base[0], mountain.Base[1], !mountain.IsAbove, cutter.LastLabel);
}

/// A stretch of a chain on the outer boundary, of at least two places.
struct BoundaryStretch
{
  std::uint32_t First, Size; ///< Places.
  bool IsAbove; ///< Whether the outside is below it.
  std::uint32_t Begin; ///< How many inner places the stretches before it have.
  std::uint32_t Made; ///< How many triangles it has.
  CornerId LastLabel;
};

/// Cuts ears off a stretch alone.
/// @param chains has triangles that are of no mesh yet. The first one of the stretch is number
/// Begin.
/// @param path receives what is left of the stretch, from Begin on.
template <typename Real>
DELAUNAYFLIP_HOST_DEVICE void CutStretch(
  const ChainView<Real>& chains, BoundaryStretch& stretch, LabelledVertex* path)
{
  const std::uint32_t size = stretch.Size - 2, last = stretch.First + stretch.Size - 1;
  const PathList list(path + stretch.Begin);
  for (std::uint32_t i = 0; i < size; ++i)
  {
    const std::uint32_t place = stretch.First + 1 + i;
    list.Set(i, place, LabelChainEdge(place));
  }
  EarCutter<Real> cutter{ chains, list, size, stretch.First, last, LabelChainEdge(last),
    stretch.IsAbove, NoCorner, stretch.Begin };
  cutter.Cut();
  stretch.Made = cutter.Next - stretch.Begin;
  stretch.LastLabel = cutter.LastLabel;
}

/// Makes the triangles of a stretch part of the mesh.
/// @param made the first of them, as made by CutStretch; path as there.
/// @param left receives what is left of the stretch. Its last vertex comes last. Its first one is
/// left out.
template <typename Real>
DELAUNAYFLIP_HOST_DEVICE void MoveStretch(const ChainView<Real>& chains,
  const BoundaryStretch& stretch, const LabelledVertex* path, const TriangleRecord* made,
  TriangleId first, LabelledVertex* left)
{
  const auto renumber = [&](CornerId label)
  { return IsOpen(label) ? label : label + 4 * (first - stretch.Begin); };
  for (std::uint32_t i = 0; i < stretch.Made; ++i)
  {
    TriangleRecord triangle = made[i];
    for (CornerId& label : triangle.HalfEdges)
    {
      label = renumber(label);
    }
    chains.Triangles[first + i] = triangle;
    chains.AttachTriangle(first + i);
  }
  const std::uint32_t size = stretch.Size - 2 - stretch.Made;
  for (std::uint32_t i = 0; i < size; ++i)
  {
    const LabelledVertex& vertex = path[stretch.Begin + i];
    left[i] = { vertex.Vertex, renumber(vertex.Label) };
  }
  left[size] = { stretch.First + stretch.Size - 1, renumber(stretch.LastLabel) };
}

/// Goes through the slots of a gap, which is a merge of its two chains.
template <typename Real>
struct SlotCursor
{
  const ChainView<Real>& Chains;
  std::uint32_t Begins[2], Ends[2]; ///< The places of the lower and the upper chain.
  std::uint32_t Places[2]; ///< The next place of either chain.

  /// Starts at a slot, which is found by a binary search on the merge path.
  /// @param before how many slots of the gap are before it.
  DELAUNAYFLIP_HOST_DEVICE SlotCursor(
    const ChainView<Real>& chains, std::int64_t gap, std::uint32_t before)
    : Chains(chains),
      Begins{ chains.Starts[gap], chains.Starts[gap + 1] },
      Ends{ chains.Starts[gap + 1], chains.Starts[gap + 2] }
  {
    const std::uint32_t lowerSize = this->Ends[0] - this->Begins[0];
    const std::uint32_t upperSize = this->Ends[1] - this->Begins[1];
    const std::uint32_t lowerBefore = FindEnd(before - std::min(before, upperSize),
      std::min(before, lowerSize),
      [&](std::uint32_t count)
      { return chains.IsBefore(this->Begins[0] + count, this->Begins[1] + (before - count) - 1); });
    this->Places[0] = this->Begins[0] + lowerBefore;
    this->Places[1] = this->Begins[1] + (before - lowerBefore);
  }

  /// The chain of the slot: 0 is the lower one, 1 the upper one.
  DELAUNAYFLIP_HOST_DEVICE int GetChain() const
  {
    if (this->Places[0] == this->Ends[0])
    {
      return 1;
    }
    const bool isUpper =
      this->Places[1] < this->Ends[1] && !this->Chains.IsBefore(this->Places[0], this->Places[1]);
    return isUpper ? 1 : 0;
  }

  /// The chain of the slot before.
  DELAUNAYFLIP_HOST_DEVICE int GetChainBefore() const
  {
    if (this->Places[0] == this->Begins[0])
    {
      return 1;
    }
    const bool isUpper = this->Places[1] > this->Begins[1] &&
      this->Chains.IsBefore(this->Places[0] - 1, this->Places[1] - 1);
    return isUpper ? 1 : 0;
  }

  /// The run of slots of one chain that begins here. The cursor goes to its end.
  /// @param slot the number of the slot.
  DELAUNAYFLIP_HOST_DEVICE Mountain TakeRun(int chain, std::int64_t slot)
  {
    const std::uint32_t first = this->Places[chain];
    while (this->GetChain() == chain)
    {
      ++this->Places[chain];
    }
    const std::uint32_t other = this->Places[1 - chain];
    return { first, this->Places[chain] - first, { other - 1, other }, chain == 1, slot };
  }
};

/// Triangulates the mountains of a gap that begin in a range of slots.
/// @param slot the first slot of the range. No run at an end of the gap is in the range.
template <typename Real>
DELAUNAYFLIP_HOST_DEVICE void CutMountainsOfGap(
  const ChainView<Real>& chains, std::int64_t gap, std::int64_t slot, std::int64_t end)
{
  const std::int64_t firstSlot = chains.FirstSlot(gap);
  const std::int64_t firstMountain = firstSlot + chains.Gaps[gap].LeftRun;
  SlotCursor<Real> cursor(chains, gap, static_cast<std::uint32_t>(slot - firstSlot));
  int previous = cursor.GetChainBefore();
  while (slot < end)
  {
    const int chain = cursor.GetChain();
    if (chain == previous) // it began before the range
    {
      ++cursor.Places[chain];
      ++slot;
      continue;
    }
    const Mountain mountain = cursor.TakeRun(chain, slot);
    CutMountain(chains, mountain,
      static_cast<TriangleId>(chains.Gaps[gap].FirstTriangle + (slot - firstMountain)));
    slot += mountain.Size;
    previous = chain;
  }
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
    const std::int64_t nextGap = chains.FirstSlot(gap + 1);
    const std::int64_t firstMountain = chains.FirstSlot(gap) + chains.Gaps[gap].LeftRun;
    const std::int64_t endOfMountains = nextGap - chains.Gaps[gap].RightRun;
    CutMountainsOfGap(chains, gap, std::max(slot, firstMountain), std::min(end, endOfMountains));
    slot = nextGap;
  }
}

}

#endif
