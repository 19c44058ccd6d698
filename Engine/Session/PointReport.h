// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_POINTREPORT_H
#define DELAUNAYFLIP_POINTREPORT_H

#include "LoadedMesh.h"
#include "Outline.h"
#include "PointPreparation.h"
#include "RefusedSegments.h"
#include "SegmentPins.h"

#include <cstdint>
#include <vector>

/// @file
/// What is reported about points beside flips.

namespace delaunayflip
{

/// What was done to a mesh from points beside flips.
struct PointResult
{
  std::size_t Taken = 0; ///< How many segments are inserted or refused; they are the first ones.
  std::int64_t Inserted = 0; ///< How many of these are not refused.
  std::int64_t Flips = 0; ///< How many flips the insertion of segments took.
  std::vector<SegmentEdge> Edges;
  /// All edges of segments, if triangles may be removed. Then Edges has only those that are left.
  std::vector<SegmentEdge> WholeEdges;
  SegmentPins Pins; ///< Listed once points move.
  /// By number of an edge, whether it is in Edges or WholeEdges. Later edges are not.
  std::vector<bool> Seen;
  /// By index. If pieces of a given segment are refused, only the first of them.
  std::vector<RefusedSegment> Refused;
  KeptTriangles Kept;
  Defect Loss; ///< If no point before PointInput::FirstAdded is left.
  std::vector<std::int32_t> Regions; ///< What FindRegions returns; empty if it was not called.
  UnusedSeeds Seeds;
  std::vector<SegmentEdge> EdgesBefore; ///< Edges before refinement.
  std::int64_t RefinementRounds = 0;
  Defect Unrefined; ///< Triangles that do not reach the goals.
  bool HasReachedLimit = false;
  std::int64_t MoveRounds = 0; ///< PointCounts::MoveRounds.

  bool HasRemoved() const { return !this->Kept.Numbers.empty(); }

  /// The edges that all segments have become, also those of removed triangles.
  std::vector<SegmentEdge>& GetAllEdges()
  {
    return this->WholeEdges.empty() ? this->Edges : this->WholeEdges;
  }
};

/// A defect of rings, with their count and the first numbers.
Defect NameRings(DefectKind kind, std::vector<std::int32_t> numbers);

/// Whether triangles are removed, and no point before PointInput::FirstAdded is left, or without
/// such points no triangle.
bool IsLost(const PointInput& input, const KeptTriangles& kept);

/// Says that none of the given points is left, and where they, segments and hole seeds lie.
/// @param points are in the host's memory.
Defect DescribeLoss(const PreparedPoints& points, const KeptTriangles& kept);

/// Adds what is not about flips to a report that has the counts of the loaded mesh already.
void AddPointsTo(
  FlipReport& report, LoadedMesh& mesh, const PreparedPoints& points, const PointResult& result);

}

#endif
