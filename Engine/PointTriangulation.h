// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_POINTTRIANGULATION_H
#define DELAUNAYFLIP_POINTTRIANGULATION_H

#include "DeviceMesh.h"
#include "EngineExport.h"
#include "FlipOptions.h"
#include "TriangleMesh.h"

#include <cstdint>

/// @file
/// A FlipSession triangulates points in the plane. It takes a PointInput and PointOptions:
///
///     const double xy[] = { 0, 0, 1, 0, 0, 1, 1, 1.5 };
///     PointInput points;
///     points.Points = PlaneArray(xy, 4, 2);
///     FlipSession session(points, PointOptions());
///     session.Advance();
///     const std::int64_t count = session.GetReport().Triangles;
///     std::vector<std::int32_t> ids(3 * count);
///     session.StoreTriangles(MutableTriangleArray(ids.data(), count));
///     count; // 2
///
/// **Points.** If several points are at one place, the one with the lowest id is used. Points with
/// NaN or infinite coordinates are not used. All triangles are counter-clockwise and have an area.
/// n places with h on the hull have 2 n - 2 - h triangles. The triangles depend on the places and
/// the segments alone, not on the order of the points: ties are canonical.
///
/// **Segments** become edges of the mesh, and stay; all other edges are constrained Delaunay. They
/// are taken in their order. One that passes through points is split there. One that overlaps an
/// earlier one is no conflict. One that crosses an earlier one is refused, counted and named in the
/// report, or with PointOptions::SplitCrossings both are split where they cross.
///
/// **Rings** are closed polygons of segments, in any direction. There are two sets of them: the
/// outline, and the holes (PointInput::FirstHole). PointOptions::RingRule says what is inside a
/// set. The triangles inside the outline and not inside the holes are kept. Without an outline, all
/// triangles not inside the holes are. The rest is removed, then the triangles around hole seeds,
/// then those that Alpha and LongestEdge name. A ring without an area, such as one of fewer than
/// three places or with all of them on one line, is left out and reported: its segments are
/// segments of no ring. A ring with the edges of an earlier one of its set is left out, too: by
/// EvenOdd both together would enclose nothing, and by the other rules two directions would cancel
/// each other. A ring that runs more than once along its loop counts once.
///
/// **Refinement** adds points until no triangle has an angle below FlipOptions::MinimumAngle and
/// none is larger than MaximumArea, MaximumEdge, PointInput::Sizes and the regions allow. It adds
/// many points at a time: off-centers of triangles (Üngör 2004), and points that split segments
/// and the edges of the boundary if others come too near (Ruppert 1995). Triangles that cannot get
/// better are left and counted: segments meet there at a small angle or must not be split, or their
/// height is only a few roundings of the coordinates. Regions are the parts that segments enclose.
///
/// **On a sphere** (PointOptions::Projection) triangles are those of the convex hull: n places have
/// 2 n - 4 of them, counter-clockwise from outside. Signs are exact for the points as given, so a
/// point that rounding has put inside of the hull is not used. If four points lie in one plane, the
/// diagonal is the one that flips with TieRuleKind::Canonical choose. PlaceOnSphere makes such
/// points from longitudes and latitudes. Points cannot be inserted, moved or removed.
/// Interpolation.h says what queries about places mean there. As in the plane, places in triangles
/// that rings and seeds have removed are outside.
///
/// Segments run along great circles, the shorter way around; ends on opposite sides of the sphere
/// are an error. They are taken in their order, and not split where they cross. They need points
/// all around the center, or ProjectionKind::OpenSphere. A ring has two sides on a sphere, so
/// PointOptions::RingRule says which one is its inside. With EvenOdd and NonZero it is the smaller
/// one, whatever the ring's direction. With Orientation it is the one to the left of the ring, seen
/// from outside, as GeoJSON has it. If both are equally large, it is the left one. All else is as
/// in the plane.

namespace delaunayflip
{

/// When a place is inside a set of rings.
enum class RingRuleKind
{
  /// If a path from there to infinity crosses the rings an odd number of times. On a sphere: if it
  /// is inside an odd number of rings.
  EvenOdd,
  /// If the sum of the rings' winding numbers around it is not 0. On a sphere, that of a ring is 0
  /// outside of it.
  NonZero,
  /// The rule of vtkDelaunay2D's Source. A place is inside the outline if the sum of the winding
  /// numbers is positive or, if no ring of the outline is counter-clockwise, if it is 0. It is
  /// inside the holes by NonZero. On a sphere, a place is inside the outline if the sum is not the
  /// smallest one of all places.
  Orientation
};

/// The surface on which points are triangulated.
enum class ProjectionKind
{
  Plane, ///< The plane of x and y.
  /// A sphere around the origin: the triangles are the convex hull of the points, by x, y and z.
  /// Points inside of it are not used.
  Sphere,
  /// Like Sphere, but a triangle is left out if its circumcircle encloses half of the sphere or
  /// more. So points on less than half of the sphere get an open mesh.
  OpenSphere
};

/// Points in the plane, and the segments between them.
struct PointInput
{
  PlaneArray Points;

