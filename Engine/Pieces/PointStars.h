// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_POINTSTARS_H
#define DELAUNAYFLIP_POINTSTARS_H

#include "IdSet.h"
#include "PieceTriangle.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace delaunayflip
{

/// The triangles at every point of a rank, in lists that are kept up to date, so that a round takes
/// no time for triangles that it does not change.
class PointStars
{
public:
  /// Adds all triangles.
  /// @param points how many there are; others may come later.
  void AddAll(const PieceTriangles& triangles, std::int64_t points);

  /// Adds a triangle that is not in the lists.
  void Add(const PieceTriangles& triangles, std::int64_t triangle);

  /// Takes triangles away that are about to change their points or to leave.
  void Remove(const PieceTriangles& triangles, const std::vector<std::int64_t>& removed);

  /// Calls visit(triangle) for every corner at a point.
  template <typename Visit>
  void ForEach(std::int32_t point, const Visit& visit) const
  {
    for (std::uint32_t corner = this->GetFirst(point); corner != None; corner = this->Next[corner])
    {
      visit(static_cast<std::int64_t>(corner / 3));
    }
  }

  /// The same for several points, in no order, but faster: their lists are walked side by side, so
  /// that the processor waits for many places of memory at a time.
  template <typename Visit>
  void ForEachOf(const std::vector<std::int32_t>& points, const Visit& visit) const
  {
    constexpr std::size_t Lists = 16;
    std::uint32_t corners[Lists];
    for (std::size_t begin = 0; begin < points.size(); begin += Lists)
    {
      std::size_t open = 0;
      const auto keep = [&](std::uint32_t corner)
      {
        corners[open] = corner;
        open += corner != None ? 1 : 0;
      };
      const std::size_t end = std::min(points.size(), begin + Lists);
      std::for_each(points.begin() + begin, points.begin() + end,
        [&](std::int32_t point) { keep(this->GetFirst(point)); });
      while (open > 0)
      {
        const std::size_t before = std::exchange(open, 0);
        for (std::size_t i = 0; i < before; ++i)
        {
          const std::uint32_t corner = corners[i];
          keep(this->Next[corner]);
          visit(static_cast<std::int64_t>(corner / 3));
        }
      }
    }
  }

private:
  static constexpr std::uint32_t None = 0xFFFFFFFFu;
  static constexpr std::uint32_t Unlisted = None - 1; ///< Instead of the next one.

  void Clean(std::int32_t point);

  std::uint32_t GetFirst(std::int32_t point) const
  {
    return static_cast<std::size_t>(point) < this->First.size() ? this->First[point] : None;
  }

  HostVector<std::uint32_t> First; ///< By point: a corner, 3 * triangle + slot.
  IdSet Removed; ///< Triangles; empty but within Remove.
  HostVector<std::uint32_t> Next; ///< By corner: the next one at the same point.
};

}

#endif
