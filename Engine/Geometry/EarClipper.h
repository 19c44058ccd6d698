// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_EARCLIPPER_H
#define DELAUNAYFLIP_EARCLIPPER_H

#include "FlipReport.h"
#include "PlaceTree.h"

#include <array>
#include <cstdint>
#include <set>
#include <vector>

namespace delaunayflip
{

/// Clips the ears of a polygon, one by one, in an order that depends only on the polygon: a walk
/// around it clips the next ear that it finds and continues beyond the neighbour, which makes
/// rounder triangles than a fan. A vertex is an ear if it turns left and no other vertex lies in
/// its triangle, except at the place of a corner. If the walk goes all the way around without an
/// ear, the polygon crosses itself or has no area, and the vertex at which it began is cut off.
///
/// Not every vertex is tested each time. A vertex that is not an ear can become one only when a
/// neighbour is clipped or, if another vertex lies in its triangle, when that one is clipped. So
/// there are few tests, and each is a search in a tree: usually n log n steps in all.
class EarClipper
{
public:
  using Triangles = std::vector<std::array<std::int64_t, 3>>;

  /// @param polygon counter-clockwise, with at least three vertices. Must live as long as this.
  /// @param progress told the share of this polygon; may be empty. Must live as long as this.
  EarClipper(const std::vector<PlaneVector>& polygon, const ProgressObserver& progress);

  /// @returns triples of positions in the polygon, in the order of the cuts; none if the observer
  /// stopped it.
  Triangles Clip();

private:
  bool ReportProgress();
  std::int64_t FindEar(std::int64_t from);
  bool IsEar(std::int64_t vertex);
  std::int64_t CutOff(std::int64_t vertex);
  bool IsCutOff(std::int64_t vertex) const { return this->Next[vertex] < 0; }

  const std::vector<PlaneVector>& Polygon;
  const ProgressObserver& Progress;
  PlaceTree Tree;
  std::int64_t Left; ///< The number of vertices left.
  std::vector<std::int64_t> Next; ///< The next vertex; -1 for a vertex that was cut off.
  std::vector<std::int64_t> Previous;
  std::set<std::int64_t> Candidates; ///< Vertices that may be ears.
  std::vector<std::vector<std::int64_t>>
    BlockedBy; ///< By place: the vertices that it keeps from being ears.
  Triangles Cut;
  std::int64_t VisitsTold = 0; ///< When the observer was last asked.
  bool Stopped = false;
};

}

#endif
