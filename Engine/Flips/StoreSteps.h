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

/// The triangles of a mesh that are stored.
struct StoredTriangles
{
  const TriangleRecord* Triangles;
  const TriangleId* Kept = nullptr; ///< Those that are stored, in their order; null: all.
  const std::int32_t* Numbers = nullptr; ///< By triangle, its number among them, or -1.

  DELAUNAYFLIP_HOST_DEVICE const TriangleRecord& Get(std::int64_t i) const
  {
    return this->Triangles[this->Kept ? std::int64_t(this->Kept[i]) : i];
  }
  /// The slot of the triangle that Get(i) returns.
  DELAUNAYFLIP_HOST_DEVICE std::int64_t GetSlot(std::int64_t i) const
  {
    return this->Kept ? i : std::int64_t(this->Triangles[i].InputTriangle);
  }
  /// The slot of a triangle, or NoTriangle as a signed number.
  DELAUNAYFLIP_HOST_DEVICE std::uint32_t FindSlot(TriangleId triangle) const
  {
    return this->Numbers ? static_cast<std::uint32_t>(this->Numbers[triangle])
                         : this->Triangles[triangle].InputTriangle;
  }
  void PrefetchSlot(TriangleId triangle) const
  {
    if (this->Numbers)
    {
      Prefetch(&this->Numbers[triangle]);
    }
    else
    {
      Prefetch(&this->Triangles[triangle]);
    }
  }
};

/// Sets the ids of a triangle in the caller's slot, if the target includes it.
struct StoreStep
{
  StoredTriangles Stored;
  SpatialOrderView Order;

  template <typename Target>
  DELAUNAYFLIP_HOST_DEVICE void operator()(std::int64_t t, const Target& target) const
  {
    if (HasTriangle(target, this->Stored.GetSlot(t)))
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
    const VertexId vertex = this->Stored.Get(t).Vertices[slot];
    target.Set(this->Stored.GetSlot(t), slot, this->Order.GetVertex(vertex));
  }
};

/// Sets the number of the triangle across an edge, -1 where there is none.
struct NeighborStep
{
  StoredTriangles Stored;
  const CornerId* CornerOfHalfEdge;

  DELAUNAYFLIP_HOST_DEVICE void operator()(std::int64_t i, const OutputSlice& target) const
  {
    this->Store(i / 3, static_cast<int>(i % 3), target);
  }
  DELAUNAYFLIP_HOST_DEVICE void Store(std::int64_t t, int slot, const OutputSlice& target) const
  {
    const CornerId across = this->CornerOfHalfEdge[this->GetOtherSide(t, slot)];
    TriangleId neighbor = NoTriangle;
    if (across != NoCorner)
    {
      neighbor = this->Stored.FindSlot(TriangleOf(across));
    }
    target.Set(std::int64_t(3) * this->Stored.GetSlot(t) + slot, neighbor);
  }
  DELAUNAYFLIP_HOST_DEVICE HalfEdgeId GetOtherSide(std::int64_t t, int slot) const
  {
    return GetAt(this->Stored.Get(t).HalfEdges, slot) ^ 1u;
  }
};

/// Sets all neighbors of a triangle, on threads.
struct NeighborsStep
{
  NeighborStep Step;
  OutputSlice Target;

  /// Prefetches the edges of this triangle, and the triangles beyond those of an earlier one.
  void Prefetch(std::int64_t t) const
  {
    constexpr std::int64_t Second = 12;
    for (int slot = 0; slot < 3; ++slot)
    {
      delaunayflip::Prefetch(&this->Step.CornerOfHalfEdge[this->Step.GetOtherSide(t, slot)]);
    }
    for (int slot = 0; slot < 3 && t >= Second; ++slot)
    {
      const HalfEdgeId side = this->Step.GetOtherSide(t - Second, slot);
      const CornerId across = this->Step.CornerOfHalfEdge[side];
      if (across != NoCorner)
      {
        this->Step.Stored.PrefetchSlot(TriangleOf(across));
      }
    }
  }
  void operator()(std::int64_t t) const
  {
    for (int slot = 0; slot < 3; ++slot)
    {
      this->Step.Store(t, slot, this->Target);
    }
  }
};

/// Sets the number of flips of a triangle in the caller's slot.
struct FlipCountStep
{
  StoredTriangles Stored;

  DELAUNAYFLIP_HOST_DEVICE void operator()(std::int64_t t, const OutputSlice& target) const
  {
    target.Set(this->Stored.GetSlot(t), this->Stored.Get(t).Flips / OneFlip);
  }
};

}

#endif
