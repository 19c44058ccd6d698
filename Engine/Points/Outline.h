// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_OUTLINE_H
#define DELAUNAYFLIP_OUTLINE_H

#include "FlipReport.h"
#include "PlaneMesh.h"
#include "PointTriangulation.h"
#include "SurfaceAngles.h"
#include "WideAngles.h"

#include <cstdint>
#include <map>
#include <vector>

/// @file
/// Finds the triangles of a triangulation of points that do not belong to the result.

namespace delaunayflip
{

/// A triangulation of points in the host's memory.
struct PointMeshView : PlaneMesh
{
  std::int64_t NumberOfTriangles;
  std::int64_t NumberOfEdges;
  std::int64_t NumberOfPlaces;
  const VertexId* Ids; ///< By place: the point that is used there.
  CoordinateRange Range; ///< The range of the places.
};

/// An edge that a segment has become.
struct SegmentEdge
{
  HalfEdgeId Side; ///< One that has a triangle.
  std::int32_t Ring; ///< -1: none.
  bool IsOnLeft; ///< Whether Side is to the left of the segment.
  bool IsOnBoundary; ///< Whether only one side has a triangle.
  bool IsFirst; ///< Whether no segment before has become the same edge.
  std::uint32_t Segment; ///< The index of its segment.
};

/// What is left of a triangulation. The counts and angles of what is kept are known only if
/// triangles are removed.
struct KeptTriangles
{
  /// The new number of every triangle, by its slot in the output, or -1. Empty: all are kept.
  std::vector<std::int32_t> Numbers;
  std::int64_t Count = 0;
  std::int64_t Outside = 0, Large = 0; ///< How many are not kept, and why.
  std::int64_t SeedsOutside = 0; ///< Hole seeds in no triangle.
  std::vector<std::int32_t> RingsWithoutArea; ///< Their numbers; they have removed nothing.
  std::vector<std::int32_t> RepeatedRings; ///< Those with the edges of an earlier one; left out.
  std::vector<std::int32_t> RingsRunAgain; ///< Those that run more than once along their loop.
  std::int64_t HolePointsOutside = 0; ///< Corners of holes outside the hull of other points.
  std::int64_t Used = 0; ///< Points of the triangles that are kept.
  std::int64_t UsedGiven = 0; ///< Those of them before PointInput::FirstAdded.
  std::int64_t Edges = 0, Boundary = 0; ///< How many edges the triangles that are kept have.
  std::int64_t EulerCharacteristic = 0;
  AngleSums Angles;
};

/// An edge of a ring.
struct RingEdge
{
  EdgeId Edge;
  /// How often more the ring winds around the side with the even number than around the other one.
  std::int64_t Turns;
};

/// The edges of rings, by their numbers.
using RingMap = std::map<std::int32_t, std::vector<RingEdge>>;

/// Lists the edges of rings, each ring once: without the repeats of its own loop, and without rings
/// that repeat an earlier one of their set in either direction. By even-odd both together would
/// enclose nothing; by the other rules two directions would cancel each other.
RingMap ListRings(
  const std::vector<SegmentEdge>& segments, std::int32_t firstHole, KeptTriangles& kept);

/// Whether these options can remove triangles.
bool MayRemove(const PointInput& input, const PointOptions& options);

/// An edge that stays, between components: triangles that are connected without such edges.
struct ComponentWall
{
  static constexpr std::uint32_t NoComponent = 0xFFFFFFFFu; ///< Where there is no triangle.

  EdgeId Edge;
  std::uint32_t Components[2]; ///< Those at its half-edges, first that with the even number.
};

/// The components of a triangulation.
struct ComponentMap
{
  std::int64_t Count = 0;
  std::vector<ComponentWall> Walls; ///< By edge.
};

/// Judges the components of a triangulation by rings and seeds.
class ComponentJudge
{
public:
  ComponentJudge(
    const ComponentMap& map, const std::vector<SegmentEdge>& segments, const PointInput& input)
    : Map(map),
      Segments(segments),
      Input(input)
  {
  }

  /// Removes what is inside the holes, and what is not inside the outline.
  /// @param kept receives which rings are left out.
  void RemoveOutside(RingRuleKind rule, KeptTriangles& kept);

  /// Removes the components of seeds. @returns how many seeds are in no triangle.
  std::int64_t RemoveHoles(const std::vector<std::uint32_t>& components);

  /// Whether there are holes without an outline, and points of holes may be corners of the hull.
  bool HasHolesAlone() const { return this->HolesAlone; }

  /// 1 for every component that is removed, else 0. Empty: none is.
  const std::vector<std::uint8_t>& GetRemoved() const { return this->IsRemoved; }

private:
  const ComponentMap& Map;
  const std::vector<SegmentEdge>& Segments;
  const PointInput& Input;
  bool HolesAlone = false;
  std::vector<std::uint8_t> IsRemoved;
};

/// How many corners of the hull belong to holes alone. Without them the hull would be smaller.
std::int64_t CountHolePointsOutside(
  const PointMeshView& mesh, const PointInput& input, const std::vector<SegmentEdge>& segments);

/// The triangles that the hole seeds are in, or NoTriangle.
std::vector<TriangleId> FindHoleSeeds(const PointMeshView& mesh, const PointInput& input);

/// Seeds of regions that are not used.
struct UnusedSeeds
{
  Defect Outside = Defect(DefectKind::RegionSeedsOutside); ///< In no region.
  /// In the region of an earlier one, with another label or area.
  Defect Repeated = Defect(DefectKind::RegionSeedsRepeated);
};

/// Spreads the numbers of seeds, from 1, over the regions that they are in. Regions end at fixed
/// edges and at removed triangles.
/// @param regions by triangle, 0 or, for a removed one, -1; receives the number of the first seed
/// there. @param side the orientation of the triangles that are not removed, 1 or -1.
UnusedSeeds SpreadSeeds(const PointMeshView& mesh, const RegionSeed* seeds, std::int64_t count,
  int side, std::vector<std::int32_t>& regions);

/// The region of each triangle: the number of the first seed there plus 1, 0 where there is none,
/// and -1 if it is removed. Regions end at segments and at removed triangles.
/// @param kept numbers the triangles.
std::vector<std::int32_t> FindRegions(const PointMeshView& mesh, const PointInput& input,
  const KeptTriangles& kept, UnusedSeeds& unused);

}

#endif
