// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PLANEFRAME_H
#define DELAUNAYFLIP_PLANEFRAME_H

#include "MeshSurvey.h"
#include "PlaneMesh.h"
#include "SpatialOrder.h"

namespace delaunayflip
{

/// The plane in which a mesh is refined, and how its edges are judged there.
struct PlaneFrame
{
  PlaneProjection Projection;
  bool IsMirrored = false; ///< Whether most triangles are clockwise, so that U and V change places.
  bool IsCanonical = true; ///< FlipOptions::TieRule.
  bool NeedsGuard = false; ///< Whether triangles may overlap or be turned over.

  /// Which of the caller's coordinates is U (0) or V (1). Not for a tilted plane.
  int GetAxis(int number) const
  {
    const bool isFirst = (number == 0) != this->IsMirrored;
    return isFirst ? this->Projection.AxisU : this->Projection.AxisV;
  }
};

/// Finds the places of vertices in a plane.
struct PlacementStep
{
  PackedPointsView Points; ///< Packed as PlanPacking plans.
  PlaneFrame Frame;

  DELAUNAYFLIP_HOST_DEVICE PlanePoint Find(VertexId vertex) const
  {
    double u = this->Points.Get(vertex, 0), v = this->Points.Get(vertex, 1);
    if (this->Frame.Projection.Tilted)
    {
      const double p[3] = { u, v, this->Points.Get(vertex, 2) };
      const double(&along)[2][3] = this->Frame.Projection.Along;
      u = along[0][0] * p[0] + along[0][1] * p[1] + along[0][2] * p[2];
      v = along[1][0] * p[0] + along[1][1] * p[1] + along[1][2] * p[2];
    }
    if (this->Frame.IsMirrored)
    {
      return { v, u, 0.0 };
    }
    return { u, v, 0.0 };
  }
};

}

#endif
