// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PACKEDPOINTS_H
#define DELAUNAYFLIP_PACKEDPOINTS_H

#include "Array.h"
#include "EdgeMesh.h"
#include "FilteredPredicates.h"
#include "MeshSurvey.h"
#include "SpatialOrder.h"
#include "ThreadBackend.h"
#include "TriangleMesh.h"

#include <cstdint>

/// @file
/// The coordinates that decide, in the engine's order of vertices and in the caller's precision.

namespace delaunayflip
{

/// Components numbers a vertex: (u, v) in the plane, (u, v, w) in a tilted one, (x, y, z) on
/// surfaces.
struct PackedPoints
{
  int Components = 2;
  std::int64_t Count = 0;
  Array<float> Floats;
  Array<double> Doubles;

  bool IsFloat() const { return this->Floats.Size() > 0; }

  PlanePoint GetPlanePoint(VertexId vertex) const
  {
    const std::size_t i = std::size_t(this->Components) * vertex;
    return this->IsFloat() ? PlanePoint{ this->Floats[i], this->Floats[i + 1], 0.0 }
                           : PlanePoint{ this->Doubles[i], this->Doubles[i + 1], 0.0 };
  }
};

/// Which coordinates to pack.
struct PackingPlan
{
  int Axes[3];
  int Components;
  bool AsFloat;
  double Scale; ///< Power of two; 1 where exact predicates decide.
};

/// Packs all points, also unused ones and those that are not finite, which no rule will read.
PackedPoints PackPoints(const PointArray& points, const SpatialOrder& order,
  const PackingPlan& plan, const ThreadBackend& backend);

}

#endif
