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

/// Finds, for edges between points of another dataset, the edges of a mesh at the same place.
///
/// Coordinates are compared in the lesser of the two precisions: float constraints match the double
/// mesh from which they were made. Where several points of the mesh lie at one place, the pairs
/// that are edges of the mesh are meant.
class PlaceMatch
{
public:
  /// @param pairs ids of `others`.
  PlaceMatch(const PointArray& others, const std::vector<PointPair>& pairs, const PointArray& mesh);

  /// Adds pairs of the mesh's points. A pair at a place where the mesh has no edge may be among
  /// them; pairs at places where it has no points are counted as unmatched.
  void AddEdges(const TriangleArray& triangles, ConstraintEdges& edges) const;

private:
  void NumberPlaces(const PointArray& others, const std::vector<PointPair>& pairs);
  void FindPoints(const PointArray& mesh);
  std::int64_t AddEdgesAt(const std::vector<PointPair>& crowded, const TriangleArray& triangles,
    std::vector<PointPair>& edges) const;
  std::int64_t GetPlace(std::int64_t point) const;

  PointPlaces Places;
  std::vector<PointPair> Wanted; ///< Pairs of places, ascending, none twice.
  std::vector<std::int64_t> PlaceOfPoint; ///< Of the mesh, or None.
  std::vector<std::int64_t> PointsAtPlace; ///< How many points of the mesh lie there.
  std::vector<std::int64_t> PointOfPlace; ///< The first of them.
};

}

#endif
