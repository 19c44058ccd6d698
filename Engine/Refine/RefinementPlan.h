// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_REFINEMENTPLAN_H
#define DELAUNAYFLIP_REFINEMENTPLAN_H

#include "Array.h"
#include "EdgeMesh.h"
#include "TriangleShape.h"

#include <cstdint>
#include <functional>
#include <vector>

/// @file
/// What a session tells a backend to refine, and what it gets.

namespace delaunayflip
{

/// What a removed triangle has in place of the number of its region: -1 for region 0 or if the
/// region does not matter, -2 for region 1, and so on.
DELAUNAYFLIP_HOST_DEVICE inline std::int32_t RemovedRegion(std::int32_t region)
{
  return -1 - region;
}
/// The region of a triangle, whether it is removed or not.
DELAUNAYFLIP_HOST_DEVICE inline std::int32_t GetRegion(std::int32_t number)
{
  return number < 0 ? -1 - number : number;
}

struct RefinementPlan
{
  RefinementGoals Goals;
  std::int64_t MostAdded = 0; ///< How many vertices may be added.
  bool KeepsBoundary = false; ///< Whether no edge of the boundary is split.
  /// Whether the mesh is the caller's. Then Regions is by the caller's triangle. Triangles that are
  /// not counter-clockwise count as removed, and all their edges stay.
  bool IsOfCaller = false;
  bool HasNonManifold = false; ///< Whether edges of such a mesh may have three or more triangles.
  /// The region of every triangle, or RemovedRegion of it for one that is removed. Empty: all are
  /// in region 0. Edges between removed triangles and others stay.
  std::vector<std::int32_t> Regions;
  /// The caller's label of each region; several may have the same. Empty: each has its own.
  std::vector<std::int32_t> LabelOfRegion;
  std::vector<double> AreaOfRegion; ///< The largest area, or infinity; empty: no limits.
  std::vector<double> Sizes; ///< By point, the longest edge there, or NaN; empty: no limits.
};

/// For a vertex that is on no segment.
constexpr std::uint32_t NoOrigin = 0xFFFFFFFFu;

/// A vertex that refinement has added, and what it interpolates between: three points, of which the
/// last one has weight 0 if the vertex has split a segment.
struct RefinedVertex
{
  double U, V;
  std::uint32_t Origin; ///< The number of the segment, by RefinementResult::Segments, or NoOrigin.
  VertexId Points[3];
  double Weights[3];
};

/// Is told of each added vertex with its number, on several threads.
using RefinedVertexVisitor = std::function<void(std::int64_t, const RefinedVertex&)>;

/// A subsegment.
struct Subsegment
{
  EdgeId Edge;
  std::uint32_t Origin; ///< The number of the subsegment that there was at first.
  VertexId Start, End; ///< Where the half-edge with the even number runs from, and to.
};

/// What refinement has made.
struct RefinementResult
{
  std::int64_t Added = 0; ///< How many vertices were added.
  std::vector<RefinedVertex> Vertices; ///< These, in a mesh of the caller alone.
  std::vector<Subsegment> Segments; ///< First those that there were at first.
  std::vector<std::int32_t> Regions; ///< See RefinementPlan.
  std::vector<VertexId> Ends; ///< The ends of the original segments, two points each.
  /// In a mesh of the caller: the source of each triangle, the triangle before refinement that
  /// contains its centroid. Both are given by their slots.
  std::vector<TriangleId> Sources;
  std::int64_t Edges = 0, BoundaryEdges = 0, RegionEdges = 0; ///< How many were added.
  std::int64_t Unrefined = 0; ///< Triangles that do not reach the goals.
  std::vector<TriangleId> FirstUnrefined; ///< Those with the smallest angles, the smallest first.
  bool HasReachedLimit = false;
  /// The caller's coordinates that are U and V; -1 in a tilted plane, or from points.
  int Axes[2] = { -1, -1 };
};

}

#endif
