// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_EDGESIDES_H
#define DELAUNAYFLIP_EDGESIDES_H

#include "Array.h"

#include <cstddef>
#include <cstdint>

/// @file
/// The edges of divide and conquer, in rings around their origins.

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

}

#endif
