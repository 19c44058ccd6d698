// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_COLLECTTRIANGLES_H
#define DELAUNAYFLIP_COLLECTTRIANGLES_H

#include "DivideAndConquer.h"
#include "EdgeSides.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

/// @file
/// From the edges of divide and conquer to triangles.

namespace delaunayflip
{

/// How many sides a task has.
constexpr std::size_t SidesPerTask = std::size_t(1) << 16;

/// Numbers the triangles in the order of their first sides.
/// @param outside a side that the hull has on its outer face.
/// @param forTasks calls work(task, first, end) for ranges of [0, size) of that many items, on
/// threads.
template <typename ForTasks>
PointTriangles CollectTriangles(const EdgeSides& edges, const NumberedPlace* places, Edge outside,
  Memory& host, const ForTasks& forTasks)
{
  const auto sides = static_cast<Edge>(edges.Sides.Size());
  // By side: the corner of the triangle on the left, if there is one.
  Array<CornerId> cornerOf(sides, host);
  Array<Edge> leaders(sides, host); // by task, the first sides of triangles
  // Whether a side is the first one of its triangle. This has no branches, because they would be
  // mispredicted half of the time.
  const auto leads = [&](Edge e)
  {
    const Edge second = edges.NextLeft(e), third = edges.NextLeft(second);
    const int isFirst = int(e < second) & int(e < third);
    const int isTriangle = int(edges.NextLeft(third) == e);
    const int isInside = int(e != outside) & int(second != outside) & int(third != outside);
    return static_cast<std::size_t>(isFirst & isTriangle & isInside);
  };
  std::vector<std::int64_t> usedOf(sides / SidesPerTask + 1, 0),
    firstOf(sides / SidesPerTask + 2, 0);
  forTasks(sides,
    [&](std::size_t task, std::size_t begin, std::size_t end)
    {
      std::fill(cornerOf.Data() + begin, cornerOf.Data() + end, NoCorner);
      std::size_t next = begin;
      for (std::size_t i = begin; i < end; i += 2)
      {
        const auto e = static_cast<Edge>(i);
        if (edges.Origin(e) != None)
        {
          usedOf[task] += 2;
          leaders[next] = e;
          next += leads(e);
          leaders[next] = e + 1;
          next += leads(e + 1);
        }
      }
      firstOf[task + 1] = static_cast<std::int64_t>(next - begin);
    });
  std::partial_sum(firstOf.begin(), firstOf.end(), firstOf.begin());
  const auto triangles = static_cast<std::size_t>(firstOf.back());
  PointTriangles made{ Array<TriangleRecord>(triangles, host),
    std::accumulate(usedOf.begin(), usedOf.end(), -3 * firstOf.back()) };
  const auto placeOf = [&](Edge side) { return places[edges.Origin(side)].Number; };
  forTasks(sides,
    [&](std::size_t task, std::size_t begin, std::size_t)
    {
      const auto end = static_cast<TriangleId>(firstOf[task + 1]);
      for (auto number = static_cast<TriangleId>(firstOf[task]); number < end; ++number)
      {
        const Edge first = leaders[begin++];
        const Edge second = edges.NextLeft(first), third = edges.NextLeft(second);
        cornerOf[first] = MakeCorner(number, 2);
        cornerOf[second] = MakeCorner(number, 0);
        cornerOf[third] = MakeCorner(number, 1);
        made.Triangles[number] = { { placeOf(first), placeOf(second), placeOf(third) }, number,
          { second ^ 1u, third ^ 1u, first ^ 1u }, 0 };
      }
    });
  forTasks(triangles,
    [&](std::size_t, std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        for (CornerId& other : made.Triangles[i].HalfEdges)
        {
          other = cornerOf[other];
        }
      }
    });
  return made;
}

}

#endif
