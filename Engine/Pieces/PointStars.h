// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_POINTSTARS_H
#define DELAUNAYFLIP_POINTSTARS_H

#include "PieceTriangle.h"

#include <cstdint>
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
  void AddAll(std::vector<PieceTriangle>& triangles, std::int64_t points);

  /// Adds a triangle that is not in the lists.
  void Add(std::vector<PieceTriangle>& triangles, std::int64_t triangle);

  /// Takes triangles away that are about to change their points or to leave.
  void Remove(std::vector<PieceTriangle>& triangles, const std::vector<std::int64_t>& removed);

  /// Calls visit(triangle) for every corner at a point.
  template <typename Visit>
  void ForEach(std::int32_t point, const Visit& visit) const
  {
    for (std::uint32_t corner = this->GetFirst(point); corner != None; corner = this->Next[corner])
    {
      visit(static_cast<std::int64_t>(corner / 3));
    }
  }

private:
  static constexpr std::uint32_t None = 0xFFFFFFFFu;
  static constexpr std::uint32_t Unlisted = None - 1; ///< Instead of the next one.

  void Clean(const std::vector<PieceTriangle>& triangles, std::int32_t point);

  std::uint32_t GetFirst(std::int32_t point) const
  {
    return static_cast<std::size_t>(point) < this->First.size() ? this->First[point] : None;
  }

  std::vector<std::uint32_t> First; ///< By point: a corner, 3 * triangle + slot.
  std::vector<std::uint32_t> Next; ///< By corner: the next one at the same point.
};

}

#endif
