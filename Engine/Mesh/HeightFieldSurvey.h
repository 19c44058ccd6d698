// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_HEIGHTFIELDSURVEY_H
#define DELAUNAYFLIP_HEIGHTFIELDSURVEY_H

#include "Array.h"
#include "Atomics.h"
#include "Defects.h"
#include "ExactPredicates.h"
#include "HostDevice.h"
#include "MeshSurvey.h"
#include "PlaneScale.h"
#include "SurfaceAngles.h"
#include "TriangleMesh.h"
#include "Vector3.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

/// @file
/// Whether a mesh is a height field over x and y, and how steep it is. Decided before edges are
/// known. Only integers are summed, so that both backends come to the same answer.

namespace delaunayflip
{

/// The turn of a, b, c in x and y. Also 0 if the filter finds almost no area and fixed-point
/// integers do not suffice, because a device has no wider ones.
DELAUNAYFLIP_HOST_DEVICE inline int FindTurn(const Vector3& a, const Vector3& b, const Vector3& c)
{
  const PlanePoint p{ a.X, a.Y, 0.0 }, q{ b.X, b.Y, 0.0 }, r{ c.X, c.Y, 0.0 };
  int sign = FilteredOrientation(p, q, r);
  if (sign == UncertainSign)
  {
    sign = FixedPointOrientation(p, q, r);
  }
  return sign == UncertainSign ? 0 : sign;
}

/// Whether a triangle slopes below 45 degrees: its plane or, of a sliver, its three edges. A sliver
/// is less than a fifth as high as its longest edge is long.
///
/// An edge joins two points of the terrain, so its slope is one that the terrain has. The plane of
/// a sliver may be steep in the gentlest terrain.
/// @param normal of length twice the area.
DELAUNAYFLIP_HOST_DEVICE inline bool IsGentle(const Vector3 (&corners)[3], const Vector3& normal)
{
  constexpr double Fifth = 0.2;
  const double squaredArea = Dot(normal, normal);
  bool isSliver = false;
  bool areEdgesGentle = true;
  for (int slot = 0; slot < 3; ++slot)
  {
    const Vector3 edge = corners[(slot + 1) % 3] - corners[slot];
    const double square = Dot(edge, edge);
    isSliver = isSliver || squaredArea < Fifth * Fifth * square * square;
    areEdgesGentle = areEdgesGentle && edge.Z * edge.Z < edge.X * edge.X + edge.Y * edge.Y;
  }
  const bool isPlaneGentle = normal.Z * normal.Z > normal.X * normal.X + normal.Y * normal.Y;
  return isPlaneGentle || (isSliver && areEdgesGentle);
}

/// A sum of areas in units of 2^-60, in two words so that a billion of them fit.
struct AreaSum
{
  static constexpr int LowBits = 30;

  std::int64_t High = 0;
  std::int64_t Low = 0;

  /// @param area below 4.
  DELAUNAYFLIP_HOST_DEVICE void Add(double area)
  {
    constexpr double Units = 1152921504606846976.0; // 2^60
    const auto units = static_cast<std::int64_t>(Units * area);
    this->High += units >> LowBits;
    this->Low += units & ((std::int64_t(1) << LowBits) - 1);
  }

  DELAUNAYFLIP_HOST_DEVICE AreaSum& operator+=(const AreaSum& part)
  {
    this->High += part.High;
    this->Low += part.Low;
    return *this;
  }

  Integer128 Get() const { return (Integer128(this->High) << LowBits) + this->Low; }
};

struct TurnSums
{
  IdSample Left, Right, Flat; ///< Triangles by their turn in x and y.
  AreaSum All, Gentle; ///< Area in space: of all, and of those that slope below 45 degrees.

  DELAUNAYFLIP_HOST_DEVICE TurnSums& operator+=(const TurnSums& part)
  {
    this->Left += part.Left;
    this->Right += part.Right;
    this->Flat += part.Flat;
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
    const std::int64_t point = this->Mesh.Triangles.Get(t, slot);
    const PointArray& points = this->Mesh.Points;
    return this->Scale(points.Get(point, 0), points.Get(point, 1), points.Get(point, 2));
  }
};

/// Adds up the turn, area and slope of a triangle.
struct TurnStep
{
  ScaledTriangles Triangles;
  double Factor; ///< Power of two that brings the scaled bounding box's diagonal to 1 .. 2.

  DELAUNAYFLIP_HOST_DEVICE void Prefetch(std::int64_t t) const { this->Triangles.Prefetch(t); }

  DELAUNAYFLIP_HOST_DEVICE void operator()(std::int64_t t, TurnSums& sums) const
  {
    if (!this->Triangles.IsFinite(t))
    {
      return;
    }
    const Vector3 corners[3] = { this->Triangles.GetCorner(t, 0), this->Triangles.GetCorner(t, 1),
      this->Triangles.GetCorner(t, 2) };
    const int turn = FindTurn(corners[0], corners[1], corners[2]);
    (turn == 0 ? sums.Flat : (turn > 0 ? sums.Left : sums.Right)).Note(t);
    const Vector3 normal = AreaVector(corners[0], corners[1], corners[2]);
    const double area = Length(normal) * this->Factor * this->Factor;
    sums.All.Add(area);
    if (IsGentle(corners, normal))
    {
      sums.Gentle.Add(area);
    }
  }
};

/// Adds the angles of a triangle's corners, in x and y, to the sums of its points.
///
/// An angle is the difference of two directions. Both triangles of an edge compute the same number
/// for its direction. So the angles around an inner point add up exactly to a whole number of
/// turns; at the boundary, to within the rounding of two directions. Triangles that are turned over
/// count as negative.
struct StarStep
{
  static constexpr std::uint32_t QuarterTurn = 1u << 22;
  static constexpr std::uint32_t FullTurn = 4 * QuarterTurn;

