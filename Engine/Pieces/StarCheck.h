// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_STARCHECK_H
#define DELAUNAYFLIP_STARCHECK_H

#include "MeshSurvey.h"
#include "PieceGroup.h"
#include "PointMatch.h"
#include "ThreadBackend.h"
#include "TriangleMesh.h"

#include <cstdint>

namespace delaunayflip
{

/// How triangles turn in the plane.
struct StarTurns
{
  std::int64_t Left = 0, Right = 0, None = 0;
  /// How often corners at closed points cover the direction +u, around which their triangles turn a
  /// whole number of times: once for each such point, if its star is simple.
  std::int64_t Covers = 0;

  bool AreUniform() const { return this->None == 0 && (this->Left == 0 || this->Right == 0); }

  StarTurns& operator+=(const StarTurns& part)
  {
    this->Left += part.Left;
    this->Right += part.Right;
    this->None += part.None;
    this->Covers += part.Covers;
    return *this;
  }
};

/// @param closed one flag per point: whether its triangles close around it.
StarTurns SumStarTurns(const TriangleMesh& mesh, const PlaneProjection& plane,
  const unsigned char* closed, const ThreadBackend& threads);

/// Whether all triangles of the whole mesh strictly turn to one side in the plane and those around
/// every point cover no direction twice. Then no guard is needed (PlanarSurvey::StarsAreSimple);
/// nor is it for a piece, around whose points there are fewer triangles. All ranks call it
/// together.
bool AreStarsSimple(const TriangleMesh& mesh, const PlaneProjection& plane, const PointKeys& keys,
  const ThreadBackend& threads, PieceGroup& group);

}

#endif
