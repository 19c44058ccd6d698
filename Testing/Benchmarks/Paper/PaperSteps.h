// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PAPERSTEPS_H
#define DELAUNAYFLIP_PAPERSTEPS_H

#include "Atomics.h"
#include "HostDevice.h"
#include "PaperArrays.h"
#include "PaperTests.h"

#include <cstdint>

/// @file
/// The two phases of the paper's section 3, written as the work of one thread for one edge. Both
/// backends run them.

namespace delaunayflip
{

/// Statistics of an iteration.
struct PaperCounts
{
  std::uint32_t Bad = 0;
  std::uint32_t Flipped = 0;
};

/// Phase 1: detection, exclusion and processing.
///
/// Threads read triangles that others are flipping. That is harmless: only a thread that afterwards
/// claims both triangles of its edge changes anything, and then no other thread has flipped them in
/// this iteration, so what it has read is consistent.
template <typename Point, typename Test>
struct DetectAndFlip
{
  PaperArrays<Point> Mesh;
  Test EdgeTest;
  NormalThreshold<typename Point::Number> Normals;
  std::int32_t Iteration; ///< 1, 2, ...
  std::int32_t* LastBad; ///< The last iteration that found a bad edge.
  PaperCounts* Counts; ///< Of this iteration, or null.

  DELAUNAYFLIP_HOST_DEVICE void operator()(std::int64_t edge) const
  {
    if (this->Mesh.TriangleB[edge].First < 0 || !this->IsBad(edge))
    {
      return;
    }
    AtomicStore(this->LastBad, this->Iteration);
    const bool flips =
      this->Take(this->Mesh.TriangleA[edge]) && this->Take(this->Mesh.TriangleB[edge]);
    if (flips)
    {
      this->Flip(edge);
    }
    if (this->Counts)
    {
      AtomicAdd(&this->Counts->Bad, 1u);
      AtomicAdd(&this->Counts->Flipped, flips ? 1u : 0u);
    }
  }

private:
  DELAUNAYFLIP_HOST_DEVICE bool IsBad(std::int64_t edge) const
  {
    const IndexPair ends = this->Mesh.Ends[edge];
    const IndexPair opposites = this->Mesh.Opposites[edge];
    const Point p = this->Mesh.Vertices[ends.First];
    const Point q = this->Mesh.Vertices[ends.Second];
    const Point a = this->Mesh.Vertices[AtomicLoad(this->Mesh.Triangles + opposites.First)];
    const Point b = this->Mesh.Vertices[AtomicLoad(this->Mesh.Triangles + opposites.Second)];
    return this->EdgeTest.IsBad(p, q, a, b) && this->Normals.Admits(p, q, a, b);
  }

  /// Claims a triangle. Returns whether this thread is the first to do so in this iteration.
  DELAUNAYFLIP_HOST_DEVICE bool Take(const IndexPair& corners) const
  {
    std::int32_t* flag = this->Mesh.Flags + corners.First / 3;
    return AtomicExchange(flag, this->Iteration) != this->Iteration;
  }

  /// The five steps of section 3.1.
  DELAUNAYFLIP_HOST_DEVICE void Flip(std::int64_t edge) const
  {
    std::int32_t* vertices = this->Mesh.Triangles;
    const IndexPair o = this->Mesh.Opposites[edge];
    const IndexPair a = this->Mesh.TriangleA[edge];
    const IndexPair b = this->Mesh.TriangleB[edge];
    const std::int32_t c1 = a.First;
    const std::int32_t c2 = b.Second;
    AtomicStore(vertices + c2, vertices[o.First]);
    AtomicStore(vertices + c1, vertices[o.Second]);
    this->Mesh.TriangleA[edge] = { o.First, c1 };
    this->Mesh.TriangleB[edge] = { c2, o.Second };
    this->Mesh.Opposites[edge] = { a.Second, b.First };
    this->Mesh.Ends[edge] = { vertices[o.First], vertices[c1] };
    this->Mesh.Rotations[a.First / 3] = b.First / 3;
    this->Mesh.Rotations[b.First / 3] = a.First / 3;
  }
};

/// Phase 2: if an edge's ends are no longer where ta (tb) says (eqs. 3 and 4), finds them in the
/// triangle with which its own was rotated.
template <typename Point>
struct RepairReferences
{
  PaperArrays<Point> Mesh;

  DELAUNAYFLIP_HOST_DEVICE void operator()(std::int64_t edge) const
  {
    const IndexPair ends = this->Mesh.Ends[edge];
    const IndexPair a = this->Mesh.TriangleA[edge];
    const IndexPair b = this->Mesh.TriangleB[edge];
    if (this->IsStale(ends, a))
    {
      this->Mesh.TriangleA[edge] = this->Find(ends, a, this->Mesh.Opposites[edge].First);
    }
    if (b.First >= 0 && this->IsStale(ends, b))
    {
      this->Mesh.TriangleB[edge] = this->Find(ends, b, this->Mesh.Opposites[edge].Second);
    }
  }

private:
  DELAUNAYFLIP_HOST_DEVICE bool IsStale(const IndexPair& ends, const IndexPair& corners) const
  {
    return this->Mesh.Triangles[corners.First] != ends.First ||
      this->Mesh.Triangles[corners.Second] != ends.Second;
  }

  /// @param opposite receives the index of the third corner.
  DELAUNAYFLIP_HOST_DEVICE IndexPair Find(
    const IndexPair& ends, const IndexPair& stale, std::int32_t& opposite) const
  {
    const std::int32_t begin = 3 * this->Mesh.Rotations[stale.First / 3];
    IndexPair found = stale;
    for (std::int32_t i = begin; i < begin + 3; ++i)
    {
      const std::int32_t vertex = this->Mesh.Triangles[i];
      found.First = vertex == ends.First ? i : found.First;
      found.Second = vertex == ends.Second ? i : found.Second;
    }
    opposite = 3 * begin + 3 - found.First - found.Second;
    return found;
  }
};

}

#endif
