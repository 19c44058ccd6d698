// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_MESHSURVEYBUILDER_H
#define DELAUNAYFLIP_MESHSURVEYBUILDER_H

#include "Atomics.h"
#include "FlipError.h"
#include "GeometryChoice.h"
#include "InputChecks.h"
#include "MeshSurvey.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>

/// @file
/// Makes a MeshSurvey on a backend.

namespace delaunayflip
{

using PointIds = std::array<std::int64_t, 3>;

[[noreturn]] inline void ThrowInvalidId(
  const PointIds& ids, std::int64_t triangle, std::int64_t points)
{
  const std::int64_t id =
    *std::find_if(ids.begin(), ids.end(), [=](std::int64_t p) { return p < 0 || p >= points; });
  throw InvalidMesh("triangle " + std::to_string(triangle) + " names point " + std::to_string(id) +
      ", but the mesh has " + DescribePoints(points) + "; repair the file or remove the triangle",
    triangle, id);
}

struct IdSurvey
{
  IdSample Invalid; ///< Triangles that name a point that does not exist.
  IdSample Repeated;

  DELAUNAYFLIP_HOST_DEVICE IdSurvey& operator+=(const IdSurvey& part)
  {
    this->Invalid += part.Invalid;
    this->Repeated += part.Repeated;
    return *this;
  }
};

/// Bounding box and counts of the used points.
struct PointSurvey : BoundingBox
{
  double Smallest = INFINITY; ///< Magnitude of a coordinate that is not 0.
  std::int64_t Used = 0;
  IdSample NonFinite;

  DELAUNAYFLIP_HOST_DEVICE void Note(int axis, double x)
  {
    this->Include(axis, x, x);
    this->IncludeMagnitude(std::fabs(x));
  }
  DELAUNAYFLIP_HOST_DEVICE void IncludeMagnitude(double magnitude)
  {
    if (magnitude > 0.0 && magnitude < this->Smallest)
    {
      this->Smallest = magnitude;
    }
  }

  DELAUNAYFLIP_HOST_DEVICE PointSurvey& operator+=(const PointSurvey& part)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Include(axis, part.Lower[axis], part.Upper[axis]);
    }
    this->IncludeMagnitude(part.Smallest);
    this->Used += part.Used;
    this->NonFinite += part.NonFinite;
    return *this;
  }
};

/// Finds the range of the coordinates, and what follows from it.
inline void ResolveRange(MeshSurvey& survey)
{
  double largest = 0.0;
  for (int axis = 0; axis < CountAxes(survey.Geometry); ++axis)
  {
    largest =
      std::max({ largest, std::fabs(survey.Box.Lower[axis]), std::fabs(survey.Box.Upper[axis]) });
  }
  survey.FiltersApply = largest <= LargestFilteredDifference / 2;
  constexpr int UsualExponent = 100;
  if (largest > 0.0 && std::abs(std::ilogb(largest)) > UsualExponent)
  {
    survey.Range = CoordinateRange::Extreme;
  }
  else if (survey.SmallestMagnitude < std::ldexp(1.0, -UsualExponent))
  {
    survey.Range = CoordinateRange::Mixed;
  }
}

template <typename Backend>
void SurveyTriangleIds(MeshSurvey& survey, const MeshInput& input, const Backend& backend)
{
  const TriangleMesh mesh = input.Local;
  PointUse* uses = survey.Uses.Data();
  backend.ForEach(mesh.Points.Count,
    [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i) { uses[i] = PointUse::Unused; });
  const IdSurvey ids = backend.template Sum<IdSurvey>(mesh.Triangles.Count,
    [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t t, IdSurvey & sum)
    {
      const std::int64_t p[3] = { mesh.Triangles.Get(t, 0), mesh.Triangles.Get(t, 1),
        mesh.Triangles.Get(t, 2) };
      const std::int64_t count = mesh.Points.Count;
      if (p[0] < 0 || p[0] >= count || p[1] < 0 || p[1] >= count || p[2] < 0 || p[2] >= count)
      {
        sum.Invalid.Note(t);
        return;
      }
      for (const std::int64_t point : p)
      {
        // Most points are marked already, and a load costs less than a store.
        if (AtomicLoad(&uses[point]) != PointUse::Used)
        {
          AtomicStore(&uses[point], PointUse::Used);
        }
      }
      if (p[0] == p[1] || p[1] == p[2] || p[2] == p[0])
      {
        sum.Repeated.Note(t);
      }
    });
  if (ids.Invalid.Count > 0)
  {
    const std::int64_t first = ids.Invalid.Smallest[0];
    PointIds given; // as the caller gave them: a backend may have narrowed its own
    for (int slot = 0; slot < 3; ++slot)
    {
      if (input.IsOnHost)
      {
        given[slot] = input.Caller.Triangles.Get(first, slot);
        continue;
      }
      given[slot] = backend.template Sum<std::int64_t>(1,
        [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t, std::int64_t & sum)
        { sum += mesh.Triangles.Get(first, slot); });
    }
    ThrowInvalidId(given, first, mesh.Points.Count);
  }
  survey.RepeatedIds = MakeDefect(DefectKind::RepeatedIds, ids.Repeated);
}

/// @param geometry decides which coordinates matter.
template <typename Backend>
void SurveyPoints(
  MeshSurvey& survey, const MeshInput& input, GeometryKind geometry, const Backend& backend)
{
  const PointArray array = input.Local.Points;
  PointUse* uses = survey.Uses.Data();
  const PointSurvey points = backend.template Sum<PointSurvey>(array.Count,
    [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i, PointSurvey & sum)
    {
      if (uses[i] == PointUse::Unused)
      {
        return;
      }
      ++sum.Used;
      uses[i] = IsFinitePoint(array, i, geometry) ? PointUse::Used : PointUse::NotFinite;
      if (uses[i] == PointUse::NotFinite)
      {
        sum.NonFinite.Note(i);
        return;
      }
      for (int axis = 0; axis < 3; ++axis)
      {
        sum.Note(axis, array.Get(i, axis));
      }
    });
  survey.Precision = input.Caller.Points.Floats ? FloatPrecision : DoublePrecision;
  survey.UsedPoints = points.Used;
  survey.NonFinitePoints = MakeDefect(DefectKind::PointsNotFinite, points.NonFinite);
  if (points.Used > points.NonFinite.Count)
  {
    survey.Box = points;
    survey.SmallestMagnitude = points.Smallest;
  }
}

/// All but the ids of triangles, when it is known which points are used.
template <typename Backend>
void SurveyPointsAndGeometry(
  MeshSurvey& survey, const MeshInput& input, GeometryKind requested, const Backend& backend)
{
  SurveyPoints(survey, input, requested, backend);
  GeometryChoice<Backend>(input, survey, backend).Choose(requested);
  if (survey.Geometry != requested && survey.Geometry == GeometryKind::PlanarXY &&
    survey.NonFinitePoints.Count > 0)
  {
    SurveyPoints(survey, input, survey.Geometry, backend); // z no longer matters
  }
  ResolveRange(survey);
}

/// @throws InvalidMesh for an id that is not a point; InvalidOptions for GeometryKind::Planar if
/// the points lie in no plane.
template <typename Backend>
MeshSurvey BuildMeshSurvey(const MeshInput& input, GeometryKind requested, const Backend& backend)
{
  MeshSurvey survey;
  survey.Uses = backend.template MakeArray<PointUse>(input.Local.Points.Count);
  SurveyTriangleIds(survey, input, backend);
  SurveyPointsAndGeometry(survey, input, requested, backend);
  return survey;
}

}

#endif
