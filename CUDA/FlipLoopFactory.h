// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_FLIPLOOPFACTORY_H
#define DELAUNAYFLIP_FLIPLOOPFACTORY_H

#include "EdgeMesh.h"
#include "EdgeTable.h"
#include "FlipLoop.h"
#include "FlipOptions.h"
#include "FlipReport.h"
#include "MeshSurvey.h"
#include "PackedPoints.h"
#include "SpatialOrder.h"
#include "ThreadBackend.h"

#include <memory>
#include <vector>

/// @file
/// Which rule judges a mesh, on which coordinates, and whether flips need a guard.

namespace delaunayflip
{

struct FlipLoopInput
{
  const PointArray& Points;
  const MeshSurvey& Survey;
  const SpatialOrder& Order;
  const FlipOptions& Options;
  const FlipReport& Counts; ///< Of the input's points and edges.
};

struct FlipLoopResult
{
  PackedPoints Points; ///< What the loop reads; must live as long.
  std::unique_ptr<FlipLoop> Loop;
  std::vector<Defect> Defects; ///< Of triangles: without area, turned over.
};

/// @param mesh must live as long as the loop, as backend must.
/// @param table the vertex pairs of all edges; kept where flips could make an edge that exists.
FlipLoopResult MakeFlipLoop(
  const FlipLoopInput& input, EdgeMesh& mesh, EdgeTable table, const ThreadBackend& backend);

}

#endif
