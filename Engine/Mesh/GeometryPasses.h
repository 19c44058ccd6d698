// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_GEOMETRYPASSES_H
#define DELAUNAYFLIP_GEOMETRYPASSES_H

#include "Atomics.h"
#include "ExactPredicates.h"
#include "FilteredPredicates.h"
#include "HostDevice.h"
#include "MeshSurvey.h"
#include "SpatialOrder.h"
#include "SurfaceAngles.h"
#include "TriangleMesh.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

/// @file
/// What is measured of points and triangles before a geometry is chosen (GeometryChoice.h): how far
/// points are from a plane, how triangles are oriented in x and y, how steep they are, and how
/// often they wind around a point. One text for both backends.

namespace delaunayflip
{

/// Scales by a power of two, in two steps, so that the largest coordinate is in 1 .. 2 and lengths
/// neither overflow nor vanish. All backends scale alike.
struct PlaneScale
{
  double Factors[2] = { 1.0, 1.0 }; ///< Their product may be beyond the range of double.

  DELAUNAYFLIP_HOST_DEVICE Vector3 operator()(const Vector3& p) const
  {
    return this->Factors[1] * (this->Factors[0] * p);
  }

  double FindDiagonal(const BoundingBox& box) const
  {
    return Length((*this)({ box.Upper[0], box.Upper[1], box.Upper[2] }) -
      (*this)({ box.Lower[0], box.Lower[1], box.Lower[2] }));
  }
};

/// Points closer to a plane than this share of the bounding box's diagonal lie in it.
constexpr double PlanarTolerance = 1e-6;

/// A point, its scaled position, and a value to be maximised; the first of equals wins.
struct Farthest
{
  std::int64_t Point = -1;
  double Value = -1.0;
  Vector3 Position;

  DELAUNAYFLIP_HOST_DEVICE Farthest& operator+=(const Farthest& other)
  {
    const bool first = other.Value == this->Value && other.Point < this->Point;
    if (other.Value > this->Value || first)
    {
      *this = other;
    }
    return *this;
  }
};

/// The orientation of a, b, c in x and y. It is also 0 if the filter finds almost no area and
/// fixed-point integers do not suffice, because a device has no wider ones.
DELAUNAYFLIP_HOST_DEVICE inline int FindOrientationXY(
  const Vector3& a, const Vector3& b, const Vector3& c)
{
  const PlanePoint p{ a.X, a.Y, 0.0 }, q{ b.X, b.Y, 0.0 }, r{ c.X, c.Y, 0.0 };
  int sign = FilteredOrientation(p, q, r);
  if (sign == UncertainSign)
  {
    sign = FixedPointOrientation(p, q, r);
  }
  if (sign == UncertainSign)
  {
    return 0;
  }
  return sign;
}

/// Whether a triangle slopes below 45 degrees: its plane or, of a sliver, its three edges. A sliver
/// is less than a fifth as high as its longest edge is long.
///
/// An edge joins two points of the terrain, so its slope is one that the terrain has. The plane of
/// a sliver may be steep in the gentlest terrain.
/// @param normal of length twice the area.
DELAUNAYFLIP_HOST_DEVICE inline bool IsGentle(const Vector3 (&corners)[3], const Vector3& normal)
{
  if (normal.Z * normal.Z > normal.X * normal.X + normal.Y * normal.Y)
  {
    return true;
  }
  constexpr double Fifth = 0.2;
  const double squaredArea = Dot(normal, normal);
  bool isSliver = false;
  bool areEdgesGentle = true;
  for (int slot = 0; slot < 3; ++slot)
  {
    const Vector3 edge = corners[(slot + 1) % 3] - corners[slot];
    const double square = Dot(edge, edge);
    // There are no branches, because they could not be predicted.
    isSliver |= squaredArea < Fifth * Fifth * square * square;
    areEdgesGentle &= edge.Z * edge.Z < edge.X * edge.X + edge.Y * edge.Y;
  }
  return isSliver && areEdgesGentle;
}

struct OrientationSums
{
  OrientationSample Orientations; ///< In x and y.
  /// Area in space, in units of 2^-60: of all triangles, and of those that slope below 45 degrees.
  Integer128 All = 0, Gentle = 0;

  DELAUNAYFLIP_HOST_DEVICE OrientationSums& operator+=(const OrientationSums& part)
  {
    this->Orientations += part.Orientations;
    this->All += part.All;
    this->Gentle += part.Gentle;
    return *this;
  }
};

/// The finite triangles of the caller, scaled.
struct ScaledTriangles
{
  TriangleMesh Mesh;
  const PointUse* Uses; ///< Null: all points are finite.
  PlaneScale Scale; ///< Brings coordinates near 1, where the filters apply.

  DELAUNAYFLIP_HOST_DEVICE void Prefetch(std::int64_t t) const
  {
    for (int slot = 0; slot < 3; ++slot)
    {
      this->Mesh.Points.Prefetch(this->Mesh.Triangles.Get(t, slot));
    }
  }

  DELAUNAYFLIP_HOST_DEVICE bool IsFinite(std::int64_t t) const
  {
    return !this->Uses ||
      (this->Uses[this->Mesh.Triangles.Get(t, 0)] == PointUse::Used &&
        this->Uses[this->Mesh.Triangles.Get(t, 1)] == PointUse::Used &&
        this->Uses[this->Mesh.Triangles.Get(t, 2)] == PointUse::Used);
  }

