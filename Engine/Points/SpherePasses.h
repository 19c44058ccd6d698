// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_SPHEREPASSES_H
#define DELAUNAYFLIP_SPHEREPASSES_H

#include "Array.h"
#include "ExactPredicates.h"
#include "SmallestAngle.h"
#include "SphereStart.h"
#include "SurfaceAngles.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

/// @file
/// Passes over points and triangles on a sphere, for both backends: the start of a triangulation
/// (SphereStart.h), and the test of all its edges.

namespace delaunayflip
{

/// Points in the memory of a backend.
struct SpherePoints
{
  const PlanePoint* Places;
  const std::int32_t* Active; ///< The ids of those that count, ascending. Null: all count.
  std::int64_t Count; ///< How many count.

  DELAUNAYFLIP_HOST_DEVICE std::int32_t GetId(std::int64_t i) const
  {
    return this->Active ? this->Active[i] : static_cast<std::int32_t>(i);
  }
};

/// Triangles in the memory of a backend.
struct SphereTriangles
{
  const std::int32_t* Ids;
  const std::int32_t* Neighbors; ///< The list of FindNeighbors.
  std::int64_t Count;
};

//------------------------------------------------------------------------------
/// The point with the largest measure. If several have it, it is the one farthest north. If several
/// points are at that place, it is the first one.
struct LargestPoint
{
  double Measure = -INFINITY;
  NumberedPoint Point = { std::numeric_limits<std::int32_t>::max(),
    { -INFINITY, -INFINITY, -INFINITY } };

  DELAUNAYFLIP_HOST_DEVICE LargestPoint& operator+=(const LargestPoint& other)
  {
    if (this->IsBehind(other))
    {
      *this = other;
    }
    return *this;
  }
  DELAUNAYFLIP_HOST_DEVICE bool IsBehind(const LargestPoint& other) const
  {
    if (this->Measure != other.Measure)
    {
      return this->Measure < other.Measure;
    }
    const bool isSame = IsSamePlace(this->Point.Place, other.Point.Place);
    return IsFartherNorth(other.Point.Place, this->Point.Place) ||
      (isSame && other.Point.Id < this->Point.Id);
  }
};

template <typename Measure, typename Backend>
LargestPoint FindLargest(const SpherePoints& points, const Measure& measure, const Backend& backend)
{
  return backend.template Sum<LargestPoint>(points.Count,
    [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i, LargestPoint & sum)
    {
      const std::int32_t id = points.GetId(i);
      const PlanePoint& place = points.Places[id];
      sum += LargestPoint{ measure(place), { id, place } };
    });
}

struct NoMeasure
{
  DELAUNAYFLIP_HOST_DEVICE double operator()(const PlanePoint&) const { return 0.0; }
};

/// Places relative to the first corner of a simplex, at most 1. The measures below need not be
/// exact.
struct SimplexFrame
{
  PlanePoint First;
  double Largest = 1.0;

  /// Halves cannot overflow.
  DELAUNAYFLIP_HOST_DEVICE Vector3 GetOffset(const PlanePoint& p) const
  {
    return { 0.5 * p.U - 0.5 * this->First.U, 0.5 * p.V - 0.5 * this->First.V,
      0.5 * p.W - 0.5 * this->First.W };
  }
  DELAUNAYFLIP_HOST_DEVICE Vector3 GetPlace(const PlanePoint& p) const
  {
    const Vector3 offset = this->GetOffset(p);
    return { offset.X / this->Largest, offset.Y / this->Largest, offset.Z / this->Largest };
  }
};

/// The largest coordinate of an offset.
struct OffsetMeasure
{
  SimplexFrame Frame;

  DELAUNAYFLIP_HOST_DEVICE double operator()(const PlanePoint& p) const
  {
    const Vector3 offset = this->Frame.GetOffset(p);
    return std::max(std::max(std::fabs(offset.X), std::fabs(offset.Y)), std::fabs(offset.Z));
  }
};

struct DistanceMeasure
{
  SimplexFrame Frame;

  DELAUNAYFLIP_HOST_DEVICE double operator()(const PlanePoint& p) const
  {
    const Vector3 place = this->Frame.GetPlace(p);
    return Dot(place, place);
  }
};

/// The distance from an axis.
struct AxisMeasure
{
  SimplexFrame Frame;
  Vector3 Axis;

  DELAUNAYFLIP_HOST_DEVICE double operator()(const PlanePoint& p) const
  {
    const Vector3 normal = Cross(this->Axis, this->Frame.GetPlace(p));
    return Dot(normal, normal);
  }
};

/// The distance from a plane.
struct HeightMeasure
{
  SimplexFrame Frame;
  Vector3 Normal;

