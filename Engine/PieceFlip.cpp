// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PieceFlip.h"

#include "PieceRun.h"

#include <utility>

namespace delaunayflip
{

PiecesReport FlipPiece(const MeshPiece& piece, const FlipOptions& options, PieceGroup& group,
  FlippedPiece& flipped, const ProgressObserver& progress)
{
  CheckPieces(piece, options, group);
  PointKeys keys = MatchPoints(piece, group);
  const PieceSurvey survey = SurveyPieces(piece, keys, options, group);
  PieceRun run({ piece, options, survey, group, progress }, std::move(keys));
  PiecesReport report = run.Run();
  run.Store(flipped);
  return report;
}

}
