// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_LONGCONSTRAINTS_H
#define DELAUNAYFLIP_LONGCONSTRAINTS_H

#include "GeneratedMeshes.h"

#include <cstdint>
#include <vector>

namespace delaunayflip
{

/// Constraints across the unit square, between points of a mesh.
struct LongConstraints
{
  std::vector<std::int64_t> Ends; ///< Two for each.
  std::vector<unsigned char> ToInsert; ///< All are.

  /// Gives a mesh views of them.
  TriangleMesh AddTo(TriangleMesh mesh) const;
};

/// Lines from the left border to the right one, each in a strip of its own.
LongConstraints MakeLines(const OwnedMesh<float>& mesh, int lines);

/// As many lines in each of two directions, with a vertex wherever two of them meet.
LongConstraints MakeNet(const OwnedMesh<float>& mesh, int lines);

}

#endif
