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

/// Clips the ears of a polygon, one by one, in an order that the polygon alone decides: the walk
/// around it clips the next ear that it meets and goes on beyond the neighbour, for rounder
/// triangles than a fan's. A vertex is an ear where it turns left and no other vertex lies in its
/// triangle, but for those at the same place as a corner. Where a full round meets no ear the
/// polygon crosses itself, or has no area, and the vertex at which the round began is cut off.
///
/// Not every vertex is looked at in every round. One that is no ear becomes one only when a
/// neighbour is clipped or, where another vertex lies in its triangle, when that one is. So there
/// are few looks, and each is a search in a tree: usually n log n in all.
class EarClipper
{
public:
  using Triangles = std::vector<std::array<std::int64_t, 3>>;

  /// @param polygon counter-clockwise, of at least three vertices. Must live as long.
  /// @param progress of this polygon; may be empty. Must live as long.
  EarClipper(const std::vector<PlaneVector>& polygon, const ProgressObserver& progress);

  /// @returns triples of positions in the polygon, in order of the cuts; none when the observer
  /// stopped it.
  Triangles Clip();

private:
  bool MayGoOn();
  std::int64_t FindEar(std::int64_t from);
  bool IsEar(std::int64_t vertex);
  std::int64_t CutOff(std::int64_t vertex);
  bool IsCutOff(std::int64_t vertex) const { return this->Next[vertex] < 0; }

  const std::vector<PlaneVector>& Polygon;
  const ProgressObserver& Progress;
  PlaceTree Tree;
  std::int64_t Left; ///< Vertices.
  std::vector<std::int64_t> Next; ///< Vertex; -1 for one that was cut off.
  std::vector<std::int64_t> Previous;
  std::set<std::int64_t> Candidates; ///< Vertices that may be ears.
  std::vector<std::vector<std::int64_t>> BlockedBy; ///< By place: vertices, no ears because of it.
  Triangles Cut;
  std::int64_t VisitsTold = 0; ///< When the observer was last asked.
  bool Stopped = false;
};

}

#endif
