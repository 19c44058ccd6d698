// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PACKEDPOINTS_H
#define DELAUNAYFLIP_PACKEDPOINTS_H

#include "Array.h"
#include "EdgeMesh.h"
#include "FilteredPredicates.h"
#include "MeshSurvey.h"
#include "SpatialOrder.h"
#include "SurfaceAngles.h"
#include "TriangleMesh.h"

#include <cmath>
#include <cstdint>
#include <utility>

/// @file
/// The coordinates that rules read, in the engine's order of vertices and in the caller's
/// precision.

namespace delaunayflip
{

/// Plain pointers to PackedPoints, for functions of both backends.
struct PackedPointsView
{
  int Components;
  const float* Floats; ///< Or null, then Doubles.
  const double* Doubles;

  DELAUNAYFLIP_HOST_DEVICE DELAUNAYFLIP_ALWAYS_INLINE double Get(
    VertexId vertex, int component) const
  {
    const std::size_t i = std::size_t(this->Components) * vertex + component;
    return this->Floats ? static_cast<double>(this->Floats[i]) : this->Doubles[i];
  }
  DELAUNAYFLIP_HOST_DEVICE const void* Address(VertexId vertex) const
  {
    const std::size_t i = std::size_t(this->Components) * vertex;
    return this->Floats ? static_cast<const void*>(this->Floats + i) : this->Doubles + i;
  }
  DELAUNAYFLIP_HOST_DEVICE DELAUNAYFLIP_ALWAYS_INLINE PlanePoint GetPlanePoint(
    VertexId vertex) const
  {
    return { this->Get(vertex, 0), this->Get(vertex, 1), 0.0 };
  }
  DELAUNAYFLIP_HOST_DEVICE Vector3 GetPosition(VertexId vertex) const
  {
    return { this->Get(vertex, 0), this->Get(vertex, 1), this->Get(vertex, 2) };
  }
};

/// Components numbers per vertex: (u, v) in the plane, (u, v, w) in a tilted one, (x, y, z) on
/// surfaces.
struct PackedPoints
{
  int Components = 2;
  std::int64_t Count = 0;
  Array<float> Floats;
  Array<double> Doubles;

  bool IsFloat() const { return this->Floats.Size() > 0; }

  void Take(Array<float> values) { this->Floats = std::move(values); }
  void Take(Array<double> values) { this->Doubles = std::move(values); }

  PackedPointsView View() const
  {
    return { this->Components, this->IsFloat() ? this->Floats.Data() : nullptr,
      this->Doubles.Data() };
  }
};

/// Which coordinates to pack.
struct PackingPlan
{
  int Axes[3];
  int Components;
  bool AsFloat;
  bool Flat; ///< The third component is 0.
  bool MarksNonFinite; ///< A point gets NaN if a coordinate that is not packed is not finite.

  DELAUNAYFLIP_HOST_DEVICE double GetValue(
    const PointArray& points, std::int64_t point, int component) const
  {
    if (this->MarksNonFinite && !IsFinitePoint(points, point, GeometryKind::Planar))
    {
      return NAN;
    }
    return this->Flat && component == 2 ? 0.0 : points.Get(point, this->Axes[component]);
  }
};

/// Packs the point of a rank.
struct PackStep
{
  PointArray Points;
  SpatialOrderView Order;
  PackingPlan Plan;
  float* Floats;
  double* Doubles;

  DELAUNAYFLIP_HOST_DEVICE void Prefetch(std::int64_t rank) const
  {
    this->Points.Prefetch(this->Order.GetVertex(rank));
  }
  DELAUNAYFLIP_HOST_DEVICE void operator()(std::int64_t rank) const
  {
    const VertexId point = this->Order.GetVertex(rank);
    for (int k = 0; k < this->Plan.Components; ++k)
    {
      const std::size_t i = std::size_t(this->Plan.Components) * rank + k;
      const double x = this->Plan.GetValue(this->Points, point, k);
      if (this->Plan.AsFloat)
      {
        this->Floats[i] = static_cast<float>(x);
      }
      else
      {
        this->Doubles[i] = x;
      }
    }
  }
};

/// Packs all points, including unused and non-finite ones, which no rule reads.
template <typename Backend>
PackedPoints PackPoints(const PointArray& points, const SpatialOrderView& order,
  const PackingPlan& plan, const Backend& backend)
{
  PackedPoints packed;
  packed.Components = plan.Components;
  packed.Count = points.Count;
  const std::int64_t size = plan.Components * points.Count;
  packed.Floats = backend.template MakeArray<float>(plan.AsFloat ? size : 0);
  packed.Doubles = backend.template MakeArray<double>(plan.AsFloat ? 0 : size);
  backend.ForEach(
    points.Count, PackStep{ points, order, plan, packed.Floats.Data(), packed.Doubles.Data() });
  return packed;
}

}

#endif
