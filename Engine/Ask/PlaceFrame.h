// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PLACEFRAME_H
#define DELAUNAYFLIP_PLACEFRAME_H

#include "PlaceOffsets.h"
#include "PlaneMesh.h"

#include <cmath>
#include <cstdint>

namespace delaunayflip
{

/// The triangulation as seen from a place, for the weights of vertices around it. Coordinates are
/// scaled by the triangle that has the place. A frame is the parameter of their templates.
class PlaceFrame
{
public:
  DELAUNAYFLIP_HOST_DEVICE PlaceFrame(
    const PlaneMesh& mesh, const PlanePoint& place, TriangleId triangle)
    : Mesh(mesh),
      Unscaled(place)
  {
    double largest = 0.0;
    for (int slot = 0; slot < 3; ++slot)
    {
      const PlanePoint point = mesh.GetPoint(mesh.GetVertex(MakeCorner(triangle, slot)));
      for (const double half : { 0.5 * point.U - 0.5 * place.U, 0.5 * point.V - 0.5 * place.V })
      {
        if (std::fabs(half) > largest)
        {
          largest = std::fabs(half);
        }
      }
    }
    this->Scale = InvertPowerOfTwo(largest);
    this->Place = { place.U * this->Scale, place.V * this->Scale };
  }

  DELAUNAYFLIP_HOST_DEVICE const ScaledPoint& GetPlace() const { return this->Place; }

  DELAUNAYFLIP_HOST_DEVICE ScaledPoint GetPoint(VertexId vertex) const
  {
    const PlanePoint point = this->Mesh.GetPoint(vertex);
    return { point.U * this->Scale, point.V * this->Scale };
  }

  DELAUNAYFLIP_HOST_DEVICE VertexId GetVertex(CornerId corner) const
  {
    return this->Mesh.GetVertex(corner);
  }

  /// The corner on the other side of the edge opposite a corner, or NoCorner, as behind a segment.
  DELAUNAYFLIP_HOST_DEVICE CornerId FindBeyond(CornerId corner) const
  {
    const CornerId across = this->Mesh.FindBeyond(corner); // loaded with the state, not after it
    return this->Mesh.IsFixed(this->Mesh.GetHalfEdge(corner)) ? NoCorner : across;
  }

  /// Whether the place is in the circumcircle of the triangle of a corner.
  DELAUNAYFLIP_HOST_DEVICE bool IsInCircle(CornerId corner) const
  {
    const PlanePoint points[4] = { this->Mesh.GetPoint(this->Mesh.GetVertex(corner)),
      this->Mesh.GetPoint(this->Mesh.GetVertex(PlaneMesh::Next(corner))),
      this->Mesh.GetPoint(this->Mesh.GetVertex(PlaneMesh::Previous(corner))), this->Unscaled };
    int sign = FilteredInCircle(points[0], points[1], points[2], points[3]);
    if (sign == UncertainSign || !this->Mesh.IsInFilterRange)
    {
      sign = ExactInCircle(points, false);
    }
    return this->Mesh.RequireSign(sign) == 1;
  }

  /// Whether filters may be used for all coordinates.
  DELAUNAYFLIP_HOST_DEVICE bool IsInFilterRange() const { return this->Mesh.IsInFilterRange; }

private:
  const PlaneMesh& Mesh;
  const PlanePoint Unscaled;
  ScaledPoint Place;
  double Scale;
};

}

#endif
