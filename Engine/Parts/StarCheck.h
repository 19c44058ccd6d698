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

/// The orientations of triangles in the plane, and a measure of the stars of points.
struct StarTurns
{
  std::int64_t Left = 0, Right = 0, None = 0; ///< Triangles that turn left, right, or have no area.
  /// How many corners at closed points cover the direction +u. The triangles around a closed point
  /// turn around it a whole number of times. If its star is simple, +u is covered once.
  std::int64_t Covers = 0;

  /// The side to which most turn.
  int GetSide() const { return this->Left >= this->Right ? 1 : -1; }
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

/// The sum over all triangles of all ranks, without what closed points cover once each. All ranks
/// must call this together.
StarTurns SumStarTurns(const TriangleMesh& mesh, const PlaneProjection& plane,
  const PointKeys& keys, const ThreadBackend& threads, PieceGroup& group);

/// Whether all triangles of the whole mesh strictly turn to the same side in the plane, and the
/// triangles around every point cover no direction twice. Then flips need no guard
/// (PlanarSurvey::StarsAreSimple), neither in the whole mesh nor in a part, where the star of a
/// point has some of the same triangles. All ranks must call this together.
/// @param keys of which only Keys, Shared and Closed matter. @param turns from SumStarTurns.
bool AreStarsSimple(const TriangleMesh& mesh, const PlaneProjection& plane, const PointKeys& keys,
  const StarTurns& turns, const ThreadBackend& threads, PieceGroup& group);

/// Sets StarsAreSimple and Side of a mesh of this process, which may be too large for a session.
void SurveyStars(const TriangleMesh& mesh, const PlaneProjection& plane,
  const ThreadBackend& threads, WholeMesh& whole);

}

#endif
