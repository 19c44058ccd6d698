// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_INTERPOLATION_H
#define DELAUNAYFLIP_INTERPOLATION_H

#include "DeviceMesh.h"
#include "TriangleMesh.h"

#include <cstdint>

/// @file
/// A triangulation of points can be asked in which triangles places lie, and which values are there
/// if there are values at the points. FlipSession::Ask answers:
///
///     const double points[] = { 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0, 1.0 };
///     const double heights[] = { 0.0, 10.0, 20.0, 30.0 };
///     PointInput input;
///     input.Points = PlaneArray(points, 4, 2);
///     FlipSession session(input, PointOptions());
///     session.Advance();
///     const double place[] = { 0.5, 0.25 };
///     double height = 0.0;
///     PlaceQuery query;
///     query.Places = PlaneArray(place, 1, 2);
///     query.Values = heights; // one for each point
///     query.Results = &height; // one for each place
///     session.Ask(query); // true
///     height; // 10.0

namespace delaunayflip
{

/// How values between points are found. In the plane both methods reproduce linear functions. Both
/// give the value of a point at its place.
enum class InterpolationKind
{
  /// Linear in each triangle.
  Linear,
  /// Sibson's natural neighbours: the value of each neighbour counts as much as the area that a new
  /// point at the place would take from its Voronoi cell. Smooth except at the points. Neighbours
  /// behind a segment do not count; near a segment values approach what is linear along it.
  Natural
};

/// The values of a place that is in no triangle.
enum class OutsideKind
{
  NotANumber,
  /// The value, linear along edges, at the nearest place on the boundary of the triangles. A place
  /// that is not finite has NaN. Takes longer the more boundary edges there are.
  Nearest
};

/// Places at the centres of the cells of a raster, row by row. Cell (column, row) is at
/// Origin + (column, row) * Step, each product and sum rounded once to double precision.
struct PlaceRaster
{
  double Origin[2] = { 0.0, 0.0 }; ///< The centre of the first cell.
  double Step[2] = { 1.0, 1.0 }; ///< May be negative.
  std::int64_t Columns = 0; ///< Along x.
  std::int64_t Rows = 0; ///< Along y.

  std::int64_t CountCells() const { return this->Columns * this->Rows; }

  /// A coordinate, 0 (x) or 1 (y), of the centre of a cell.
  DELAUNAYFLIP_HOST_DEVICE double Get(std::int64_t cell, int axis) const
  {
    const std::int64_t row = cell / this->Columns;
    const std::int64_t index = axis == 0 ? cell - row * this->Columns : row;
    return this->Origin[axis] + static_cast<double>(index) * this->Step[axis] + 0.0;
  }
};

/// Places in the plane or on a sphere, and what is wanted there.
///
/// **On a sphere** a place is a direction from the origin, given by x, y and z of any length
/// (PlaneArray::Stride is at least 3), or by longitude and latitude. Only triangles that face away
/// from the origin have places; so a place beyond points on less than half of a sphere is outside,
/// even if triangles close the mesh there. Linear weights are spherical barycentric coordinates:
/// the volumes that the place and two vertices span with the origin, divided by their sum. Natural
/// neighbours are Sibson's in the plane that touches the sphere at the place, into which the points
/// are projected from the place's antipode. That keeps circles as circles, so the neighbours are
/// those on the sphere. A GPU answers if it is the backend, unless few places come from the host.
struct PlaceQuery
{
  PlaneArray Places; ///< In any order. Neighbouring ones one after the other are faster.
  PlaceRaster Raster; ///< Instead of Places, if it has cells.
  /// On a sphere: whether Places are longitudes and latitudes in degrees, as PlaceOnSphere takes
  /// them, instead of x, y and z. Those of a raster are anyway. An error in the plane.
  bool Degrees = false;

  /// By place, the lowest number of a triangle that has it inside or on its boundary; -1 if there
  /// is none. Null: not wanted.
  std::int32_t* Triangles = nullptr;

  /// Components values for each point of the input and after them for each of
  /// FlipSession::GetAddedPoints, interleaved. Null: only Triangles are wanted.
  const double* Values = nullptr;
  int Components = 1;
  InterpolationKind Method = InterpolationKind::Linear;
  OutsideKind Outside = OutsideKind::NotANumber;
  /// Components values for each place.
  double* Results = nullptr;

  /// Whether all arrays are in the memory of one GPU, ordered by Stream; else in the host's.
  bool OnDevice = false;
  DeviceStream Stream{};

  std::int64_t CountPlaces() const
  {
    return this->Raster.CountCells() > 0 ? this->Raster.CountCells() : this->Places.Count;
  }
};

}

#endif
