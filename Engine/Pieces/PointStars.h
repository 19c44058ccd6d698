// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_POINTSTARS_H
#define DELAUNAYFLIP_POINTSTARS_H

#include "PieceTriangle.h"

#include <cstddef>
#include <cstdint>
#include <utility>

namespace delaunayflip
{

/// The star of every point of a rank: the corners of triangles at the point. The stars are linked
/// lists that are kept up to date, so a round takes no time for triangles that it does not change.
class PointStars
{
public:
  /// Begins with empty lists. More triangles and points may be added later.
  /// @param capacity the number of triangles to reserve memory for.
  void Begin(std::int64_t triangles, std::int64_t capacity, std::int64_t points);
  /// Adds a corner that is in no list.
  void Add(const PieceCorner& corner, std::int32_t point);

  /// Removes a corner from its list.
  void Remove(const PieceCorner& corner, std::int32_t point);

  /// Calls visit(corner) for the corners at a point until visit returns true.
  template <typename Visit>
  void Find(std::int32_t point, const Visit& visit) const
  {
    std::uint32_t number = this->GetFirst(point);
    while (number != None && !visit(GetCorner(number)))
    {
      number = this->Links[number].Next;
    }
  }

  /// Calls visit(corner) for corners at two points in turn, until it returns true or one of the
  /// points has no more corners. So a point with very many corners costs no more than the other.
  template <typename Visit>
  void FindAtEither(std::int32_t one, std::int32_t other, const Visit& visit) const
  {
    std::uint32_t number = this->GetFirst(one);
    std::uint32_t next = this->GetFirst(other);
    while (number != None && next != None && !visit(GetCorner(number)))
    {
      number = std::exchange(next, this->Links[number].Next);
    }
  }

private:
  static constexpr std::uint32_t None = 0xFFFFFFFFu;

  /// The neighbours of a corner in its list.
  struct Link
  {
    std::uint32_t Next, Previous;
  };

  static PieceCorner GetCorner(std::uint32_t number)
  {
    return { number / 3, static_cast<int>(number % 3) };
  }
  std::uint32_t GetFirst(std::int32_t point) const
  {
    return static_cast<std::size_t>(point) < this->First.size() ? this->First[point] : None;
  }

  HostVector<std::uint32_t> First; ///< By point: the number of a corner, 3 * triangle + slot.
  RawVector<Link> Links; ///< By that number.
};

}

#endif