  DELAUNAYFLIP_HOST_DEVICE double operator()(const PlanePoint& p) const
  {
    return std::fabs(Dot(this->Normal, this->Frame.GetPlace(p)));
  }
};

/// Larger for points that are not in the line of two points, exactly.
struct OffLineMeasure
{
  PlanePoint A, B;

  DELAUNAYFLIP_HOST_DEVICE double operator()(const PlanePoint& p) const
  {
    return AreOnLine(this->A, this->B, p) ? -1.0 : 0.0;
  }
};

/// Larger for points that are not in the plane of three points, exactly.
struct OffPlaneMeasure
{
  PlanePoint A, B, C;

  DELAUNAYFLIP_HOST_DEVICE double operator()(const PlanePoint& p) const
  {
    return FindOrientation3D(this->A, this->B, this->C, p) == 0 ? -1.0 : 0.0;
  }
};

/// Finds four points that span a large volume. The first one is the farthest north. The first three
/// are counter-clockwise, seen from the side opposite to the fourth. They depend on the places
/// alone.
/// @returns nothing if all points lie in one plane, or so nearly that rounding puts the center of
/// the four points outside.
template <typename Backend>
Simplex FindSimplex(const SpherePoints& points, const Backend& backend)
{
  if (points.Count < 4)
  {
    return {};
  }
  const NumberedPoint north = FindLargest(points, NoMeasure(), backend).Point;
  SimplexFrame frame{ north.Place };
  frame.Largest = FindLargest(points, OffsetMeasure{ frame }, backend).Measure;
  if (!(frame.Largest > 0.0))
  {
    return {};
  }
  const NumberedPoint far = FindLargest(points, DistanceMeasure{ frame }, backend).Point;
  const Vector3 axis = frame.GetPlace(far.Place);
  LargestPoint aside = FindLargest(points, AxisMeasure{ frame, axis }, backend);
  if (AreOnLine(north.Place, far.Place, aside.Point.Place)) // by rounding, or because all are
  {
    aside = FindLargest(points, OffLineMeasure{ north.Place, far.Place }, backend);
  }
  const Vector3 normal = Cross(axis, frame.GetPlace(aside.Point.Place));
  LargestPoint above = FindLargest(points, HeightMeasure{ frame, normal }, backend);
  const OffPlaneMeasure isOff{ north.Place, far.Place, aside.Point.Place };
  if (isOff(above.Point.Place) < 0.0) // by rounding, or because all points lie in one plane
  {
    above = FindLargest(points, isOff, backend);
  }
  return OrientSimplex({ north, far, aside.Point, above.Point });
}

//------------------------------------------------------------------------------
/// The numbers of points in the plane: their ids without that of the pole, which has no place
/// there.
struct PlaneNumbers
{
  std::int32_t Pole;

  DELAUNAYFLIP_HOST_DEVICE std::int32_t GetNumber(std::int32_t id) const
  {
    return id - static_cast<std::int32_t>(id > this->Pole);
  }
  DELAUNAYFLIP_HOST_DEVICE std::int32_t GetId(std::int32_t number) const
  {
    return number + static_cast<std::int32_t>(number >= this->Pole);
  }
};

/// Projects the points that count, except the pole. Each has two coordinates by its number in the
/// plane. Sums up how many of them the projection cannot place.
struct ProjectionStep
{
  SpherePoints Points;
  StereographicProjection Projection;
  PlaneNumbers Numbers;
  double* Places;

  DELAUNAYFLIP_HOST_DEVICE void operator()(std::int64_t i, std::int64_t& unplaced) const
  {
    const std::int32_t id = this->Points.GetId(i);
    if (id == this->Numbers.Pole)
    {
      return;
    }
    double place[2];
    this->Projection.Project(this->Points.Places[id], place);
    const std::int64_t number = this->Numbers.GetNumber(id);
    this->Places[2 * number] = place[0];
    this->Places[2 * number + 1] = place[1];
    unplaced += int(!IsFinite(place[0]) || !IsFinite(place[1]));
  }
};

/// Lists the sides of triangles that have no neighbour, in their order.
template <typename Backend>
std::vector<BoundarySide> ListBoundary(const SphereTriangles& triangles, const Backend& backend)
{
  const std::int32_t* ids = triangles.Ids;
  const std::int32_t* neighbors = triangles.Neighbors;
  const std::int64_t corners = 3 * triangles.Count;
  const auto isOuter = [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t corner)
  { return neighbors[corner] < 0 ? 1 : 0; };
  const typename Backend::Numbering numbering = backend.Count(corners, isOuter);
  Array<BoundarySide> sides = backend.template MakeArray<BoundarySide>(numbering.Total);
  BoundarySide* to = sides.Data();
  backend.ForEachNumbered(numbering, corners, isOuter,
    [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t corner, std::int64_t number)
    {
      if (neighbors[corner] < 0)
      {
        const std::int64_t first = corner - corner % 3;
        to[number] = { static_cast<std::int32_t>(corner), ids[first + (corner + 1) % 3],
          ids[first + (corner + 2) % 3] };
      }
    });
  std::vector<BoundarySide> listed(numbering.Total);
  backend.Download(sides.Data(), numbering.Total, listed.data());
  return listed;
}

//------------------------------------------------------------------------------
/// Points for which filters may not be used, because they are not finite or too large.
struct UnusualStep
{
  SpherePoints Points;