  /// Pairs of point ids, 2 * NumberOfSegments of them; null if there are none.
  const std::int64_t* Segments = nullptr;
  std::int64_t NumberOfSegments = 0;

  /// For every segment the number of its ring, from 0 to INT32_MAX - 1, or -1 for a segment that is
  /// part of no ring. Null: there are no rings. The segments of a ring may run in any direction. If
  /// it varies, the direction of the first one holds for all.
  const std::int32_t* Rings = nullptr;
  /// Rings from this number on are holes; those before are the outline.
  std::int32_t FirstHole = INT32_MAX;

  /// x and y of places in holes, on a sphere x, y and z: the triangles that can be reached from
  /// there without crossing a segment are removed. 2 or 3 * NumberOfHoleSeeds numbers.
  const double* HoleSeeds = nullptr;
  std::int64_t NumberOfHoleSeeds = 0;

  /// Points from this number on belong to segments alone. The report tells if no others are left,
  /// and if holes reach beyond all others where there is no outline.
  std::int64_t FirstAdded = INT64_MAX;

  /// The longest edge that triangles may have near each point, or null: no limit. Between points it
  /// is interpolated linearly. NaN: no limit near that point.
  const double* Sizes = nullptr;

  /// If several are in one part, the first one counts. Others with another label or area are
  /// defects.
  const RegionSeed* Regions = nullptr;
  std::int64_t NumberOfRegions = 0;

  /// Whether the coordinates are in the memory of a GPU, ordered by Stream. All other arrays are in
  /// the host's.
  bool OnDevice = false;
  DeviceStream Stream{};
};

/// How points are triangulated. Geometry, Criterion, TieRule and FeatureAngle of FlipOptions are
/// not used; NumberOfPieces must be 0 or 1.
struct PointOptions : FlipOptions
{
  /// Points nearer than this to one that is used and has a lower id are not used. 0 (default): only
  /// those at the same place. Points where segments cross may be nearer to others.
  double PointTolerance = 0.0;

  /// Whether segments that cross are split where they do. The point is the exact crossing, rounded
  /// once to the precision of the points; a point that is there already is used. Up to 10 rounds,
  /// because the halves may cross others, or fewer where crossings multiply; what then still
  /// crosses is refused.
  bool SplitCrossings = false;

  RingRuleKind RingRule = RingRuleKind::EvenOdd;

  /// Triangles with a larger circumradius are removed, unless one of their edges is a segment. 0
  /// (default): none.
  double Alpha = 0.0;

  /// Triangles with a longer edge are removed in the same way. 0 (default): none.
  double LongestEdge = 0.0;

  /// On a sphere points have x, y and z: PlaneArray::Stride is at least 3. Sizes, regions,
  /// refinement and the other options of this struct but RingRule are errors there.
  ProjectionKind Projection = ProjectionKind::Plane;
};

/// Calls visit(name, option...) for each option that delaunayflip_points has: those that
/// FlipOptions do not have, and those of refinement. Those of all structs are side by side. The
/// name is that of the C struct.
template <typename Visit, typename... Options>
void ForEachPointOption(const Visit& visit, Options&... options)
{
  visit("alpha", options.Alpha...);
  visit("longest_edge", options.LongestEdge...);
  visit("point_tolerance", options.PointTolerance...);
  visit("split_crossings", options.SplitCrossings...);
  visit("ring_rule", options.RingRule...);
  visit("minimum_angle", options.MinimumAngle...);
  visit("maximum_area", options.MaximumArea...);
  visit("maximum_edge", options.MaximumEdge...);
  visit("keep_boundary", options.KeepBoundary...);
  visit("point_limit", options.PointLimit...);
  visit("projection", options.Projection...);
}

inline bool operator==(const PointOptions& a, const PointOptions& b)
{
  const FlipOptions& first = a;
  const FlipOptions& second = b;
  bool isSame = first == second;
  ForEachPointOption([&](const char*, const auto& one, const auto& other)
    { isSame = isSame && one == other; },
    a, b);
  return isSame;
}

/// A point made where two segments cross, or by refinement. Its id is the number of the caller's
/// points plus its index. Those of refinement come last.
struct AddedPoint
{
  double X = 0.0, Y = 0.0;
  /// What belongs to the point, such as z, is (1 - Share - ThirdShare) times that of point From,
  /// plus Share times that of point To, plus ThirdShare times that of point Third. From and To are
  /// the ends of the earlier one of two segments that cross, or of the edge that is split; the ids
  /// may be those of points that were added before. Else these are the corners of a triangle that
  /// the point was in before refinement.
  std::int64_t From = -1, To = -1;
  double Share = 0.0;
  std::int64_t Third = -1; ///< -1: there are only two.
  double ThirdShare = 0.0;
  /// The segment on which refinement has put the point, or -1. Always -1 in a session from
  /// triangles.
  std::int64_t Segment = -1;
  double Z = 0.0; ///< Used in a session from triangles only.
};

/// Arrays of the members of added points. Null: those are not wanted.
struct AddedPointArrays
{
  double* Places = nullptr; ///< X, Y and, if Components is 3, Z.
  int Components = 2;
  std::int64_t* Ids = nullptr; ///< From, To and Third.
  double* Weights = nullptr; ///< Three, for these ids.
  std::int64_t* Segments = nullptr;

