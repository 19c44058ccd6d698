// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_LOCALDEVICEMESH_CUH
#define DELAUNAYFLIP_LOCALDEVICEMESH_CUH

#include "CudaBackend.cuh"

#include <limits>

/// @file
/// CudaBackend::Localize: the caller's mesh where kernels can read it.

namespace delaunayflip
{

inline void CudaBackend::RequireCountable(std::int64_t points)
{
  if (points > std::numeric_limits<std::int32_t>::max())
  {
    throw BackendUnavailable("the mesh has " + std::to_string(points) +
      " points; the CUDA backend numbers them with 31 bits, use 'threads'");
  }
}

template <typename T>
Array<T> CudaBackend::Bring(const T* host, std::int64_t size) const
{
  Array<T> values = this->MakeArray<T>(size);
  this->Upload(host, size, values.Data());
  return values;
}

inline void CudaBackend::BringLabels(const FixedEdges& fixed, LocalDeviceMesh& local) const
{
  const std::int64_t triangles = local.Mesh.Triangles.Count;
  static_cast<FixedEdges&>(local.Mesh) = fixed;
  if (fixed.Regions)
  {
    local.Regions = this->Bring(fixed.Regions, triangles);
    local.Mesh.Regions = local.Regions.Data();
  }
  if (fixed.FrozenTriangles)
  {
    local.Frozen = this->Bring(fixed.FrozenTriangles, triangles);
    local.Mesh.FrozenTriangles = local.Frozen.Data();
  }
}

inline LocalDeviceMesh CudaBackend::Localize(const TriangleMesh& mesh) const
{
  RequireCountable(mesh.Points.Count);
  LocalDeviceMesh local;
  const PointArray& points = mesh.Points;
  const TriangleArray& triangles = mesh.Triangles;
  local.Triangles = this->MakeArray<std::int32_t>(3 * triangles.Count);
  StagedCopy(*this->Context, this->Threads)
    .Upload(3 * triangles.Count, local.Triangles.Data(),
      [&](std::int64_t i)
      {
        // An id that does not fit is invalid, and stays invalid.
        const std::int64_t id = triangles.Ids32 ? triangles.Ids32[i] : triangles.Ids64[i];
        return id == static_cast<std::int32_t>(id) ? static_cast<std::int32_t>(id) : -1;
      });
  local.Mesh.Triangles = TriangleArray(local.Triangles.Data(), triangles.Count);
  if (points.Floats)
  {
    local.Floats = this->Bring(points.Floats, 3 * points.Count);
    local.Mesh.Points = PointArray(local.Floats.Data(), points.Count);
  }
  else
  {
    local.Doubles = this->Bring(points.Doubles, 3 * points.Count);
    local.Mesh.Points = PointArray(local.Doubles.Data(), points.Count);
  }
  this->BringLabels(mesh, local);
  return local;
}

template <typename T>
PointArray CudaBackend::ViewPoints(
  const T* values, const DevicePointArray& points, Array<T>& wide) const
{
  if (points.Components == 3)
  {
    return PointArray(values, points.Count);
  }
  wide = this->MakeArray<T>(3 * points.Count);
  T* xyz = wide.Data();
  this->ForEach(points.Count,
    [=] __device__(std::int64_t i)
    {
      xyz[3 * i] = values[2 * i];
      xyz[3 * i + 1] = values[2 * i + 1];
      xyz[3 * i + 2] = 0;
    });
  return PointArray(xyz, points.Count);
}

inline LocalDeviceMesh CudaBackend::Localize(const DeviceMesh& mesh) const
{
  RequireCountable(mesh.Points.Count);
  this->WaitFor(mesh.Stream);
  LocalDeviceMesh local;
  local.IsOnHost = false;
  local.Mesh.Triangles = mesh.Triangles;
  local.Mesh.Points = mesh.Points.Floats
    ? this->ViewPoints(mesh.Points.Floats, mesh.Points, local.Floats)
    : this->ViewPoints(mesh.Points.Doubles, mesh.Points, local.Doubles);
  this->BringLabels(mesh, local);
  return local;
}

}

#endif
