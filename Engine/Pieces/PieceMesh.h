// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PIECEMESH_H
#define DELAUNAYFLIP_PIECEMESH_H

#include "PieceFlip.h"
#include "PointMatch.h"
#include "Records.h"

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

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
  FixedMark = 1, ///< It stays for ever.
  SeamMark = 8 ///< It may flip, and its other triangle is on another rank.
};

/// A triangle with its marks: bit `slot` of a mark, shifted, is for the edge opposite that corner.
struct PieceTriangle
{
  std::int32_t Points[3]; ///< Ids of this rank.
  std::int32_t Flips;
  std::int64_t Origin; ///< The number of its slot among those of all ranks.
  unsigned char Marks;

  bool Has(EdgeMark mark, int slot) const { return (this->Marks & (mark << slot)) != 0; }
  void Set(EdgeMark mark, int slot) { this->Marks |= static_cast<unsigned char>(mark << slot); }
  void Clear(EdgeMark mark, int slot)
  {
    this->Marks &= static_cast<unsigned char>(~(mark << slot));
  }
  bool HasSeam() const { return this->Marks >= SeamMark; }

  /// The ends of the edge opposite to a corner, in the direction in which the triangle runs.
  std::int32_t GetStart(int slot) const { return this->Points[(slot + 1) % 3]; }
  std::int32_t GetEnd(int slot) const { return this->Points[(slot + 2) % 3]; }
  PointPair GetEdge(int slot) const { return MakePair(this->GetStart(slot), this->GetEnd(slot)); }
};

/// A triangle on its way to another rank.
struct TravellingTriangle
{
  std::int64_t Keys[3];
  double Coordinates[3][3];
  std::int64_t Origin;
  std::int32_t Flips;
  unsigned char Marks;
};

/// The triangles that a rank has at the moment, and all points that it has ever had.
class PieceMesh
{
public:
  /// Has the triangles of the caller.
  /// @param firstOrigin the number of the first of them among those of all ranks.
  PieceMesh(const MeshPiece& piece, PointKeys keys, int rank, std::int64_t firstOrigin);

  std::vector<PieceTriangle> Triangles;
  std::vector<unsigned char> Shared; ///< One flag per point: other ranks may have triangles at it.

  std::int64_t GetNumberOfPoints() const { return static_cast<std::int64_t>(this->Keys.size()); }
  std::int64_t GetKey(std::int64_t point) const { return this->Keys[point]; }
  /// The id of a key here, or -1.
  std::int64_t FindPoint(std::int64_t key) const;
  void GetPosition(std::int64_t point, double (&x)[3]) const;
  PointPair GetKeys(const PointPair& pair) const
  {
    return MakePair(this->Keys[pair[0]], this->Keys[pair[1]]);
  }

  TravellingTriangle Pack(const PieceTriangle& triangle) const;
  PieceTriangle Unpack(const TravellingTriangle& triangle);

  /// Points that were not among the caller's, from this id on.
  std::int64_t GetFirstReceived() const { return this->Given.Count; }
  /// Which rank has given a point.
  PieceOrigin FindOrigin(std::int64_t point) const
  {
    return this->Numbers.FindOrigin(this->Keys[point]);
  }

private:
  std::int32_t FindOrAddPoint(std::int64_t key, const double (&x)[3]);

  PointArray Given;
  std::vector<double> Received; ///< Coordinates of the points behind those.
  PointKeys Numbers; ///< Without what has one value per point.
  std::vector<std::int64_t> Keys;
  std::int64_t FirstOwnKey;
  std::unordered_map<std::int64_t, std::int32_t> OtherKeys; ///< Never iterated over.
};

}

#endif
