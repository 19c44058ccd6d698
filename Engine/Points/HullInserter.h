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
/// points that a projection confuses, because they are nearer to others than its rounding.
class HullInserter
{
public:
  /// @param triangles of the hull, counter-clockwise from outside. @param center inside of it.
  HullInserter(
    const SpacePoints& points, const PlanePoint& center, std::vector<std::int32_t> triangles);

  /// Makes the hull that of all its points and one more. Points that are inside then lose their
  /// triangles; the new one gets none if it is not outside. Of points at one place the first stays.
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
  std::vector<std::int32_t> Triangles; ///< The first id is -1 for what was removed.
  std::vector<std::int32_t> Neighbors;
  std::int32_t Last = 0; ///< A triangle near the last point.
  std::vector<std::int32_t> Visible; ///< Triangles that the new point sees.
  std::vector<char> IsSeen; ///< By triangle.
};

}

#endif
