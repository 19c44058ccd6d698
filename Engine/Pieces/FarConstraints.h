// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_FARCONSTRAINTS_H
#define DELAUNAYFLIP_FARCONSTRAINTS_H

#include "PieceMesh.h"

#include <cstdint>
#include <vector>

namespace delaunayflip
{

/// A constraint that may cross triangles of several ranks, so that no rank can insert it alone.
struct FarConstraint
{
  std::int64_t Ends[2]; ///< Keys.
  double Positions[2][3];

  PointPair GetKeys() const { return MakePair(this->Ends[0], this->Ends[1]); }
};

/// A constraint between two points of this rank.
FarConstraint MakeFarConstraint(const PieceMesh& mesh, std::int64_t from, std::int64_t to);

/// The constraints of MeshPiece::FarConstraints, with keys and positions of their ends. All ranks
/// must call this together.
/// @throws InvalidMesh for an id that is not a point of its rank.
std::vector<FarConstraint> LookUpFarConstraints(
  const MeshPiece& piece, const PieceMesh& mesh, PieceGroup& group);

}

#endif
