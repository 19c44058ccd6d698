// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_GIVENCONSTRAINTS_H
#define DELAUNAYFLIP_GIVENCONSTRAINTS_H

#include "PieceTestSupport.h"

#include <string>
#include <vector>

/// @file
/// Constraints to be inserted, given to the pieces of a mesh in different ways.

namespace delaunayflip
{

/// Gives every constraint to one rank only, which need not have triangles at its points.
std::vector<OwnedPiece> GiveToAny(const TriangleMesh& mesh, std::vector<OwnedPiece> pieces);

/// Gives the constraints whose two points no rank has together as far ones, one of them twice.
std::vector<OwnedPiece> GiveFar(const TriangleMesh& mesh, std::vector<OwnedPiece> pieces);

/// A report's defects with their counts, sorted, without ids.
std::vector<std::string> ListDefects(const FlipReport& report);

/// Expects what one process makes of a mesh in which no two constraints cross.
GroupResult ExpectAsAlone(const TriangleMesh& mesh, const std::vector<OwnedPiece>& pieces,
  FlipOptions options = MakeCanonical(), bool withNumbers = true);

}

#endif
