// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_EDGESIDES_H
#define DELAUNAYFLIP_EDGESIDES_H

#include "Array.h"
#include "DivideAndConquer.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

/// @file
/// The edges of divide and conquer, in rings around their origins, and the triangles that they
/// make.

namespace delaunayflip
{

using Edge = std::uint32_t; ///< A directed edge; e ^ 1 runs the other way.
constexpr Edge None = ~Edge(0);

/// One side of an edge.
struct Side
{
  std::uint32_t Origin; ///< A place; None: the edge is not used.
  Edge Next, Previous; ///< Around the origin, counter-clockwise and clockwise.
};

/// All sides, by directed edge.
struct EdgeSides
{
  EdgeSides(std::size_t count, Memory& memory)
    : Sides(count, memory)
  {
  }

  std::uint32_t Origin(Edge e) const { return this->Sides[e].Origin; }
  std::uint32_t Destination(Edge e) const { return this->Sides[e ^ 1].Origin; }
  Edge Next(Edge e) const { return this->Sides[e].Next; }
  Edge Previous(Edge e) const { return this->Sides[e].Previous; }
  /// The next edge around the left face.
  Edge NextLeft(Edge e) const { return this->Previous(e ^ 1); }

  void Link(Edge e, Edge next)
  {
    this->Sides[e].Next = next;
    this->Sides[next].Previous = e;
  }

  void PutAlone(Edge e, std::uint32_t origin) { this->Sides[e] = { origin, e, e }; }

  /// Puts a side between two others around its origin. Each number is written once, since a merge
  /// makes so many edges that stores and the loads that wait for them take much of its time.
  void PutBetween(Edge e, std::uint32_t origin, Edge previous, Edge next)
  {
    this->Sides[e] = { origin, next, previous };
    this->Sides[previous].Next = e;
    this->Sides[next].Previous = e;
  }

  /// Takes a side out from around its origin.
  void Unlink(Edge e) { this->Link(this->Previous(e), this->Next(e)); }

  Array<Side> Sides;
};

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
