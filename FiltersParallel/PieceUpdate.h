// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef PieceUpdate_h
#define PieceUpdate_h

#include "FlipRun.h"
#include "PieceFlip.h"

namespace delaunayflip
{

/// Flips a mesh of which every rank of the group has a piece, and writes this rank's piece. All
/// ranks must call this together, within RunTogether.
/// @param request whose input may be empty.
/// @returns the report of the whole mesh.
/// @throws InvalidMesh, InvalidOptions and so on.
PiecesReport FlipPieces(const FlipRequest& request, PieceGroup& group, vtkPolyData* output);

}

#endif
