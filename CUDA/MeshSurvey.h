// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_MESHSURVEY_H
#define DELAUNAYFLIP_MESHSURVEY_H

#include "Array.h"
#include "FilteredPredicates.h"
#include "FlipOptions.h"
#include "FlipReport.h"
#include "HostDevice.h"
#include "ThreadBackend.h"
#include "TriangleMesh.h"

#include <cstdint>

/// @file
/// The first look at an input: are its ids valid, which points are used, in which space do edges
/// live.

namespace delaunayflip
{

/// Which coordinates decide in planar geometry: U and V span the plane's projection along its
/// dominant axis W. The handedness of (U, V, W) is that of (x, y, z).
struct PlaneProjection
{
  int AxisU = 0;
  int AxisV = 1;
  int AxisW = 2;
  bool Tilted = false; ///< W is not constant, so it belongs to the lift of the in-circle test.

  PlanePoint Project(const PointArray& points, std::int64_t point) const
  {
    return { points.Get(point, this->AxisU), points.Get(point, this->AxisV),
      this->Tilted ? points.Get(point, this->AxisW) : 0.0 };
  }
};

enum class PointUse : std::uint8_t
{
  Unused,
  Used,
  NotFinite ///< Used, and a coordinate that matters is NaN or infinite.
};

struct MeshSurvey
{
  GeometryKind Geometry = GeometryKind::Surface; ///< Never Auto.
  PlaneProjection Projection; ///< For the planar kinds.
  Array<PointUse> Uses; ///< One a point.
  std::int64_t UsedPoints = 0;
  double Lower[3] = { 0.0, 0.0, 0.0 }; ///< Bounding box of the used, finite points.
  double Upper[3] = { 0.0, 0.0, 0.0 };
  bool FiltersApply = true; ///< Coordinates are in the range of FilteredPredicates.h.
  double Scale = 1.0; ///< Power of two that brings extreme coordinates near 1; 1 for usual ones.
  Defect NonFinitePoints;
  Defect RepeatedIds;
};

/// @throws InvalidMesh for an id that is not a point, InvalidOptions for GeometryKind::Planar
/// without a plane.
MeshSurvey SurveyMesh(
  const TriangleMesh& mesh, GeometryKind requested, const ThreadBackend& backend);

/// "x, y and z" of the three numbers is finite; only the first two matter for PlanarXY.
bool IsFinitePoint(const PointArray& points, std::int64_t point, GeometryKind geometry);

/// A defect's count and first ids, summed over pieces of the mesh in order.
Defect& operator+=(Defect& total, const Defect& part);

/// Counts `id` and keeps it if it is among the first three.
void Note(Defect& defect, std::int64_t id);

}

#endif
