// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PLACEFINDER_H
#define DELAUNAYFLIP_PLACEFINDER_H

#include "HostVector.h"
#include "NearBoxes.h"
#include "PieceFlip.h"
#include "Records.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <numeric>
#include <unordered_set>
#include <utility>
#include <vector>

namespace delaunayflip
{

/// The place of a point: its global number, or the bits of its three coordinates. Points of
/// different ranks can be the same point only if their places are equal.
using Place = std::array<std::uint64_t, 3>;

struct PlaceHash
{
  std::size_t operator()(const Place& place) const
  {
    return ScatterBits(place[0] + ScatterBits(place[1] + ScatterBits(place[2])));
  }
};

/// A set of places that is much smaller than the places, but may claim to have a few others, too (a
/// Bloom filter with one hash function).
class PlaceFilter
{
public:
  /// @param size how many places it will get, about.
  explicit PlaceFilter(std::size_t size)
  {
    constexpr std::size_t CellsPerPlace = 16;
    for (std::size_t words = 1; 64 * this->Words.size() < CellsPerPlace * size; words *= 2)
    {
      this->Words.resize(words);
    }
  }
  /// From the words of another one.
  explicit PlaceFilter(std::vector<std::uint64_t> words)
    : Words(std::move(words))
  {
  }

  const std::vector<std::uint64_t>& GetWords() const { return this->Words; }

  void Add(const Place& place)
  {
    const std::size_t cell = this->GetCell(place);
    this->Words[cell / 64] |= std::uint64_t(1) << cell % 64;
  }
  bool MayHave(const Place& place) const
  {
    const std::size_t cell = this->GetCell(place);
    return !this->Words.empty() && (this->Words[cell / 64] >> cell % 64 & 1) != 0;
  }

private:
  /// The cell of a place, by a quick hash.
  std::size_t GetCell(const Place& place) const
  {
    constexpr std::uint64_t Factor = 0x9e3779b97f4a7c15u;
    const std::uint64_t sum = (place[0] * Factor + place[1]) * Factor + place[2];
    return (sum * Factor >> 32) & (64 * this->Words.size() - 1);
  }

  std::vector<std::uint64_t> Words; ///< One bit per cell; their number is a power of two, or 0.
};

/// A set of places.
class PlaceSet
{
public:
  explicit PlaceSet(const RecordLists<Place>& lists)
    : Filter(CountPlaces(lists))
  {
    this->Places.reserve(CountPlaces(lists));
    for (const std::vector<Place>& list : lists)
    {
      for (const Place& place : list)
      {
        this->Places.insert(place);
        this->Filter.Add(place);
      }
    }
  }

  bool Has(const Place& place) const
  {
    return this->Filter.MayHave(place) && this->Places.count(place) > 0;
  }

private:
  static std::size_t CountPlaces(const RecordLists<Place>& lists)
  {
    return std::accumulate(lists.begin(), lists.end(), std::size_t(0),
      [](std::size_t sum, const std::vector<Place>& list) { return sum + list.size(); });
  }

  std::unordered_set<Place, PlaceHash> Places; ///< Never iterated over: its order varies.
  PlaceFilter Filter;
};

/// The places of the points of one rank, and how its triangles use these points.
class PlaceFinder
{
public:
  explicit PlaceFinder(const MeshPiece& piece)
    : Piece(piece),
      Fans(piece.Mesh.Points.Count, 0),
      Used(piece.Mesh.Points.Count, 0),
      Ends(piece.Mesh.Points.Count, 0)
  {
    for (std::int64_t t = 0; t < piece.Mesh.Triangles.Count; ++t)
    {
      this->NoteTriangle(t);
    }
    for (std::int64_t i = 0; i < 2 * piece.Mesh.NumberOfConstraintEdges; ++i)
    {
      this->Ends[piece.Mesh.ConstraintEdges[i]] = 1;
    }
  }

