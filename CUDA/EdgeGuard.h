// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_EDGEGUARD_H
#define DELAUNAYFLIP_EDGEGUARD_H

#include "EdgeMesh.h"
#include "EdgeTable.h"
#include "FlipSteps.h"
#include "ThreadBackend.h"

#include <cstdint>
#include <utility>

namespace delaunayflip
{

/// The edges that exist, where flips could make one twice; empty where they provably cannot.
class EdgeGuard
{
public:
  EdgeGuard() = default;

  /// Takes over a table that holds the vertex pairs of all `edges` edges.
  EdgeGuard(EdgeTable table, std::int64_t edges, std::int64_t vertices)
    : Table(std::move(table)),
      UsedSlots(edges),
      NumberOfVertices(vertices)
  {
  }

  bool IsActive() const { return !this->Table.IsEmpty(); }
  EdgeTableView View() { return this->Table.View(); }

  /// An empty table for the claims of an iteration with `bad` bad edges; kept between iterations.
  EdgeTableView MakeClaims(std::int64_t bad, const ThreadBackend& backend);

  /// Accounts for the flips of an iteration: when too many slots were used or a new edge found
  /// none, the table is made anew from the mesh.
  void Maintain(const StepCounts& flips, EdgeMesh& mesh, const ThreadBackend& backend);

private:
  void Rebuild(EdgeMesh& mesh, const ThreadBackend& backend);

  EdgeTable Table;
  EdgeTable Claims;
  std::int64_t UsedSlots = 0;
  std::int64_t NumberOfVertices = 0;
};

}

#endif
