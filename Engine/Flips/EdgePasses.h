// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_EDGEPASSES_H
#define DELAUNAYFLIP_EDGEPASSES_H

#include "BinarySearch.h"
#include "EdgeFlip.h"
#include "EdgeGuard.h"
#include "EdgeMesh.h"
#include "FlipRules.h"
#include "HostDevice.h"
#include "StepCounts.h"

#include <cstdint>

/// @file
/// What the passes of an iteration (FlipLoop.h) do to one edge, for both backends.

namespace delaunayflip
{

/// Pass 2: the new state of an edge that is bad or was blocked by the guard. The guard table does
/// not change meanwhile.
DELAUNAYFLIP_HOST_DEVICE inline EdgeState DecideByGuard(
  const GuardedEdges& edges, const EdgeMeshView& mesh, const Quad& quad)
{
  const unsigned char* shared = edges.SharedVertices;
  const bool isUnknown = shared && (shared[quad.A] & shared[quad.B]) != 0;
  if (isUnknown || edges.Table.Has(mesh, quad.A, quad.B))
  {
    return EdgeState::BlockedByEdge;
  }
  return EdgeState::Bad;
}

/// Counts the edges of EdgeState::BlockedByDeviation, which the passes count with BlockedByShape.
/// @param mesh its States are Fixed for the edges that are not judged.
template <typename Rule, typename Backend>
std::int64_t CountDeviating(EdgeMesh& mesh, const Rule& rule, const Backend& backend)
{
  std::int64_t count = 0;
  if constexpr (Rule::IsInSpace)
  {
    const EdgeMeshView view = mesh.View();
    count = backend.template Sum<std::int64_t>(mesh.NumberOfEdges,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i, std::int64_t & sum)
      {
        const auto edge = static_cast<EdgeId>(i);
        const bool deviates = view.States[edge] != EdgeState::Fixed &&
          rule.Judge(view.GetQuad(edge)) == EdgeState::BlockedByDeviation;
        sum += int(deviates);
      });
  }
  return count;
}

/// The first edge that has its first corner in `triangle` or a later one, before any flip.
DELAUNAYFLIP_HOST_DEVICE inline std::int64_t FindFirstEdge(
  const CornerId* words, std::int64_t edges, std::int64_t triangle)
{
  return FindEnd(std::int64_t(0), edges,
    [=](std::int64_t edge) { return TriangleOf(words[2 * edge]) < triangle; });
}

/// Pass 4: decides which of two bad edges flips first. Priorities are a bijection of edge ids: two
/// equal ones would both flip, on a shared triangle. They are scattered so that a chain of bad
/// edges does not flip one by one.
DELAUNAYFLIP_HOST_DEVICE inline std::uint32_t Priority(EdgeId edge) { return Scatter(edge); }

/// Whether an edge has a smaller priority than all bad outer edges of its quad.
DELAUNAYFLIP_HOST_DEVICE inline bool IsFirst(
  EdgeId edge, const OuterHalfEdges& outer, bool ap, bool qa, bool pb, bool bq)
{
  const std::uint32_t own = Priority(edge);
  // All four are compared, because branches would be mispredicted half of the time.
  const int earlier = (int(ap) & int(Priority(EdgeOf(outer.AP)) < own)) |
    (int(qa) & int(Priority(EdgeOf(outer.QA)) < own)) |
    (int(pb) & int(Priority(EdgeOf(outer.PB)) < own)) |
    (int(bq) & int(Priority(EdgeOf(outer.BQ)) < own));
  return earlier == 0;
}

/// Pass 6, after a flip with a guard: replaces the old vertex pair by the new one.
DELAUNAYFLIP_HOST_DEVICE inline void UpdateGuard(
  const GuardedEdges& edges, EdgeId edge, const Quad& quad, StepCounts& counts)
{
  // The two searches begin before either ends.
  const GuardTableView::Path from = edges.Table.Find(quad.P, quad.Q);
  GuardTableView::Path to = edges.Table.Find(quad.A, quad.B);
  counts.FreedSlots += edges.Table.Remove(edge, from);
  const int used = edges.Table.Insert(edge, to);
  counts.FreshSlots += int(used > 0);
  counts.LostInserts += int(used < 0);
}

}

#endif
