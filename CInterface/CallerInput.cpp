// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CallerInput.h"

#include "CudaDevice.h"
#include "KeptReport.h"
#include "Status.h"

#include <algorithm>
#include <cstddef>
#include <cstring>

namespace delaunayflip
{

namespace
{

/// Completes the caller's struct: a program compiled with an older header has fewer members; the
/// others keep their defaults.
template <typename Struct>
Struct Complete(const Struct& given, void (*initialize)(Struct*))
{
  Require(given.size >= static_cast<std::int64_t>(sizeof(given.size)),
    "the size of a struct is not set: call its _init function first");
  Struct complete;
  initialize(&complete);
  std::memcpy(&complete, &given, std::min(sizeof(Struct), static_cast<std::size_t>(given.size)));
  complete.size = sizeof(Struct);
  return complete;
}

template <typename Enumeration>
Enumeration ToEnumeration(std::int32_t value, Enumeration last, const char* rule)
{
  Require(value >= 0 && value <= static_cast<std::int32_t>(last), rule);
  return static_cast<Enumeration>(value);
}

void RequirePoints(const delaunayflip_mesh& c)
{
  Require(c.number_of_points >= 0, "number_of_points is negative");
  Require(c.points || c.number_of_points == 0, "points is null");
  Require(c.point_type == DELAUNAYFLIP_FLOAT32 || c.point_type == DELAUNAYFLIP_FLOAT64,
    "point_type is neither DELAUNAYFLIP_FLOAT32 nor DELAUNAYFLIP_FLOAT64");
}

PointArray ToPoints(const delaunayflip_mesh& c)
{
  RequirePoints(c);
  Require(c.point_components == 3, "point_components must be 3 for points in the host's memory");
  return c.point_type == DELAUNAYFLIP_FLOAT32
    ? PointArray(static_cast<const float*>(c.points), c.number_of_points)
    : PointArray(static_cast<const double*>(c.points), c.number_of_points);
}

DevicePointArray ToDevicePoints(const delaunayflip_mesh& c)
{
  RequirePoints(c);
  Require(c.point_components == 2 || c.point_components == 3, "point_components is not 2 or 3");
  return c.point_type == DELAUNAYFLIP_FLOAT32
    ? DevicePointArray(static_cast<const float*>(c.points), c.number_of_points, c.point_components)
    : DevicePointArray(
        static_cast<const double*>(c.points), c.number_of_points, c.point_components);
}

FixedEdges ToFixedEdges(const delaunayflip_mesh& c)
{
  Require(c.number_of_constraint_edges >= 0, "number_of_constraint_edges is negative");
  Require(c.constraint_edges || c.number_of_constraint_edges == 0, "constraint_edges is null");
  FixedEdges fixed;
  fixed.ConstraintEdges = c.constraint_edges;
  fixed.NumberOfConstraintEdges = c.number_of_constraint_edges;
  fixed.ConstraintsToInsert = c.constraints_to_insert;
  fixed.Regions = c.regions;
  fixed.FrozenTriangles = c.frozen_triangles;
  return fixed;
}

/// A view of the caller's integers as `Array`, whose 32-bit ids are Id32 and 64-bit ids Id64.
template <typename Array, typename Id32, typename Id64, typename Void>
Array ToIds(Void* ids, std::int64_t triangles, std::int32_t type)
{
  Require(triangles >= 0, "number_of_triangles is negative");
  Require(ids || triangles == 0, "triangles is null");
  Require(type == DELAUNAYFLIP_INT32 || type == DELAUNAYFLIP_INT64,
    "id_type is neither DELAUNAYFLIP_INT32 nor DELAUNAYFLIP_INT64");
  return type == DELAUNAYFLIP_INT32 ? Array(static_cast<Id32*>(ids), triangles)
                                    : Array(static_cast<Id64*>(ids), triangles);
}

TriangleArray ToTriangles(const delaunayflip_mesh& c)
{
  return ToIds<TriangleArray, const std::int32_t, const std::int64_t>(
    c.triangles, c.number_of_triangles, c.id_type);
}

}

delaunayflip_mesh CompleteMesh(const delaunayflip_mesh* given)
{
  Require(given, "mesh is null");
  return Complete(*given, delaunayflip_mesh_init);
}

delaunayflip_polygons CompletePolygons(const delaunayflip_polygons* given)
{
  Require(given, "polygons is null");
  const delaunayflip_polygons c = Complete(*given, delaunayflip_polygons_init);
  Require(c.number_of_polygons >= 0, "number_of_polygons is negative");
  Require(c.offsets || c.number_of_polygons == 0, "offsets is null");
  Require(c.corners || c.number_of_polygons == 0 || c.offsets[0] == c.offsets[c.number_of_polygons],
    "corners is null");
  return c;
}

bool IsOnDevice(const delaunayflip_mesh& c)
{
  Require(c.memory == DELAUNAYFLIP_HOST || c.memory == DELAUNAYFLIP_CUDA,
    "memory is neither DELAUNAYFLIP_HOST nor DELAUNAYFLIP_CUDA");
  return c.memory == DELAUNAYFLIP_CUDA;
}

TriangleMesh ToMesh(const delaunayflip_mesh& c)
{
  Require(!IsOnDevice(c), "this function needs a mesh in the host's memory");
  TriangleMesh mesh;
  static_cast<FixedEdges&>(mesh) = ToFixedEdges(c);
  mesh.Points = ToPoints(c);
  mesh.Triangles = ToTriangles(c);
  return mesh;
}

DeviceMesh ToDeviceMesh(const delaunayflip_mesh& c)
{
  DeviceMesh mesh;
  static_cast<FixedEdges&>(mesh) = ToFixedEdges(c);
  mesh.Points = ToDevicePoints(c);
  mesh.Triangles = ToTriangles(c);
  mesh.Stream.Handle = c.stream;
  return mesh;
}

MutableTriangleArray ToOutput(void* ids, std::int64_t triangles, std::int32_t type)
{
  return ToIds<MutableTriangleArray, std::int32_t, std::int64_t>(ids, triangles, type);
}

GeometryKind ToGeometry(std::int32_t value)
{
  return ToEnumeration(value, GeometryKind::Surface, "geometry is no delaunayflip_geometry");
}

FlipOptions ToOptions(const delaunayflip_options* given)
{
  FlipOptions options;
  if (!given)
  {
    return options;
  }
  const delaunayflip_options c = Complete(*given, delaunayflip_options_init);
  options.Geometry = ToGeometry(c.geometry);
  options.Criterion = ToEnumeration(
    c.criterion, CriterionKind::OppositeAngles, "criterion is no delaunayflip_criterion");
  options.TieRule =
    ToEnumeration(c.tie_rule, TieRuleKind::Canonical, "tie_rule is no delaunayflip_tie_rule");
  options.Backend =
    ToEnumeration(c.backend, BackendKind::Threads, "backend is no delaunayflip_backend");
  options.Tolerance = c.tolerance;
  options.FeatureAngle = c.feature_angle;
  options.MaximumIterations = c.maximum_iterations;
  options.NumberOfThreads = c.number_of_threads;
  options.Device = c.device;
  options.Devices = ParseDevices(c.devices ? c.devices : "");
  options.NumberOfPieces = c.number_of_pieces;
  options.TrackQuality = c.track_quality != 0;
  return options;
}

Observers::Observers(const delaunayflip_callbacks* given)
{
  if (!given)
  {
    return;
  }
  const delaunayflip_callbacks c = Complete(*given, delaunayflip_callbacks_init);
  if (c.progress)
  {
    this->Progress = [c](double share) { return c.progress(share, c.user) != 0; };
  }
  if (c.iteration)
  {
    this->Iteration = [c](const IterationRecord& record)
    {
      const delaunayflip_iteration copy = ToC(record);
      return c.iteration(&copy, c.user) != 0;
    };
  }
}

}
