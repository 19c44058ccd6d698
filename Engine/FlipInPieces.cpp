// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CallerMesh.h"
#include "ConstraintInsertion.h"
#include "FlipError.h"
#include "InputChecks.h"
#include "MeshDivision.h"
#include "PieceFlip.h"
#include "PieceSurvey.h"
#include "RunProgress.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

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
    own.Devices.clear();
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

/// Flips a mesh without constraints that are to be inserted.
PiecesReport FlipDivided(const TriangleMesh& mesh, const FlipOptions& options,
  const PieceDivision& division, const MutableTriangleArray& triangles,
  const ProgressObserver& progress)
{
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
      goesOn = goesOn && (rank != 0 || progress(share));
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

/// @returns whether there was time for it.
bool InsertConstraints(const TriangleMesh& mesh, const FlipOptions& options,
  const ProgressObserver& progress, ConstraintInsertion& insertion)
{
  try
  {
    if (CallerMesh(mesh).HasConstraintsToInsert())
    {
      insertion = ConstraintInsertion(mesh, options,
        [&](double share)
        { return !progress || progress(ConstraintInsertion::ShareOfRun * share); });
    }
    return true;
  }
  catch (const RunAborted&)
  {
    return false;
  }
}

PiecesReport StopBeforeFlips(const TriangleArray& input, const MutableTriangleArray& triangles)
{
  for (std::int64_t i = 0; i < 3 * input.Count; ++i)
  {
    triangles.Set(i / 3, static_cast<int>(i % 3), input.Get(i / 3, static_cast<int>(i % 3)));
  }
  PiecesReport report;
  report.Triangles = input.Count;
  report.StopReason = StopReasonKind::Aborted;
  return report;
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
  ConstraintInsertion insertion;
  if (!InsertConstraints(mesh, options, progress, insertion))
  {
    return StopBeforeFlips(mesh.Triangles, triangles);
  }
  const double begin = insertion.GetShare();
  const ProgressObserver observer = [&](double share)
  { return !progress || progress(begin + (1.0 - begin) * share); };
  PiecesReport report = FlipDivided(
    insertion.GetMesh(mesh), insertion.GetOptions(options), division, triangles, observer);
  insertion.AddTo(report);
  return report;
}

}