  /// Writes a point to place i.
  void Set(std::int64_t i, const AddedPoint& point) const
  {
    if (this->Places)
    {
      this->Places[this->Components * i] = point.X;
      this->Places[this->Components * i + 1] = point.Y;
      if (this->Components > 2)
      {
        this->Places[this->Components * i + 2] = point.Z;
      }
    }
    if (this->Ids)
    {
      this->Ids[3 * i] = point.From;
      this->Ids[3 * i + 1] = point.To;
      this->Ids[3 * i + 2] = point.Third;
    }
    if (this->Weights)
    {
      this->Weights[3 * i] = 1.0 - point.Share - point.ThirdShare;
      this->Weights[3 * i + 1] = point.Share;
      this->Weights[3 * i + 2] = point.ThirdShare;
    }
    if (this->Segments)
    {
      this->Segments[i] = point.Segment;
    }
  }
};

/// New places of points, for FlipSession::Move.
struct PointMove
{
  PlaneArray Points; ///< One for each point of the caller, or for each id.
  const std::int64_t* Ids = nullptr; ///< The points that move, in the host's memory; null: all.
  /// Whether the coordinates are in the memory of a GPU, ordered by Stream. Not allowed with Ids,
  /// or after points were removed, until FlipSession::Compact.
  bool OnDevice = false;
  DeviceStream Stream{};
};

/// What is reported about points beside the flips.
struct PointCounts
{
  std::int64_t Used = 0; ///< Points that triangles have in the end, those at crossings included.
  std::int64_t NotFinite = 0; ///< Points with NaN or infinite coordinates.
  std::int64_t Repeated = 0; ///< Points at the place of one with a lower id.
  std::int64_t TooNear = 0; ///< Points within the tolerance of one elsewhere with a lower id.
  std::int64_t SegmentEdges = 0; ///< Edges that segments have become, each once; not removed ones.
  /// They cross earlier ones, or an end is not finite or removed.
  std::int64_t RefusedSegments = 0;
  std::int64_t Crossings = 0; ///< Points added where segments cross.
  double LargestShift = 0.0; ///< How far rounding has moved one of them at most.
  std::int64_t OutsideTriangles = 0; ///< Removed outside rings and around hole seeds.
  std::int64_t LargeTriangles = 0; ///< Removed by Alpha and LongestEdge, and from open spheres.
  std::int64_t LeftOutRings = 0; ///< They have no area, or the edges of an earlier one.
  std::int64_t RefinementPoints = 0; ///< Points added by refinement.
  std::int64_t RefinementRounds = 0; ///< How often it has added points.
  /// Triangles with an angle below MinimumAngle or that are too large, which could not get better.
  std::int64_t UnrefinedTriangles = 0;
  std::int64_t ReachedPointLimit = 0; ///< 1 if FlipOptions::PointLimit has ended refinement.
  std::int64_t Removed = 0; ///< Points that FlipSession::Remove has removed.
  /// The number of rounds of the last move, removal or insertion; 0 if there was none, or if it
  /// triangulated the points anew.
  std::int64_t MoveRounds = 0;
  std::int64_t Inside = 0; ///< On a sphere: points inside of the convex hull, which are not used.
};

/// Writes x, y and z of a place on the unit sphere. Multiples of 90 degrees give exact zeros and
/// ones. So longitudes that differ by 360 degrees give one place, and so do all longitudes at a
/// pole. For other angles the last bit depends on the system's sine and cosine. If an angle is not
/// finite, all three are NaN.
/// @param longitude, latitude in degrees. A latitude beyond 90 degrees continues across the pole.
DELAUNAYFLIP_EXPORT void PlaceOnSphere(double longitude, double latitude, double xyz[3]);

}

#endif