  ScaledTriangles Triangles;
  std::uint32_t* Angles; ///< One sum per point, modulo 2^32, for stars of up to 128 turns.

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
    const int turn = FindTurn(a, b, c);
    if (turn == 0)
    {
      return;
    }
    const std::uint32_t ab = FindDirection(a, b);
    const std::uint32_t bc = FindDirection(b, c);
    const std::uint32_t ca = FindDirection(c, a);
    this->AddAngle(t, 0, FindAngle(ab, ca, turn));
    this->AddAngle(t, 1, FindAngle(bc, ab, turn));
    this->AddAngle(t, 2, FindAngle(ca, bc, turn));
  }

private:
  /// From 0 (along x) to FullTurn, increasing with the angle. The directions from a to b and from b
  /// to a differ by exactly half a turn.
  DELAUNAYFLIP_HOST_DEVICE static std::uint32_t FindDirection(const Vector3& a, const Vector3& b)
  {
    const double x = b.X - a.X;
    const double y = b.Y - a.Y;
    const double sum = std::fabs(x) + std::fabs(y);
    const double share = sum > 0.0 ? std::fabs(y) / sum : 0.0;
    const auto part = static_cast<std::uint32_t>(QuarterTurn * share);
    if (y >= 0.0)
    {
      return x >= 0.0 ? part : 2 * QuarterTurn - part;
    }
    return x < 0.0 ? 2 * QuarterTurn + part : FullTurn - part;
  }

  /// The angle of a corner, from the directions to the next point and from the previous one: up to
  /// half a turn, to the side to which the triangle turns. Rounding may exceed this range a little.
  DELAUNAYFLIP_HOST_DEVICE static std::uint32_t FindAngle(
    std::uint32_t toNext, std::uint32_t fromPrevious, int turn)
  {
    const std::uint32_t angle = (fromPrevious + 2 * QuarterTurn - toNext) & (FullTurn - 1);
    const std::uint32_t most = turn > 0 ? 3 * QuarterTurn : QuarterTurn;
    return angle < most ? angle : angle - FullTurn;
  }

  DELAUNAYFLIP_HOST_DEVICE void AddAngle(std::int64_t t, int slot, std::uint32_t angle) const
  {
    AtomicAdd(&this->Angles[this->Triangles.Mesh.Triangles.Get(t, slot)], angle);
  }
};

/// Where a backend knows only a piece of the mesh, an overload adds what other pieces have summed
/// at the points that they share with this one.
template <typename Backend>
void JoinPointSums(const Backend&, std::uint32_t*)
{
}

/// Finds how triangles turn, then whether stars overlap, on a backend.
template <typename Backend>
class HeightFieldSurvey
{
public:
  HeightFieldSurvey(const MeshInput& input, const MeshSurvey& survey, const Backend& backend)
    : Triangles{ input.Local, survey.NonFinitePoints.Count == 0 ? nullptr : survey.Uses.Data(),
        PlaneScale(survey.Box) },
      Engine(backend)
  {
    const BoundingBox& box = survey.Box;
    const Vector3 diagonal = this->Triangles.Scale(box.Upper[0], box.Upper[1], box.Upper[2]) -
      this->Triangles.Scale(box.Lower[0], box.Lower[1], box.Lower[2]);
    // The square of the factor must not overflow; areas in smaller boxes vanish anyway.
    constexpr int SmallestExponent = -500;
    const double length = Length(diagonal);
    this->Factor =
      length > 0.0 ? std::scalbn(1.0, -std::max(std::ilogb(length), SmallestExponent)) : 1.0;
  }

  TurnSums SumTurns() const
  {
    return this->Engine.template Sum<TurnSums>(
      this->Triangles.Mesh.Triangles.Count, TurnStep{ this->Triangles, this->Factor });
  }

  /// The points around which triangles turn more than once.
  /// @param side the side to which most triangles turn.
  IdSample FindOverlaps(int side) const
  {
    // At both ends of an open fan, directions are rounded.
    constexpr std::int64_t Slack = 8;
    const std::int64_t points = this->Triangles.Mesh.Points.Count;
    Array<std::uint32_t> angles = this->Engine.template MakeArray<std::uint32_t>(points);
    std::uint32_t* angleOfPoint = angles.Data();
    this->Engine.ForEach(
      points, [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i) { angleOfPoint[i] = 0; });
    this->Engine.ForEach(
      this->Triangles.Mesh.Triangles.Count, StarStep{ this->Triangles, angleOfPoint });
    JoinPointSums(this->Engine, angleOfPoint);
    return this->Engine.template Sum<IdSample>(points,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i, IdSample & sum)
      {
        const std::int64_t angle = static_cast<std::int32_t>(angleOfPoint[i]);
        if (side * angle > StarStep::FullTurn + Slack)
        {
          sum.Note(i);
        }
      });
  }

private:
  ScaledTriangles Triangles;
  const Backend& Engine;
  double Factor;
};

}

#endif
