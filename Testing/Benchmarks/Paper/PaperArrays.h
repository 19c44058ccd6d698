// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PAPERARRAYS_H
#define DELAUNAYFLIP_PAPERARRAYS_H

#include "HostDevice.h"

#include <cstdint>
#include <vector>

/// @file
/// The data structures of the paper's section 2, on the host and as views for both backends.

namespace delaunayflip
{

/// A position (x, y) as in the paper, loaded in one instruction.
template <typename Real>
struct alignas(2 * sizeof(Real)) PaperPoint2
{
  using Number = Real;
  static constexpr int Dimension = 2;
  Real X, Y;
};

/// A position (x, y, z); the fourth number is padding.
template <typename Real>
struct alignas(4 * sizeof(Real)) PaperPoint3
{
  using Number = Real;
  static constexpr int Dimension = 3;
  Real X, Y, Z, Unused;
};

/// Two indices: of an edge's ends in Vertices, or of their places in Triangles.
struct alignas(8) IndexPair
{
  std::int32_t First, Second;
};

/// Views of all arrays. Each value of an edge has an array of its own, so that neighbouring threads
/// read neighbouring words.
template <typename Point>
struct PaperArrays
{
  const Point* Vertices;
  std::int32_t* Triangles; ///< Three indices of vertices each.
  IndexPair* Ends; ///< v1, v2 of an edge.
  IndexPair* TriangleA; ///< ta: where in Triangles v1 and v2 are.
  IndexPair* TriangleB; ///< tb, the same in the other triangle; -1, -1 at a boundary.
  IndexPair* Opposites; ///< Where in Triangles the opposite vertices are, in ta and in tb.
  std::int32_t* Flags; ///< By triangle: the last iteration in which a thread claimed it.
  std::int32_t* Rotations; ///< By triangle: the one that it rotated with last.
};

/// A mesh in these structures.
template <typename Point>
struct PaperMesh
{
  std::vector<Point> Vertices;
  std::vector<std::int32_t> Triangles;
  std::vector<IndexPair> Ends;
  std::vector<IndexPair> TriangleA;
  std::vector<IndexPair> TriangleB;
  std::vector<IndexPair> Opposites;

  std::int64_t NumberOfEdges() const { return static_cast<std::int64_t>(this->Ends.size()); }
  std::int64_t NumberOfTriangles() const
  {
    return static_cast<std::int64_t>(this->Triangles.size()) / 3;
  }
};

}

#endif
