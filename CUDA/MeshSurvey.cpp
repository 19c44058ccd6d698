// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "MeshSurvey.h"

#include "FlipError.h"
#include "PlaneFinder.h"

#include <cmath>
#include <limits>

namespace delaunayflip
{

namespace
{
constexpr std::size_t FirstIdsKept = 3;

[[noreturn]] void ThrowInvalidId(const TriangleMesh& mesh, std::int64_t triangle)
{
  std::int64_t id = 0;
  for (int slot = 2; slot >= 0; --slot)
  {
    const std::int64_t candidate = mesh.Triangles.Get(triangle, slot);
    if (candidate < 0 || candidate >= mesh.Points.Count)
    {
      id = candidate;
    }
  }
  throw InvalidMesh("triangle " + std::to_string(triangle) + " names point " + std::to_string(id) +
      ", but the mesh has points 0 to " + std::to_string(mesh.Points.Count - 1) +
      "; repair the file or remove the triangle",
    triangle, id);
}

/// Smallest triangle with an invalid id, or -1; smallest because pieces are summed in order.
struct IdSurvey
{
  std::int64_t FirstInvalid = -1;
  Defect Repeated;

  IdSurvey& operator+=(const IdSurvey& part)
  {
    this->FirstInvalid = this->FirstInvalid < 0 ? part.FirstInvalid : this->FirstInvalid;
    this->Repeated += part.Repeated;
    return *this;
  }
};

IdSurvey SurveyIds(
  const TriangleMesh& mesh, Array<PointUse>& uses, std::int64_t begin, std::int64_t end)
{
  IdSurvey survey;
  for (std::int64_t t = begin; t < end; ++t)
  {
    std::int64_t ids[3];
    bool valid = true;
    for (int slot = 0; slot < 3; ++slot)
    {
      ids[slot] = mesh.Triangles.Get(t, slot);
      valid = valid && ids[slot] >= 0 && ids[slot] < mesh.Points.Count;
    }
    if (!valid)
    {
      survey.FirstInvalid = t;
      return survey;
    }
    for (const std::int64_t id : ids)
    {
      AtomicStore(&uses[id], PointUse::Used);
    }
    if (ids[0] == ids[1] || ids[1] == ids[2] || ids[2] == ids[0])
    {
      Note(survey.Repeated, t);
    }
  }
  return survey;
}

bool IsFinite(const double (&point)[3], GeometryKind geometry)
{
  return std::isfinite(point[0]) && std::isfinite(point[1]) &&
    (geometry == GeometryKind::PlanarXY || std::isfinite(point[2]));
}

/// Bounding box and counts of the used points.
struct PointSurvey
{
  double Lower[3] = { INFINITY, INFINITY, INFINITY };
  double Upper[3] = { -INFINITY, -INFINITY, -INFINITY };
  std::int64_t Used = 0;
  Defect NonFinite;

  void Include(const double (&point)[3])
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Lower[axis] = std::min(this->Lower[axis], point[axis]);
      this->Upper[axis] = std::max(this->Upper[axis], point[axis]);
    }
  }

  PointSurvey& operator+=(const PointSurvey& part)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Lower[axis] = std::min(this->Lower[axis], part.Lower[axis]);
      this->Upper[axis] = std::max(this->Upper[axis], part.Upper[axis]);
    }
    this->Used += part.Used;
    this->NonFinite += part.NonFinite;
    return *this;
  }
};

PointSurvey SurveyPoints(const PointArray& points, GeometryKind geometry, Array<PointUse>& uses,
  const ThreadBackend& backend)
{
  return backend.Sum<PointSurvey>(points.Count,
    [&](std::int64_t begin, std::int64_t end)
    {
      PointSurvey survey;
      for (std::int64_t i = begin; i < end; ++i)
      {
        if (uses[i] == PointUse::Unused)
        {
          continue;
        }
        ++survey.Used;
        const double point[3] = { points.Get(i, 0), points.Get(i, 1), points.Get(i, 2) };
        if (IsFinite(point, geometry))
        {
          survey.Include(point);
        }
        else
        {
          uses[i] = PointUse::NotFinite;
          Note(survey.NonFinite, i);
        }
      }
      return survey;
    });
}

