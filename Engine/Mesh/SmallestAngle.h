// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_SMALLESTANGLE_H
#define DELAUNAYFLIP_SMALLESTANGLE_H

#include "EdgeMesh.h"
#include "FilteredPredicates.h"
#include "FlipReport.h"
#include "HostDevice.h"
#include "MeshSurvey.h"
#include "SpatialOrder.h"
#include "SurfaceAngles.h"
#include "TriangleMesh.h"
#include "WideAngles.h"

#include <cmath>
#include <cstdint>
#include <limits>

/// @file
/// The smallest angles of triangles: the smallest of a whole mesh and how many are small, exactly
/// the same on every backend; and that of each triangle. The latter is measured by an arctangent,
/// which is rounded differently on a GPU, so the last digits may differ; no decision depends on
/// them.

namespace delaunayflip
{

/// A maximum, with operator+= so that Sum can compute it.
struct LargestValue
{
  double Value = -INFINITY;

  DELAUNAYFLIP_HOST_DEVICE LargestValue& operator+=(const LargestValue& other)
  {
    this->Value = std::max(this->Value, other.Value);
    return *this;
  }
};

/// LargestSquaredCotangent (SurfaceAngles.h) of a triangle.
DELAUNAYFLIP_HOST_DEVICE inline double MeasureSquaredCotangent(
  const Vector3& a, const Vector3& b, const Vector3& c, CoordinateRange range)
{
  const double largest = LargestSquaredCotangent(a, b, c);
  // A triangle seems to have no area also if the squares of its lengths vanish.
  if (largest == INFINITY || IsWide(range, a, b, c))
  {
    return LargestSquaredCotangentWide(a, b, c);
  }
  return largest;
}

inline void KeepAnglesBefore(const AngleSums& angles, FlipReport& report)
{
  report.MinimumAngleBefore = ToDegrees(angles.Largest);
  report.TrianglesBelow10Before = angles.Below10;
  report.TrianglesBelow20Before = angles.Below20;
  report.TrianglesBelow30Before = angles.Below30;
}

inline void KeepAnglesAfter(const AngleSums& angles, FlipReport& report)
{
  report.MinimumAngleAfter = ToDegrees(angles.Largest);
  report.TrianglesBelow10After = angles.Below10;
  report.TrianglesBelow20After = angles.Below20;
  report.TrianglesBelow30After = angles.Below30;
}

/// Measures the angles of triangles in the coordinates of a rule.
template <typename Rule>
struct AngleSurvey
{
  const TriangleRecord* Triangles;
  Rule Decision;
  CoordinateRange Range;

  DELAUNAYFLIP_HOST_DEVICE void Prefetch(std::int64_t t) const
  {
    for (const VertexId vertex : this->Triangles[t].Vertices)
    {
      delaunayflip::Prefetch(this->Decision.Address(vertex));
    }
  }
  DELAUNAYFLIP_HOST_DEVICE void operator()(std::int64_t t, AngleSums& sum) const
  {
    sum.Add(this->Measure(t));
  }
  DELAUNAYFLIP_HOST_DEVICE double Measure(std::int64_t t) const
  {
    const VertexId* v = this->Triangles[t].Vertices;
    const Vector3 a = ToPosition(this->Decision.Get(v[0]));
    const Vector3 b = ToPosition(this->Decision.Get(v[1]));
    const Vector3 c = ToPosition(this->Decision.Get(v[2]));
    return MeasureSquaredCotangent(a, b, c, this->Range);
  }

private:
  DELAUNAYFLIP_HOST_DEVICE static Vector3 ToPosition(const Vector3& point) { return point; }
  DELAUNAYFLIP_HOST_DEVICE static Vector3 ToPosition(const PlanePoint& point)
  {
    return { point.U, point.V, point.W };
  }
};

/// Measures triangles beside fixed edges that would flip if they were free.
struct KeptEdgeSurvey
{
  EdgeMeshView Mesh;
  PackedPointsView Points;
  CoordinateRange Range;

