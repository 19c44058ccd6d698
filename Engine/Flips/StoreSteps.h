// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_STORESTEPS_H
#define DELAUNAYFLIP_STORESTEPS_H

#include "Array.h"
#include "EdgeMesh.h"
#include "SpatialOrder.h"

#include <cstdint>

/// @file
/// How results get from an edge mesh into the caller's arrays.

namespace delaunayflip
{

/// Sets the ids of a triangle in the caller's slot, if the target includes it.
struct StoreStep
{
  const TriangleRecord* Triangles;
  SpatialOrderView Order;

  template <typename Target>
  DELAUNAYFLIP_HOST_DEVICE void operator()(std::int64_t t, const Target& target) const
  {
    if (HasTriangle(target, this->Triangles[t].InputTriangle))
    {
      for (int slot = 0; slot < 3; ++slot)
      {
        this->StoreId(t, slot, target);
      }
    }
  }

  /// Sets one of the three ids.
  template <typename Target>
  DELAUNAYFLIP_HOST_DEVICE void StoreId(std::int64_t t, int slot, const Target& target) const
  {
    const TriangleRecord& triangle = this->Triangles[t];
    target.Set(triangle.InputTriangle, slot, this->Order.GetVertex(triangle.Vertices[slot]));
  }
};

/// Sets the number of the triangle across an edge, -1 where there is none.
struct NeighborStep
{
  const TriangleRecord* Triangles;
  const CornerId* CornerOfHalfEdge;

  DELAUNAYFLIP_HOST_DEVICE void operator()(std::int64_t i, const OutputSlice& target) const
  {
    const TriangleRecord& triangle = this->Triangles[i / 3];
    const int slot = static_cast<int>(i % 3);
    const CornerId across = this->CornerOfHalfEdge[GetAt(triangle.HalfEdges, slot) ^ 1u];
    TriangleId neighbor = NoTriangle;
    if (across != NoCorner)
    {
      neighbor = this->Triangles[TriangleOf(across)].InputTriangle;
    }
    target.Set(std::int64_t(3) * triangle.InputTriangle + slot, neighbor);
  }
};

/// Sets the number of flips of a triangle in the caller's slot.
struct FlipCountStep
{
  const TriangleRecord* Triangles;

  DELAUNAYFLIP_HOST_DEVICE void operator()(std::int64_t t, const OutputSlice& target) const
  {
    target.Set(this->Triangles[t].InputTriangle, this->Triangles[t].Flips / OneFlip);
  }
};

}

#endif
