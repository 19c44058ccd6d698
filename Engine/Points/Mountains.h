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

/// Where a gap's triangles are.
struct Gap
{
  std::uint32_t LeftRun, RightRun; ///< Slots of the runs at its ends.
  bool LeftIsLower, RightIsLower; ///< Whether these runs are of the lower chain.
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
  const std::uint32_t* Starts; ///< Of every chain its first place, and the number of places.
  std::int64_t Chains;
  std::uint32_t Count; ///< Of all places.
  const Gap* Gaps; ///< Of every chain but the last one.
  TriangleRecord* Triangles;
  TriangleId FirstTriangle; ///< The number of Triangles[0].
  CornerPair*
    Sides; ///< Of every edge of a chain (below, above) and diagonal (left, right); or null.
  std::int32_t* Failed; ///< Set to 1 if a device cannot decide a turn.

  DELAUNAYFLIP_HOST_DEVICE PlanePoint GetPoint(VertexId place) const
  {
    const CoordinatePair<Real> point = this->Places[place];
    return { point.U, point.V, 0.0 };
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
        this->GetTriangle(TriangleOf(label)).HalfEdges[SlotOf(label)] = corner;
      }
    }
    else if (this->Sides && label != NoCorner)
    {
      // Edges of chains lead to the right where their places ascend, diagonals up.
      const bool isDiagonal = label >> 2 >= this->Count;
      const bool isSecond = ((from < to) == isDiagonal) == onRight;
      (isSecond ? this->Sides[label >> 2].B : this->Sides[label >> 2].A) = corner;
    }
  }

  /// Does so for all edges of a triangle, whose HalfEdges are their labels.
  DELAUNAYFLIP_HOST_DEVICE void AttachTriangle(TriangleId number) const
  {
    const TriangleRecord triangle = this->GetTriangle(number);
    for (int slot = 0; slot < 3; ++slot)
    {
      this->Attach(triangle.HalfEdges[slot], triangle.Vertices[NextSlot(slot)],
        triangle.Vertices[PreviousSlot(slot)], false, MakeCorner(number, slot));
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
  // The first of the lower chain that does not come before a place of the upper one, and the
  // reverse.
  const auto endOfLower = [&](std::uint32_t place)
  { return FindEnd(lower, upper, [&](auto other) { return chains.IsBefore(other, place); }); };
  const auto endOfUpper = [&](std::uint32_t place)
  { return FindEnd(upper, end, [&](auto other) { return !chains.IsBefore(place, other); }); };
  const std::uint32_t fromUpper = endOfUpper(lower) - upper;
  const std::uint32_t lowerAtEnd = upper - endOfLower(end - 1);
  return { fromUpper > 0 ? fromUpper : endOfLower(upper) - lower,
    lowerAtEnd > 0 ? lowerAtEnd : end - endOfUpper(upper - 1), fromUpper == 0, lowerAtEnd > 0, 0 };
}

/// A vertex of a path, and the label of the edge before it.
struct LabelledVertex
{
  VertexId Vertex;
  CornerId Label;
};

/// The vertices of a path between its two ends, and the labels of the edges before them.
struct EarPath
{
  VertexId* Vertices;
  CornerId* Labels;
  std::uint32_t Stride; ///< 1, 2 in a LabelledVertex, or that of triangles that are made later.
};

/// A path of vertices from left to right of which ears are cut until only what is convex, or in a
/// mountain its base, is left.
template <typename Real>
struct EarCutter
{
  const ChainView<Real>& Chains;
  EarPath Path;
  std::uint32_t Size; ///< Of the path without its ends.
  VertexId Left, Right;
  CornerId LastLabel; ///< Of the edge before Right.
  bool IsOnRight; ///< Whether the triangles are right of the path (a run above its base).
  CornerId Base; ///< The label of a mountain's base, NoCorner for other paths.
  TriangleId Next; ///< The number of the next triangle.

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
  DELAUNAYFLIP_HOST_DEVICE VertexId GetVertex(std::uint32_t i) const
  {
    return this->Path.Vertices[std::size_t(i) * this->Path.Stride];
  }
  DELAUNAYFLIP_HOST_DEVICE CornerId GetLabel(std::uint32_t i) const
  {
    return this->Path.Labels[std::size_t(i) * this->Path.Stride];
  }
  DELAUNAYFLIP_HOST_DEVICE void Set(std::uint32_t i, VertexId vertex, CornerId label) const
  {
    this->Path.Vertices[std::size_t(i) * this->Path.Stride] = vertex;
    this->Path.Labels[std::size_t(i) * this->Path.Stride] = label;
  }

  DELAUNAYFLIP_HOST_DEVICE bool IsEar(VertexId a, VertexId b, VertexId c) const
  {
    return this->Chains.Turn(a, b, c) == (this->IsOnRight ? -1 : 1);
  }

  /// Makes a triangle of two consecutive edges. @returns the label of the edge that replaces them.
  DELAUNAYFLIP_HOST_DEVICE CornerId Emit(
    VertexId a, VertexId b, VertexId c, CornerId first, CornerId second)
  {
    const bool swaps = this->IsOnRight;
    const TriangleId number = this->Next++;
    TriangleRecord& made = this->Chains.GetTriangle(number);
    const bool isWhole = this->Path.Stride <= 2; // else the rest of it may be part of the path
    made = { { a, swaps ? c : b, swaps ? b : c }, isWhole ? number : made.InputTriangle,
      { second, swaps ? first : this->Base, swaps ? this->Base : first },
      isWhole ? 0 : made.Flips };
    this->Chains.Attach(first, a, b, swaps, MakeCorner(number, swaps ? 1 : 2));
    this->Chains.Attach(second, b, c, swaps, MakeCorner(number, 0));
    return MakeCorner(number, swaps ? 2 : 1);
  }

  DELAUNAYFLIP_HOST_DEVICE void CutRound()
  {
    const bool isSure = this->Size == 1 && this->Base != NoCorner;
    std::uint32_t kept = 0;
    VertexId previous = this->Left;
    for (std::uint32_t i = 0; i < this->Size;)
    {
      const VertexId here = this->GetVertex(i);
      const CornerId label = this->GetLabel(i);
      const bool isLast = i + 1 == this->Size;
      const VertexId next = isLast ? this->Right : this->GetVertex(i + 1);
      if (!isSure && !this->IsEar(previous, here, next))
      {
        this->Set(kept++, here, label);
        previous = here;
        ++i;
        continue;
      }
      const CornerId nextLabel = isLast ? this->LastLabel : this->GetLabel(i + 1);
      const CornerId made = this->Emit(previous, here, next, label, nextLabel);
      if (isLast)
      {
        this->LastLabel = made;
      }
      else
      {
        this->Set(kept++, next, made);
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
      const VertexId next = isLast ? this->Right : this->GetVertex(i);
      CornerId label = isLast ? this->LastLabel : this->GetLabel(i);
      while (top > 0)
      {
        const VertexId before = top > 1 ? this->GetVertex(top - 2) : this->Left;
        const VertexId here = this->GetVertex(top - 1);
        if (!this->IsEar(before, here, next))
        {
          break;
        }
        label = this->Emit(before, here, next, this->GetLabel(top - 1), label);
        --top;
      }
      if (isLast)
      {
        this->LastLabel = label;
        break;
      }
      this->Set(top++, next, label);
    }
    this->Size = top;
  }
};

/// Triangulates the mountain of `size` places from `first` on.
/// @param base the places of the other chain before and after them.
template <typename Real>
DELAUNAYFLIP_HOST_DEVICE void CutMountain(const ChainView<Real>& chains, std::uint32_t first,
  std::uint32_t size, const std::uint32_t (&base)[2], bool isAbove, std::int64_t slot,
  TriangleId triangle)
{
  // The records of the triangles hold long paths. A device would write these to memory often.
  constexpr std::uint32_t LongestOwn = 8;
  std::uint32_t own[2][LongestOwn];
  TriangleRecord& record = chains.Triangles[triangle];
  const bool isLong = size > LongestOwn;
  const EarPath path{ isLong ? &record.InputTriangle : own[0], isLong ? &record.Flips : own[1],
    isLong ? static_cast<std::uint32_t>(sizeof(record) / sizeof(VertexId)) : 1 };
  for (std::uint32_t i = 0; i < size; ++i)
  {
    path.Vertices[i * path.Stride] = first + i;
    path.Labels[i * path.Stride] =
      i > 0 ? LabelChainEdge(first + i) : LabelDiagonal(chains.Count, slot);
  }
  const CornerId baseLabel = LabelChainEdge(base[1]);
  EarCutter<Real> cutter{ chains, path, size, base[0], base[1],
    LabelDiagonal(chains.Count, slot + size), isAbove, baseLabel, triangle };
  cutter.Cut();
  chains.Attach(baseLabel, base[0], base[1], !isAbove, cutter.LastLabel);
}

/// A stretch of a chain on the outer boundary, of at least two places.
struct BoundaryPiece
{
  std::uint32_t First, Size; ///< Places.
  bool IsAbove; ///< Whether what is outside lies below it.
  std::uint32_t Begin; ///< How many inner places the pieces before have.
  std::uint32_t Made; ///< Triangles.
  CornerId LastLabel;
};

/// Cuts ears off a piece alone.
/// @param chains its triangles are of no mesh yet. The first of the piece's is number Begin.
/// @param path what is left of the piece, from Begin on.
template <typename Real>
DELAUNAYFLIP_HOST_DEVICE void CutPiece(
  const ChainView<Real>& chains, BoundaryPiece& piece, LabelledVertex* path)
{
  const std::uint32_t size = piece.Size - 2, last = piece.First + piece.Size - 1;
  LabelledVertex* own = path + piece.Begin;
  for (std::uint32_t i = 0; i < size; ++i)
  {
    own[i] = { piece.First + 1 + i, LabelChainEdge(piece.First + 1 + i) };
  }
  EarCutter<Real> cutter{ chains, { &own->Vertex, &own->Label, 2 }, size, piece.First, last,
    LabelChainEdge(last), piece.IsAbove, NoCorner, piece.Begin };
  cutter.Cut();
  piece.Made = cutter.Next - piece.Begin;
  piece.LastLabel = cutter.LastLabel;
}

/// Makes the triangles of a piece part of the mesh.
/// @param made the first of them, as made by CutPiece; path as there.
/// @param left what is left of the piece. Its last vertex comes last, the first one not at all.
template <typename Real>
DELAUNAYFLIP_HOST_DEVICE void MovePiece(const ChainView<Real>& chains, const BoundaryPiece& piece,
  const LabelledVertex* path, const TriangleRecord* made, TriangleId first, LabelledVertex* left)
{
  const auto renumber = [&](CornerId label)
  { return IsOpen(label) ? label : label + 4 * (first - piece.Begin); };
  for (std::uint32_t i = 0; i < piece.Made; ++i)
  {
    TriangleRecord triangle = made[i];
    for (CornerId& label : triangle.HalfEdges)
    {
      label = renumber(label);
    }
    chains.Triangles[first + i] = triangle;
    chains.AttachTriangle(first + i);
  }
  const std::uint32_t size = piece.Size - 2 - piece.Made;
  for (std::uint32_t i = 0; i < size; ++i)
  {
    const LabelledVertex& vertex = path[piece.Begin + i];
    left[i] = { vertex.Vertex, renumber(vertex.Label) };
  }
  left[size] = { piece.First + piece.Size - 1, renumber(piece.LastLabel) };
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
