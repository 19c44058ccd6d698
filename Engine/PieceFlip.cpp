// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PieceFlip.h"

#include "PreparedPieces.h"

namespace delaunayflip
{

PiecesReport FlipInPieces(const TriangleMesh& mesh, const FlipOptions& options,
  const MutableTriangleArray& triangles, const ProgressObserver& progress)
{
  try
  {
    return PreparedPieces(mesh, options, triangles, progress).Run(progress, nullptr);
  }
  catch (const RunAborted&) // before the first flip
  {
    return PreparedPieces::Abort(mesh, triangles, options.NumberOfThreads);
  }
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
