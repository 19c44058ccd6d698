// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_HULLINSERTER_H
#define DELAUNAYFLIP_HULLINSERTER_H

#include "SphereStart.h"

#include <cstdint>
#include <vector>

namespace delaunayflip
{

/// Inserts points into a convex hull, one after the other, by exact arithmetic. It is for the few
/// points that are so near to others that the rounding of the projection confuses them.
class HullInserter
{
public:
  /// @param center a place inside of the hull.
  /// @param triangles those of the hull, counter-clockwise from outside.
  HullInserter(
    const SpacePoints& points, const PlanePoint& center, std::vector<std::int32_t> triangles);

  /// Extends the hull to a point, if that is outside. Points that are then inside lose their
  /// triangles.
  void Insert(std::int32_t point);

  /// The triangles of the hull.
  std::vector<std::int32_t> ListTriangles() const;

private:
  std::int32_t Locate(std::int32_t point) const;
  bool IsVisible(std::int32_t triangle, std::int32_t point) const;
  void CollectVisible(std::int32_t first, std::int32_t point);
  void ReplaceVisible(std::int32_t point);

  const SpacePoints& Points;
  const PlanePoint Center;
  std::vector<std::int32_t> Triangles; ///< Those that were removed have -1 as their first id.
  std::vector<std::int32_t> Neighbors;
  std::int32_t Last = 0; ///< A triangle near the point that was inserted last.
  std::vector<std::int32_t> Visible; ///< Triangles that the new point sees.
  std::vector<char> IsSeen; ///< By triangle.
};

}

#endif
