// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PieceFlip.h"

#include "PieceRun.h"

#include <functional>
#include <utility>

namespace delaunayflip
{

PiecesReport FlipPiece(const MeshPiece& piece, const FlipOptions& options, PieceGroup& group,
  FlippedPiece& flipped, const ProgressObserver& progress)
{
  PiecesReport report;
  const auto flip = [&](PieceGroup& told)
  {
    CheckPieces(piece, options, told);
    FlipOptions own = options;
    own.NumberOfPieces = 1; // a session of several does not know what other ranks have
    own.TrackQuality = false;
    PointKeys keys = MatchPoints(piece, told);
    const PieceSurvey survey = SurveyPieces(piece, keys, own, told);
    PieceRun run({ piece, own, survey, told, progress }, std::move(keys));
    report = run.Run();
    run.Store(flipped);
  };
  RunTogether(group, std::ref(flip)); // a copy of flip would need memory
  return report;
}

void FlippedPiece::Clear()
{
  this->Triangles.clear();
  this->FlipCounts.clear();
  this->GoneTriangles.clear();
  this->ReceivedTriangles.clear();
  this->ReceivedPoints.clear();
  this->ReceivedCoordinates.clear();
}

std::vector<PieceOrigin> ListOrigins(const FlippedPiece& flipped, int rank)
{
  const std::size_t kept = flipped.FlipCounts.size() - flipped.ReceivedTriangles.size();
  std::vector<PieceOrigin> origins;
  origins.reserve(flipped.FlipCounts.size());
  auto gone = flipped.GoneTriangles.begin();
  for (std::int64_t slot = 0; origins.size() < kept; ++slot)
  {
    if (gone != flipped.GoneTriangles.end() && *gone == slot)
    {
      ++gone;
      continue;
    }
    origins.push_back({ rank, slot });
  }
  origins.insert(origins.end(), flipped.ReceivedTriangles.begin(), flipped.ReceivedTriangles.end());
  return origins;
}

}
