// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_DIVIDEANDCONQUER_H
#define DELAUNAYFLIP_DIVIDEANDCONQUER_H

#include "EdgeMesh.h"

#include <cstdint>
#include <functional>
#include <vector>

/// @file
/// The Delaunay triangulation of points on the host, by divide and conquer (Guibas and Stolfi, ACM
/// Transactions on Graphics 4, 1985) with cuts that alternate between x and y (Dwyer, Algorithmica
/// 2, 1987). It takes O(n log n) steps whatever the points are. Where strips leave a start from
/// which flips are a long chain, as for points along curves, this takes over.

namespace delaunayflip
{

/// Calls work(task) for task = 0 .. count - 1, on threads.
using TaskRunner =
  std::function<void(std::int64_t count, const std::function<void(std::int64_t)>& work)>;

struct DividedPoints
{
  /// Vertices are numbers of places; HalfEdges hold the other corners, or NoCorner.
  std::vector<TriangleRecord> Triangles;
  std::int64_t HullEdges = 0;
};

/// Triangulates places, no two of which are equal. All triangles turn to the left and have an area;
/// no point is inside a circumcircle. Which of two diagonals is used for four points on a circle
/// depends on the order of the places.
DividedPoints DivideAndConquer(
  const std::vector<CoordinatePair<double>>& places, const TaskRunner& run);

}

#endif
