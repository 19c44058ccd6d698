// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_RANDOMMESS_H
#define DELAUNAYFLIP_RANDOMMESS_H

#include "DelaunayFlip.h"
#include "GeneratedMeshes.h"

#include <cstdint>
#include <vector>

namespace delaunayflip
{

/// A small random mesh with every kind of defect, random constraints and random options.
struct RandomMess
{
  OwnedMesh<double> Mesh;
  std::vector<std::int64_t> Constraints; ///< Pairs of point ids.
  FlipOptions Options;

  TriangleMesh View() const;
};

/// A seed gives the same mesh on every machine.
RandomMess MakeRandomMess(std::uint32_t seed);

}

#endif
