// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PIECETRIANGLE_H
#define DELAUNAYFLIP_PIECETRIANGLE_H

#include "HostVector.h"
#include "Records.h"

#include <array>
#include <cstdint>
#include <unordered_map>

namespace delaunayflip
{

/// Two points, the smaller first: keys or ids.
using PointPair = std::array<std::int64_t, 2>;

inline PointPair MakePair(std::int64_t a, std::int64_t b)
{
  return a < b ? PointPair{ a, b } : PointPair{ b, a };
}

struct PairHash
{
  std::size_t operator()(const PointPair& pair) const
  {
    return ScatterBits(pair[0] + ScatterBits(pair[1]));
  }
};

/// Never iterated over: its order varies.
template <typename Value>
using PairMap = std::unordered_map<PointPair, Value, PairHash>;

/// What is known about the edge of a triangle opposite to one of its corners.
enum EdgeMark : unsigned char
{
  FixedMark = 1, ///< The edge never flips.
  SeamMark = 8 ///< A seam edge: it may flip, and its other triangle is on another rank.
};

/// The state of a triangle in an iteration of a round (RoundFlips).
enum class TriangleStep : unsigned char
{
  None,
  Listed, ///< Its edges will be judged in this iteration.
  Visited, ///< Its edges have been judged in this iteration.
  Next ///< Its edges will be judged in the next iteration.
};

/// A triangle with its marks. `mark << slot` is the bit for the edge opposite to corner `slot`.
struct PieceTriangle
{
  std::int32_t Points[3]; ///< Ids of this rank.
  std::int32_t Flips;
  std::int64_t Origin; ///< The number of its input slot, counted over all ranks.
  unsigned char Marks;
  bool HasLeft; ///< It is on another rank now, and its place is empty.
  bool IsNoted; ///< In the list of triangles that may have new seam edges.
  TriangleStep Step;

  bool Has(EdgeMark mark, int slot) const { return (this->Marks & (mark << slot)) != 0; }
  void Set(EdgeMark mark, int slot) { this->Marks |= static_cast<unsigned char>(mark << slot); }
  void Clear(EdgeMark mark, int slot)
  {
    this->Marks &= static_cast<unsigned char>(~(mark << slot));
  }
  /// The marks of one edge, shifted to slot 0; SetMarks takes them in the same form.
  unsigned char GetMarks(int slot) const
  {
    return static_cast<unsigned char>((this->Marks >> slot) & (FixedMark | SeamMark));
  }
  void SetMarks(int slot, unsigned char marks)
  {
    this->Clear(FixedMark, slot);
    this->Clear(SeamMark, slot);
    this->Marks |= static_cast<unsigned char>(marks << slot);
  }
  bool HasSeam() const { return this->Marks >= SeamMark; }

  /// The ends of the edge opposite to a corner, in the direction in which the triangle runs.
  std::int32_t GetStart(int slot) const { return this->Points[(slot + 1) % 3]; }
  std::int32_t GetEnd(int slot) const { return this->Points[(slot + 2) % 3]; }
  PointPair GetEdge(int slot) const { return MakePair(this->GetStart(slot), this->GetEnd(slot)); }
  /// Whether the edge opposite to a corner has these ends, in either order.
  bool HasEdge(int slot, std::int32_t a, std::int32_t b) const
  {
    const std::int32_t start = this->GetStart(slot);
    const std::int32_t end = this->GetEnd(slot);
    return (start == a && end == b) || (start == b && end == a);
  }
};

using PieceTriangles = RawVector<PieceTriangle>;

/// A triangle of a rank and one of its corners.
struct PieceCorner
{
  std::int64_t Triangle; ///< -1: there is none.
  int Slot;
};

}

#endif
