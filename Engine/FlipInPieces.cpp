// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FlipError.h"
#include "InputChecks.h"
#include "MeshDivision.h"
#include "PieceFlip.h"
#include "PieceSurvey.h"

#include <algorithm>
#include <atomic>
#include <memory>
#include <string>

namespace delaunayflip
{

namespace
{
/// Writes the triangles of a rank into their slots of the whole mesh.
void Collect(const std::vector<OwnPiece>& pieces, int rank, const FlippedPiece& flipped,
  const MutableTriangleArray& triangles)
{
  const auto given = static_cast<std::int64_t>(pieces[rank].PointOf.size());
  for (std::size_t i = 0; i < flipped.Triangles.size(); ++i)
  {
    const PieceOrigin& origin = flipped.Origins[i / 3];
    PieceOrigin point{ rank, flipped.Triangles[i] };
    if (point.Id >= given)
    {
      point = flipped.ReceivedPoints[point.Id - given];
    }
    triangles.Set(pieces[origin.Rank].SlotOf[origin.Id], static_cast<int>(i % 3),
      pieces[point.Rank].PointOf[point.Id]);
  }
}

/// The options of a rank.
FlipOptions GetRankOptions(const FlipOptions& options, const PieceDivision& division, int rank)
{
  FlipOptions own = options;
  if (!division.Devices.empty())
  {
    own.Device = division.Devices[rank % division.Devices.size()];
  }
  return own;
}

std::vector<int> MakeTurns(const PieceDivision& division)
{
  std::vector<int> turns(division.Devices.empty() ? 0 : division.Pieces);
  for (std::size_t rank = 0; rank < turns.size(); ++rank)
  {
    turns[rank] = static_cast<int>(rank % division.Devices.size());
  }
  return turns;
}
}

PiecesReport FlipInPieces(const TriangleMesh& mesh, const FlipOptions& options,
  const PieceDivision& division, const MutableTriangleArray& triangles,
  const ProgressObserver& progress)
{
  if (division.Pieces < 1)
  {
    throw InvalidOptions(
      "a mesh cannot be divided into " + std::to_string(division.Pieces) + " pieces");
  }
  const std::unique_ptr<PieceGroup> single = MakeSingleGroup();
  CheckPieces({ mesh, nullptr }, options, *single);
  const std::vector<OwnPiece> pieces = DivideMesh(mesh, division.Pieces);
  std::vector<FlippedPiece> flipped(division.Pieces);
  PiecesReport report;
  std::atomic<bool> goesOn{ true };
  const auto work = [&](PieceGroup& group)
  {
    const int rank = group.GetRank();
    // Rank 0 is the calling thread, whose observer is asked.
    const ProgressObserver observer = [&](double share)
    {
      goesOn = goesOn && (rank != 0 || !progress || progress(share));
      return goesOn.load();
    };
    const PiecesReport own = FlipPiece(
      pieces[rank].View(), GetRankOptions(options, division, rank), group, flipped[rank], observer);
    if (rank == 0)
    {
      report = own;
    }
  };
  RunInThreads(division.Pieces, work, MakeTurns(division));
  for (int rank = 0; rank < division.Pieces; ++rank)
  {
    Collect(pieces, rank, flipped[rank], triangles);
  }
  return report;
}

}