  DELAUNAYFLIP_HOST_DEVICE void operator()(std::int64_t i, std::int64_t& sum) const
  {
    sum += int(!IsInFilterRange3D(this->Points.Places[this->Points.GetId(i)]));
  }
};

/// What StartStep finds.
struct StartSums
{
  std::int64_t Turned = 0; ///< Triangles that a filter does not see to face outside.
  std::int64_t Uncertain = 0; ///< Edges that a filter does not see to be convex.
  AngleSums Angles;

  DELAUNAYFLIP_HOST_DEVICE StartSums& operator+=(const StartSums& part)
  {
    this->Turned += part.Turned;
    this->Uncertain += part.Uncertain;
    this->Angles += part.Angles;
    return *this;
  }
};

/// The plane of a triangle, for tests by a filter.
struct FilteredPlane
{
  PlanePoint From;
  Vector3 Normal; ///< The cross product of two edges.
  Vector3 Largest; ///< By axis, the larger coordinate of both edges.

  DELAUNAYFLIP_HOST_DEVICE FilteredPlane(
    const PlanePoint& a, const PlanePoint& b, const PlanePoint& c)
    : From(a)
  {
    const Vector3 ab = { b.U - a.U, b.V - a.V, b.W - a.W };
    const Vector3 ac = { c.U - a.U, c.V - a.V, c.W - a.W };
    this->Normal = Cross(ab, ac);
    this->Largest = { std::max(std::fabs(ab.X), std::fabs(ac.X)),
      std::max(std::fabs(ab.Y), std::fabs(ac.Y)), std::max(std::fabs(ab.Z), std::fabs(ac.Z)) };
  }

  /// Whether a point is surely on the side from which the triangle is clockwise. All four must be
  /// in the range of IsInFilterRange3D.
  ///
  /// The determinant is a sum of six products of three differences, one along each axis. Rounding
  /// changes each of them by a factor of at most (1 + 2^-53)^8.
  DELAUNAYFLIP_HOST_DEVICE bool IsInside(const PlanePoint& point) const
  {
    constexpr double Bound = 0x1p-47; // more than 6 * 8 * 2^-53
    const Vector3 offset = { this->From.U - point.U, this->From.V - point.V,
      this->From.W - point.W };
    const double product = std::max(this->Largest.X, std::fabs(offset.X)) *
      std::max(this->Largest.Y, std::fabs(offset.Y)) *
      std::max(this->Largest.Z, std::fabs(offset.Z));
    return Dot(this->Normal, offset) > Bound * product;
  }
};

/// Tests by a filter whether triangles face outside and edges are convex, and measures triangles.
struct StartStep
{
  const PlanePoint* Points;
  SphereTriangles Triangles;
  PlanePoint Center;

  DELAUNAYFLIP_HOST_DEVICE void Prefetch(std::int64_t t) const
  {
    for (int slot = 0; slot < 3; ++slot)
    {
      delaunayflip::Prefetch(&this->Points[this->Triangles.Ids[3 * t + slot]]);
    }
  }
  DELAUNAYFLIP_HOST_DEVICE void operator()(std::int64_t t, StartSums& sums) const
  {
    const std::int32_t* ids = this->Triangles.Ids + 3 * t;
    const FilteredPlane plane(this->Points[ids[0]], this->Points[ids[1]], this->Points[ids[2]]);
    sums.Turned += int(!plane.IsInside(this->Center));
    for (int slot = 0; slot < 3; ++slot)
    {
      const std::int32_t across = this->Triangles.Neighbors[3 * t + slot];
      if (across >= 0 && across < t) // each edge once, when both triangles are in the cache
      {
        const std::int32_t* other = this->Triangles.Ids + std::int64_t(3) * across;
        const std::int32_t ends = ids[(slot + 1) % 3] + ids[(slot + 2) % 3];
        const std::int32_t beyond = other[0] + other[1] + other[2] - ends;
        sums.Uncertain += int(!plane.IsInside(this->Points[beyond]));
      }
    }
    sums.Angles.Add(MeasureTriangle(this->Points, ids));
  }
};

}

#endif