void ResolveGeometry(MeshSurvey& survey, const PointArray& points, GeometryKind requested,
  const ThreadBackend& backend)
{
  survey.Geometry = requested;
  if (requested == GeometryKind::PlanarXY || requested == GeometryKind::Surface)
  {
    return;
  }
  PlaneFinder finder(points, survey, backend);
  const bool planar = finder.Find();
  if (!planar && requested == GeometryKind::Planar)
  {
    throw InvalidOptions("geometry 'planar' was asked for, but the points do not lie in one plane: "
                         "point " +
      std::to_string(finder.FarthestOff()) +
      " is off by more than 1e-6 of the bounding box's diagonal; use 'surface', or 'planar-xy' for "
      "terrain");
  }
  survey.Geometry = planar ? GeometryKind::Planar : GeometryKind::Surface;
  const int axis = finder.DominantAxis();
  survey.Projection.AxisU = (axis + 1) % 3;
  survey.Projection.AxisV = (axis + 2) % 3;
  survey.Projection.AxisW = axis;
  survey.Projection.Tilted = planar && survey.Lower[axis] < survey.Upper[axis];
}

/// Range of the coordinates, and what follows from it.
void ResolveRange(MeshSurvey& survey)
{
  double largest = 0.0;
  for (int axis = 0; axis < (survey.Geometry == GeometryKind::PlanarXY ? 2 : 3); ++axis)
  {
    largest = std::max({ largest, std::fabs(survey.Lower[axis]), std::fabs(survey.Upper[axis]) });
  }
  survey.FiltersApply = largest <= LargestFilteredDifference / 2;
  // Products of six lengths must neither overflow nor vanish where surfaces are judged.
  constexpr int UsualExponent = 100;
  const int exponent = largest > 0.0 ? std::ilogb(largest) : 0;
  survey.Scale = std::abs(exponent) > UsualExponent ? std::scalbn(1.0, -exponent) : 1.0;
}
}

void Note(Defect& defect, std::int64_t id)
{
  ++defect.Count;
  if (defect.FirstIds.size() < FirstIdsKept)
  {
    defect.FirstIds.push_back(id);
  }
}

Defect& operator+=(Defect& total, const Defect& part)
{
  total.Count += part.Count;
  for (const std::int64_t id : part.FirstIds)
  {
    if (total.FirstIds.size() < FirstIdsKept)
    {
      total.FirstIds.push_back(id);
    }
  }
  return total;
}

bool IsFinitePoint(const PointArray& points, std::int64_t point, GeometryKind geometry)
{
  const double xyz[3] = { points.Get(point, 0), points.Get(point, 1), points.Get(point, 2) };
  return IsFinite(xyz, geometry);
}

MeshSurvey SurveyMesh(
  const TriangleMesh& mesh, GeometryKind requested, const ThreadBackend& backend)
{
  MeshSurvey survey;
  survey.Uses = Array<PointUse>(mesh.Points.Count);
  std::fill_n(survey.Uses.Data(), survey.Uses.Size(), PointUse::Unused);
  const IdSurvey ids = backend.Sum<IdSurvey>(mesh.Triangles.Count,
    [&](std::int64_t begin, std::int64_t end) { return SurveyIds(mesh, survey.Uses, begin, end); });
  if (ids.FirstInvalid >= 0)
  {
    ThrowInvalidId(mesh, ids.FirstInvalid);
  }
  survey.RepeatedIds = ids.Repeated;
  survey.RepeatedIds.What = "triangles with a repeated point id";

  const PointSurvey points = SurveyPoints(mesh.Points, requested, survey.Uses, backend);
  survey.UsedPoints = points.Used;
  survey.NonFinitePoints = points.NonFinite;
  survey.NonFinitePoints.What = "points with NaN or infinite coordinates";
  survey.NonFinitePoints.Ids = DefectIds::Points;
  if (points.Used > points.NonFinite.Count)
  {
    std::copy_n(points.Lower, 3, survey.Lower);
    std::copy_n(points.Upper, 3, survey.Upper);
  }
  ResolveGeometry(survey, mesh.Points, requested, backend);
  ResolveRange(survey);
  return survey;
}

}
