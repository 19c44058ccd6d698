// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PIECEJOB_H
#define DELAUNAYFLIP_PIECEJOB_H

#include "PieceFlip.h"
#include "PieceSurvey.h"

namespace delaunayflip
{

/// The input of a run on one rank. All of it must live as long as the run.
struct PieceJob
{
  const MeshPiece& Piece;
  const FlipOptions& Options;
  const PieceSurvey& Survey;
  PieceGroup& Group;
  const ProgressObserver& Progress;
};

}

#endif
