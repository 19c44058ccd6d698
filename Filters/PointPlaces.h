// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef PointPlaces_h
#define PointPlaces_h

#include "TriangleMesh.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <unordered_map>

namespace delaunayflip
{

/// Numbers the distinct places of points. Coordinates are compared bit by bit, except that -0
/// equals 0.
class PointPlaces
{
public:
  static constexpr std::int64_t None = -1;

  /// @param asFloats whether coordinates are rounded to float before they are compared.
  explicit PointPlaces(bool asFloats)
    : AsFloats(asFloats)
  {
  }

  /// The number of a point's place: 0, 1, ... in the order of first calls. A point with a
  /// coordinate that is NaN or infinite gets a place that Find never returns.
  std::int64_t Add(const PointArray& points, std::int64_t point);

  /// The number of a point's place, or None if no point was added there. Thread-safe.
  std::int64_t Find(const PointArray& points, std::int64_t point) const;

  std::int64_t GetNumberOfPlaces() const { return this->NumberOfPlaces; }

private:
  using Bits = std::array<std::uint64_t, 3>;
  struct Hash
  {
    std::size_t operator()(const Bits& bits) const;
  };

  /// @returns whether all coordinates are finite.
  bool Read(const PointArray& points, std::int64_t point, Bits& bits) const;

  bool AsFloats;
  std::int64_t NumberOfPlaces = 0;
  std::unordered_map<Bits, std::int64_t, Hash> Numbers; ///< Never iterated over: its order varies.
};

}

#endif