  DELAUNAYFLIP_HOST_DEVICE Vector3 GetCorner(std::int64_t t, int slot) const
  {
    return this->Scale(LoadPoint(this->Mesh.Points, this->Mesh.Triangles.Get(t, slot)));
  }
};

/// Adds up the orientation, area and slope of a triangle.
struct OrientationStep
{
  ScaledTriangles Triangles;
  double Factor; ///< Power of two that brings the scaled bounding box's diagonal to 1 .. 2.
  int Up = 2; ///< The axis of heights, in the place of z.
  std::int64_t Stride = 1; ///< Every how many triangles one is taken.

  DELAUNAYFLIP_HOST_DEVICE void Prefetch(std::int64_t i) const
  {
    this->Triangles.Prefetch(i * this->Stride);
  }

  DELAUNAYFLIP_HOST_DEVICE void operator()(std::int64_t i, OrientationSums& sums) const
  {
    const std::int64_t t = i * this->Stride;
    if (!this->Triangles.IsFinite(t))
    {
      return;
    }
    const Vector3 corners[3] = { this->GetCorner(t, 0), this->GetCorner(t, 1),
      this->GetCorner(t, 2) };
    sums.Orientations.Note(FindOrientationXY(corners[0], corners[1], corners[2]), t);
    const Vector3 normal = AreaVector(corners[0], corners[1], corners[2]);
    const double area = Length(normal) * this->Factor * this->Factor; // below 4
    const auto units = static_cast<std::int64_t>(0x1p60 * area);
    sums.All += units;
    if (IsGentle(corners, normal))
    {
      sums.Gentle += units;
    }
  }

private:
  DELAUNAYFLIP_HOST_DEVICE Vector3 GetCorner(std::int64_t t, int slot) const
  {
    const Vector3 p = this->Triangles.GetCorner(t, slot);
    if (this->Up == 2)
    {
      return p;
    }
    if (this->Up == 1)
    {
      return { p.Z, p.X, p.Y };
    }
    return { p.Y, p.Z, p.X };
  }
};

/// Adds the angles of a triangle's corners, in x and y, to the sums of its points.
///
/// An angle is the difference of two directions. The two triangles of an edge compute the same
/// number for its direction. So the angles around an inner point add up exactly to a whole number
/// of circles; at the boundary, to within the rounding of two directions. Clockwise triangles count
/// as negative.
struct StarStep
{
  static constexpr std::uint32_t QuarterCircle = 1u << 22;
  static constexpr std::uint32_t FullCircle = 4 * QuarterCircle;

  ScaledTriangles Triangles;
  std::uint32_t* Angles; ///< One sum per point, modulo 2^32, for stars of up to 128 circles.

  DELAUNAYFLIP_HOST_DEVICE void Prefetch(std::int64_t t) const
  {
    this->Triangles.Prefetch(t);
    for (int slot = 0; slot < 3; ++slot)
    {
      delaunayflip::Prefetch(&this->Angles[this->Triangles.Mesh.Triangles.Get(t, slot)]);
    }
  }

  DELAUNAYFLIP_HOST_DEVICE void operator()(std::int64_t t) const
  {
    if (!this->Triangles.IsFinite(t))
    {
      return;
    }
    const Vector3 a = this->Triangles.GetCorner(t, 0);
    const Vector3 b = this->Triangles.GetCorner(t, 1);
    const Vector3 c = this->Triangles.GetCorner(t, 2);
    const int orientation = FindOrientationXY(a, b, c);
    if (orientation == 0)
    {
      return;
    }
    const std::uint32_t directions[3] = { FindDirection(a, b), FindDirection(b, c),
      FindDirection(c, a) };
    for (int slot = 0; slot < 3; ++slot)
    {
      AtomicAdd(&this->Angles[this->Triangles.Mesh.Triangles.Get(t, slot)],
        FindAngle(directions[slot], directions[(slot + 2) % 3], orientation));
    }
  }

private:
  /// From 0 (along x) to FullCircle, increasing with the angle. The directions from a to b and from
  /// b to a differ by exactly half a circle.
  DELAUNAYFLIP_HOST_DEVICE static std::uint32_t FindDirection(const Vector3& a, const Vector3& b)
  {
    const double x = b.X - a.X;
    const double y = b.Y - a.Y;
    const double sum = std::fabs(x) + std::fabs(y);
    if (!(sum > 0.0))
    {
      return 0;
    }
    const auto fromAxis = static_cast<std::uint32_t>(QuarterCircle * (std::fabs(y) / sum));
    if (y >= 0.0)
    {
      return x >= 0.0 ? fromAxis : 2 * QuarterCircle - fromAxis;
    }
    return x < 0.0 ? 2 * QuarterCircle + fromAxis : FullCircle - fromAxis;
  }

  /// The angle of a corner, from the directions to the next point and from the previous one: up to
  /// half a circle, with the sign of the orientation. Rounding may exceed this range a little.
  DELAUNAYFLIP_HOST_DEVICE static std::uint32_t FindAngle(
    std::uint32_t toNext, std::uint32_t fromPrevious, int orientation)
  {
    const std::uint32_t angle = (fromPrevious + 2 * QuarterCircle - toNext) & (FullCircle - 1);
    const std::uint32_t most = orientation > 0 ? 3 * QuarterCircle : QuarterCircle;
    return angle < most ? angle : angle - FullCircle;
  }
};

}

#endif
