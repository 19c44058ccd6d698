// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_MESHBORDERS_H
#define DELAUNAYFLIP_MESHBORDERS_H

#include "EdgeTable.h"
#include "PlaneMesh.h"
#include "RefinementView.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

/// @file
/// What refinement leaves as it is in a mesh of the caller, which may have any defect: triangles
/// that are not counter-clockwise, their edges, and edges with three or more triangles.

namespace delaunayflip
{

/// Finds the region of a triangle: the caller's, or 0 if the caller has given none. A triangle that
/// is not counter-clockwise counts as removed.
struct CallerRegionStep
{
  PlaneMesh Mesh;
  const std::int32_t* Given; ///< RefinementPlan::Regions; null: none are given.
  std::int32_t* Regions;

  DELAUNAYFLIP_HOST_DEVICE void operator()(TriangleId t) const
  {
    this->Judge(t, this->Given ? this->Given[this->Mesh.Edges.Triangles[t].InputTriangle] : 0);
  }

  /// @param given the number of its region.
  DELAUNAYFLIP_HOST_DEVICE void Judge(TriangleId t, std::int32_t given) const
  {
    const bool isRemoved = given < 0 || !this->IsCounterClockwise(this->Mesh.Edges.Triangles[t]);
    this->Regions[t] = isRemoved ? RemovedRegion(GetRegion(given)) : given;
  }

private:
  DELAUNAYFLIP_HOST_DEVICE bool IsCounterClockwise(const TriangleRecord& triangle) const
  {
    const VertexId* v = triangle.Vertices;
    const bool isSound = HasEdges(triangle) && this->Mesh.IsFinite(v[0]) &&
      this->Mesh.IsFinite(v[1]) && this->Mesh.IsFinite(v[2]);
    return isSound && this->Mesh.FindOrientation(v[0], v[1], v[2]) > 0;
  }
};

/// Fixes an edge that must not flip during refinement: an edge of a removed triangle, or an edge
/// that is bad but cannot flip. Walks and cavities end at fixed edges.
struct FixWallStep
{
  EdgeMeshView Mesh;
  /// By triangle, negative for one that is removed. Null after a round, when only edges that cannot
  /// flip are fixed.
  const std::int32_t* Regions;
  std::uint8_t* Marks; ///< By edge, the marks for its subsegment; null after a round.
  std::uint32_t* SegmentOfEdge; ///< See RefinementView.

  DELAUNAYFLIP_HOST_DEVICE void operator()(EdgeId e) const
  {
    const CornerPair corners = this->Mesh.GetCorners(e);
    const EdgeState state = this->Mesh.States[e];
    const bool isAtRemoved = this->IsRemoved(corners.A) || this->IsRemoved(corners.B);
    // Without a guard a loop on a device does not write states. Good edges are candidates there.
    const bool isBad = state >= EdgeState::BlockedByDeviation && state <= EdgeState::Bad;
    const bool becomesFixed = state != EdgeState::Fixed && (isAtRemoved || isBad);
    if (becomesFixed)
    {
      this->Mesh.States[e] = EdgeState::Fixed;
      this->SegmentOfEdge[e] = FixedForNow;
    }
    if (!this->Marks)
    {
      return;
    }
    const bool hasTwo = corners.A != NoCorner && corners.B != NoCorner;
    const bool staysWhole = becomesFixed || (hasTwo && (isAtRemoved || this->RunAlike(corners)));
    this->Marks[e] = staysWhole ? CannotSplit : 0;
    if (becomesFixed)
    {
      this->Marks[e] |= FixedMeanwhile;
    }
    else
    {
      this->SegmentOfEdge[e] = NoSegment;
    }
  }

private:
  DELAUNAYFLIP_HOST_DEVICE bool IsRemoved(CornerId corner) const
  {
    return corner != NoCorner && this->Regions && this->Regions[TriangleOf(corner)] < 0;
  }
  /// Whether the edge is wrongly wound: both triangles run through it the same way.
  DELAUNAYFLIP_HOST_DEVICE bool RunAlike(const CornerPair& corners) const
  {
    const TriangleRecord& a = this->Mesh.Triangles[TriangleOf(corners.A)];
    const TriangleRecord& b = this->Mesh.Triangles[TriangleOf(corners.B)];
    return a.Vertices[NextSlot(SlotOf(corners.A))] == b.Vertices[NextSlot(SlotOf(corners.B))];
  }
};

/// 1 if an edge is fixed for refinement alone, else 0.
struct FixedMeanwhileTest
{
  EdgeMeshView Mesh;
  const std::uint32_t* SegmentOfEdge; ///< See RefinementView.
  const std::uint8_t* Marks; ///< By subsegment.

  DELAUNAYFLIP_HOST_DEVICE int operator()(std::int64_t e) const
  {
    if (this->Mesh.States[e] != EdgeState::Fixed)
    {
      return 0;
    }
    const std::uint32_t segment = this->SegmentOfEdge[e];
    if (segment < FixedForNow)
    {
      return int((this->Marks[segment] & FixedMeanwhile) != 0);
    }
    return int(segment == FixedForNow);
  }
};

/// Marks records that stand for the same edge. Such an edge is non-manifold, and is not split.
inline void MarkRepeatedEdges(const std::vector<TriangleRecord>& triangles,
  const std::vector<CornerId>& corners, std::vector<std::uint8_t>& marks)
{
  std::vector<std::pair<std::uint64_t, std::size_t>> edges;
  for (std::size_t e = 0; e < marks.size(); ++e)
  {
    const CornerId corner = corners[2 * e];
    if (corners[2 * e + 1] == NoCorner && corner != NoCorner)
    {
      edges.emplace_back(KeyOpposite(triangles[TriangleOf(corner)], SlotOf(corner)), e);
    }
  }
  std::sort(edges.begin(), edges.end());
  for (std::size_t i = 1; i < edges.size(); ++i)
  {
    if (edges[i].first == edges[i - 1].first)
    {
      marks[edges[i].second] |= CannotSplit;
      marks[edges[i - 1].second] |= CannotSplit;
    }
  }
}

/// How many of the given edges are boundary edges, and how many are between regions of the caller.
struct BorderSums
{
  std::int64_t Boundary = 0, Regions = 0;

  DELAUNAYFLIP_HOST_DEVICE BorderSums& operator+=(const BorderSums& part)
  {
    this->Boundary += part.Boundary;
    this->Regions += part.Regions;
    return *this;
  }
};

struct BorderCount
{
  EdgeMeshView Mesh;
  const std::int32_t* Regions;
  const std::int32_t* LabelOfRegion; ///< RefinementPlan's, or null.
  const EdgeId* Edges;

  DELAUNAYFLIP_HOST_DEVICE void operator()(std::int64_t i, BorderSums& sums) const
  {
    const CornerPair corners = this->Mesh.GetCorners(this->Edges[i]);
    if (corners.A == NoCorner || corners.B == NoCorner)
    {
      ++sums.Boundary;
      return;
    }
    sums.Regions += int(this->GetLabel(corners.A) != this->GetLabel(corners.B));
  }

private:
  DELAUNAYFLIP_HOST_DEVICE std::int32_t GetLabel(CornerId corner) const
  {
    const std::int32_t region = this->Regions[TriangleOf(corner)];
    return this->LabelOfRegion && region >= 0 ? this->LabelOfRegion[region] : region;
  }
};

}

#endif