  DELAUNAYFLIP_HOST_DEVICE void operator()(std::int64_t e, LargestValue& sum) const
  {
    const CornerPair corners = this->Mesh.GetCorners(static_cast<EdgeId>(e));
    if (this->Mesh.States[e] != EdgeState::Fixed || corners.B == NoCorner)
    {
      return;
    }
    // Most edges are decided by arithmetic that is not exact.
    constexpr double SquaredCotangentOfSlivers = 130.0; // a little more than five degrees
    const double atA = this->Measure(TriangleOf(corners.A));
    const double atB = this->Measure(TriangleOf(corners.B));
    const double atWorst = std::max(atB, atA);
    if (!(atWorst > SquaredCotangentOfSlivers && atA > -INFINITY && atB > -INFINITY))
    {
      return;
    }
    const Quad quad = this->Mesh.GetQuad(corners);
    const TriangleRecord& other = this->Mesh.Triangles[TriangleOf(corners.B)];
    const bool isWound = GetAt(other.Vertices, NextSlot(SlotOf(corners.B))) == quad.Q;
    const QuadPoints points = { this->Points.GetPosition(quad.A), this->Points.GetPosition(quad.P),
      this->Points.GetPosition(quad.Q), this->Points.GetPosition(quad.B) };
    if (isWound && SumWide(WideLegs(points)).ExceedsPi({}))
    {
      sum += { atWorst };
    }
  }

  DELAUNAYFLIP_HOST_DEVICE double Measure(std::int64_t t) const
  {
    const VertexId* v = this->Mesh.Triangles[t].Vertices;
    return MeasureSquaredCotangent(this->Points.GetPosition(v[0]), this->Points.GetPosition(v[1]),
      this->Points.GetPosition(v[2]), this->Range);
  }
};

/// Whether one of the ten triangles with the smallest angles is a sliver that a fixed edge keeps:
/// it has an angle below five degrees, and an edge that would flip if it were free.
/// @param largest the largest squared cotangent of all triangles.
template <typename Backend>
bool KeepsWorstSliver(EdgeMesh& mesh, const PackedPoints& points, CoordinateRange range,
  double largest, const Backend& backend)
{
  constexpr std::int64_t Worst = 10;
  constexpr double SliverAngle = 5.0;
  const KeptEdgeSurvey survey{ mesh.View(), points.View(), range };
  const double kept = backend.template Sum<LargestValue>(mesh.NumberOfEdges, survey).Value;
  return ToDegrees(kept) < SliverAngle &&
    (kept == largest ||
      backend.template Sum<std::int64_t>(mesh.NumberOfTriangles,
        [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t t, std::int64_t & worse)
        { worse += int(survey.Measure(t) > kept); }) < Worst);
}

/// The smallest angle of triangle t of a mesh, in degrees; NaN if a coordinate is not finite or a
/// point does not exist.
DELAUNAYFLIP_HOST_DEVICE inline double FindSmallestAngle(
  const TriangleMesh& mesh, GeometryKind geometry, std::int64_t t)
{
  const std::int64_t ids[3] = { mesh.Triangles.Get(t, 0), mesh.Triangles.Get(t, 1),
    mesh.Triangles.Get(t, 2) };
  for (const std::int64_t id : ids)
  {
    if (id < 0 || id >= mesh.Points.Count || !IsFinitePoint(mesh.Points, id, geometry))
    {
      return std::numeric_limits<double>::quiet_NaN();
    }
  }
  double x[3][3] = {};
  LoadScaledOffsets(mesh.Points, ids, 3, CountAxes(geometry), x);
  // Products of edges are cotangents times twice the area: the largest is at the smallest angle.
  double largest = -INFINITY;
  Vector3 first, second; // the edges there
  for (int slot = 0; slot < 3; ++slot)
  {
    const auto edgeTo = [&](int end) {
      return Vector3{ x[end][0] - x[slot][0], x[end][1] - x[slot][1], x[end][2] - x[slot][2] };
    };
    const Vector3 next = edgeTo((slot + 1) % 3), last = edgeTo((slot + 2) % 3);
    if (Dot(next, last) > largest)
    {
      largest = Dot(next, last);
      first = next;
      second = last;
    }
  }
  return std::atan2(Length(Cross(first, second)), largest) / DegreesToRadians;
}

}

#endif
