// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_ENGINETRIANGLES_H
#define DELAUNAYFLIP_ENGINETRIANGLES_H

#include "DeviceMesh.h"
#include "EdgeMesh.h"
#include "SpatialOrder.h"

#include <cstdint>

namespace delaunayflip
{

/// The triangles of an engine where they are in the memory of a GPU, to be read until the engine
/// works again.
struct EngineTriangles
{
  const TriangleRecord* Records = nullptr; ///< Null if they are in no GPU's memory.
  SpatialOrderView Order{};
  std::int64_t Count = 0;
  int Device = -1; ///< CUDA's number of the GPU.
  DeviceStream Stream; ///< The engine's. What is in it may still write the records.
  std::uint64_t Engine = 0; ///< Another number for every engine of the process.
};

class FlipLoop;

/// The same where they are in the memory of the host.
struct HostTriangles
{
  const TriangleRecord* Records = nullptr; ///< Null if they are not.
  const CornerId* CornerOfHalfEdge = nullptr;
  SpatialOrderView Order{};
  std::int64_t Count = 0;
  std::int64_t NumberOfEdges = 0; ///< Of half-edges twice as many.
  const FlipLoop* Loop = nullptr; ///< That of the engine.

  /// Calls visit(corner) for every edge of one triangle.
  template <typename Visit>
  void ForEachAtBoundary(const Visit& visit) const
  {
    for (std::int64_t edge = 0; edge < this->NumberOfEdges; ++edge)
    {
      if (this->CornerOfHalfEdge[2 * edge + 1] == NoCorner)
      {
        visit(this->CornerOfHalfEdge[2 * edge]);
      }
    }
  }

  /// The corner on the other side of the edge opposite to a slot, or NoCorner.
  CornerId GetOtherCorner(std::int64_t triangle, int slot) const
  {
    return this->CornerOfHalfEdge[this->Records[triangle].HalfEdges[slot] ^ 1u];
  }
};

}

#endif
