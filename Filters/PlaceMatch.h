// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef PlaceMatch_h
#define PlaceMatch_h

#include "ConstraintEdges.h"
#include "PointPlaces.h"

#include <cstdint>
#include <vector>

namespace delaunayflip
{

/// Finds, for edges between points of another dataset, the edges of a mesh at the same places.
///
/// Coordinates are compared in the lower of the two precisions: float constraints match the double
/// mesh from which they were made. Where several points of the mesh lie at one place, all pairs of
/// them that are edges of the mesh match.
class PlaceMatch
{
public:
  /// @param pairs point ids of `others`.
  /// @throws RunAborted.
  PlaceMatch(const PointArray& others, const std::vector<PointPair>& pairs, const PointArray& mesh,
    const ProgressObserver& progress);

  /// Adds pairs of the mesh's points. Some of them may not be edges of the mesh. Pairs with an end
  /// where the mesh has no point are counted as unmatched.
  /// @throws RunAborted.
  void AddEdges(
    const TriangleArray& triangles, const ProgressObserver& progress, ConstraintEdges& edges) const;

private:
  void NumberPlaces(const PointArray& others, const std::vector<PointPair>& pairs,
    const ProgressObserver& progress);
  void FindPoints(const PointArray& mesh, const ProgressObserver& progress);
  std::int64_t AddEdgesAt(const std::vector<PointPair>& crowded, const TriangleArray& triangles,
    const ProgressObserver& progress, std::vector<PointPair>& edges) const;
  std::int64_t GetPlace(std::int64_t point) const;

  PointPlaces Places;
  std::vector<PointPair> Wanted; ///< Pairs of places, unique, in the order given.
  std::vector<std::int64_t> PlaceOfPoint; ///< For every point of the mesh its place, or None.
  std::vector<std::int64_t> PointsAtPlace; ///< How many points of the mesh lie there.
  std::vector<std::int64_t> PointOfPlace; ///< The first of them.
};

}

#endif