  /// One flag per point: whether a triangle has it.
  const std::vector<unsigned char>& GetUsed() const { return this->Used; }
  bool IsUsed(std::int64_t point) const { return this->Used[point] != 0; }
  /// Whether the point must be matched with points of other ranks: a triangle has it, or it is the
  /// end of a constraint.
  bool IsWanted(std::int64_t point) const
  {
    return this->Used[point] != 0 || this->Ends[point] != 0;
  }

  /// Whether a point is at the border of the piece: its triangles do not form a closed fan, or it
  /// has none and is the end of a constraint. Also true where triangles are not wound consistently.
  bool IsAtBorder(std::int64_t point) const
  {
    return this->Fans[point] != 0 || (!this->IsUsed(point) && this->IsWanted(point));
  }

  std::int64_t CountUsed() const
  {
    return std::count(this->Used.begin(), this->Used.end(), static_cast<unsigned char>(1));
  }

  /// One flag per point: whether it is used and not at the border.
  std::vector<unsigned char> FindClosed() const
  {
    std::vector<unsigned char> closed(this->Used.size());
    for (std::size_t i = 0; i < closed.size(); ++i)
    {
      closed[i] = this->Used[i] != 0 && this->Fans[i] == 0 ? 1 : 0;
    }
    return closed;
  }

  /// @returns whether the point has a place: a number, or coordinates without NaN.
  bool FindPlace(std::int64_t point, Place& place) const
  {
    if (this->Piece.PointNumbers)
    {
      place = { static_cast<std::uint64_t>(this->Piece.PointNumbers[point]), 0, 0 };
      return true;
    }
    bool isPlace = true;
    for (int axis = 0; axis < 3; ++axis)
    {
      const double x = this->Piece.Mesh.Points.Get(point, axis) + 0.0; // -0 becomes 0
      isPlace = isPlace && !std::isnan(x);
      std::memcpy(&place[axis], &x, sizeof(x));
    }
    return isPlace;
  }

  /// The bounding box of the used points. If there are none, Lower exceeds Upper.
  Box FindBox() const
  {
    constexpr double Inf = std::numeric_limits<double>::infinity();
    Box box{ { Inf, Inf, Inf }, { -Inf, -Inf, -Inf } };
    for (std::int64_t i = 0; i < this->Piece.Mesh.Points.Count; ++i)
    {
      for (int axis = 0; axis < 3 && this->IsUsed(i); ++axis)
      {
        const double x = this->Piece.Mesh.Points.Get(i, axis);
        box.Lower[axis] = std::min(box.Lower[axis], x);
        box.Upper[axis] = std::max(box.Upper[axis], x);
      }
    }
    return box;
  }

  /// Calls visit(rank) for every other rank whose box holds a point: for all of them if a
  /// coordinate is NaN.
  template <typename Visit>
  void ForEachNear(std::int64_t point, const NearBoxes& boxes, const Visit& visit) const
  {
    const PointArray& points = this->Piece.Mesh.Points;
    const double x[3] = { points.Get(point, 0), points.Get(point, 1), points.Get(point, 2) };
    if (std::isnan(x[0]) || std::isnan(x[1]) || std::isnan(x[2]))
    {
      boxes.ForEachOther(visit);
    }
    else
    {
      boxes.ForEachHolding(x, visit);
    }
  }

private:
  void NoteTriangle(std::int64_t t)
  {
    const TriangleArray& triangles = this->Piece.Mesh.Triangles;
    const std::int64_t ids[3] = { triangles.Get(t, 0), triangles.Get(t, 1), triangles.Get(t, 2) };
    const std::uint64_t bits[3] = { ScatterBits(ids[0]), ScatterBits(ids[1]), ScatterBits(ids[2]) };
    for (int slot = 0; slot < 3; ++slot)
    {
      this->Used[ids[slot]] = 1;
      // In a closed fan every neighbour follows this corner once and precedes it once: the sum is
      // 0.
      this->Fans[ids[slot]] += bits[(slot + 1) % 3] - bits[(slot + 2) % 3];
    }
  }

  const MeshPiece& Piece;
  HostVector<std::uint64_t> Fans;
  std::vector<unsigned char> Used;
  std::vector<unsigned char> Ends; ///< Of constraints.
};

}

#endif
