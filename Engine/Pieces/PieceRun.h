// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PIECERUN_H
#define DELAUNAYFLIP_PIECERUN_H

#include "DelaunayFlip.h"
#include "FixedPairs.h"
#include "GuardRound.h"
#include "JoinReports.h"
#include "PieceConstraints.h"
#include "PieceJob.h"
#include "PieceMesh.h"
#include "QuadJudge.h"
#include "SeamRound.h"
#include "SeamSurvey.h"
#include "SeamTester.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace delaunayflip
{

class RoundFlips;

/// The part of one rank in a run.
///
/// First each rank flips its piece, in which the edges between ranks, the seam edges, are boundary
/// edges. Then rounds follow. In a round, all seam edges are tested; triangles at bad ones move to
/// the other rank, so that these edges become inner edges; and each rank flips from there on. Every
/// round flips at least one bad edge, so the proof that flips end on one rank holds here too.
class PieceRun
{
public:
  PieceRun(const PieceJob& job, PointKeys keys);

  /// Makes the first flips and all rounds. All ranks must call this together.
  /// @returns the report of the whole mesh.
  PiecesReport Run();

  void Store(FlippedPiece& flipped) const;

private:
  TriangleMesh GetFirstMesh() const;
  void FlipFirst();
  void KeepFirst(const TriangleMesh& mesh);
  void TakeFirst(MarkedEdges marks);
  MarkedEdges MarkEdges(const TriangleMesh& mesh);
  bool MakeRound();
  bool MayGoOn();
  void FlipAround(const std::vector<std::int64_t>& toJudge, const GuardRound& waiting);
  void Flip(RoundFlips& flips);
  std::int64_t GetIterationLimit() const;
  bool IsAtLimit() const;
  void KeepRows(const FlipReport& report);
  void KeepRow(const IterationRecord& row);
  void KeepFlips(std::int64_t flipped);
  bool Tell(double share) const;
  void CountRest();
  void CountBad();
  PiecesReport MakeReport();
  void AddDefects(FlipReport& report) const;

  PieceJob Job;
  std::vector<std::int64_t> FirstOrigins; ///< The number of the first triangle of every rank.
  PieceMesh Mesh;
  QuadJudge Judge;
  SeamTester Tester;
  WaitingEdges Waiting;
  PieceConstraints Constraints;
  SeamSurvey Seams; ///< Of the mesh with the constraints inserted.
  std::int64_t NumberOfPoints; ///< Of the whole mesh.
  std::int64_t UsedPoints; ///< Points of triangles, in the whole mesh.

  // Of this rank:
  FlipReport Own; ///< Starts as the report of the first flips.
  std::vector<RoundRow> Rows;
  /// The session of the first flips. Keeps the triangles that are not listed (PieceMesh), if any.
  std::unique_ptr<FlipSession> First;
  StopReasonKind StopReason = StopReasonKind::Converged;
  std::size_t EarlierRows = 0; ///< Rows of earlier rounds.
  bool HasBlocked = false; ///< Whether a bad edge was seen that may not flip.

  // Of all ranks:
  PiecesReport Whole; ///< The members that it inherits from FlipReport are set at the end.
  StopReasonKind WholeStopReason = StopReasonKind::Converged;
  std::int64_t Iterations = 0; ///< Of earlier rounds.
  bool IsCounted = true; ///< Whether no rank was stopped before its edges were counted.
  std::int64_t BadSeams = 0; ///< Bad seam edges that are left at the end, for any reason.
  std::int64_t FoldedSeams = 0; ///< Of these, the ones whose flip would fold the mesh over.
};

}

#endif
