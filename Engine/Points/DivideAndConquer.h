// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_DIVIDEANDCONQUER_H
#define DELAUNAYFLIP_DIVIDEANDCONQUER_H

#include "Array.h"
#include "EdgeMesh.h"

#include <cstdint>
#include <functional>

/// @file
/// The Delaunay triangulation of points on the host, by divide and conquer (Guibas and Stolfi, ACM
/// Transactions on Graphics 4, 1985). Strips are cut in the order of x, and merged in the order of
/// y. It takes O(n log n) time for any points. It is used if flips of the triangles between strips
/// would be a long chain, as for points along curves.

namespace delaunayflip
{

/// A place, and its number.
struct NumberedPlace
{
  double U, V;
  std::uint32_t Number;
};

/// What DivideAndConquer needs of its caller.
struct DivideAndConquerCaller
{
  /// Calls work(task) for task = 0 .. count - 1, on threads.
  std::function<void(std::int64_t count, const std::function<void(std::int64_t)>& work)> Run;
  /// Stores the places with numbers from first to end - 1. It is called on any thread.
  std::function<void(std::int64_t first, std::int64_t end, NumberedPlace* places)> GetPlaces;
  /// Receives the share of the work that is done, on the calling thread, every twentieth of a
  /// second. It may throw, which ends the work.
  std::function<void(double)> Tell;
  Memory& Host; ///< Thread-safe.
};

/// A triangulation of places.
struct PointTriangles
{
  /// Vertices are numbers of places; HalfEdges hold the other corners, or NoCorner.
  Array<TriangleRecord> Triangles;
  std::int64_t HullEdges = 0;
};

/// Triangulates places, no two of which are equal, in the order of strips (Strips.h). All triangles
/// are counter-clockwise and have an area. No point is inside a circumcircle. Which of two
/// diagonals is used for four points on a circle depends on the order of the places.
PointTriangles DivideAndConquer(std::int64_t count, const DivideAndConquerCaller& caller);

}

#endif
