// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_DIVIDEDRUN_H
#define DELAUNAYFLIP_DIVIDEDRUN_H

#include "EdgeTotals.h"
#include "MeshInPieces.h"
#include "PieceFlip.h"
#include "PointSet.h"

#include <atomic>
#include <cstdint>
#include <mutex>
#include <vector>

namespace delaunayflip
{

/// Flips a mesh of this process in pieces.
///
/// First each piece is flipped by itself. The edges between pieces, the seam edges, are treated as
/// boundary edges and do not flip. Then the triangles around the points of seam edges, a region,
/// are flipped as one mesh. If flips reach points at the border of the region, the triangles around
/// these points are the next region. The run ends when no flip has reached a border. So every edge
/// is judged after the last flip of a triangle next to it.
class DividedRun
{
public:
  /// All arguments must live as long as the run.
  /// @param flipCounts is set to the number of flips of each triangle slot; or null.
  DividedRun(MeshInPieces& mesh, const FlipOptions& options, std::int32_t* flipCounts,
    const ProgressObserver& progress);

  PiecesReport Run();

private:
  /// About the share of the time that passes before the first region.
  static constexpr double PiecesShare = 0.9;

  // Before the first flip:
  void ExamineSeams();
  std::int64_t CountUnmatched() const;
  FlipOptions GetCountingOptions() const;

  // The pieces:
  void FlipPieces();
  void FlipPiece(int piece, PieceGroup& group);
  void FlipSubMesh(SubMesh& part, int piece, const ProgressObserver& progress);
  void KeepFixedEdges(const SubMesh& part, const FlipOptions& options, const EdgeCounts& edges);
  FlipOptions GetPieceOptions(int piece) const;
  void KeepFlips(const SubMesh& part, const std::int32_t* counts);
  bool Tell(int piece, double share, bool isCaller);

  void JoinPieces();
  void SumSeconds();

  // The regions:
  void FlipRegions();
  PointSet FlipRegion(const PointSet& active, const ProgressObserver& progress);
  void KeepRegion(const FlipReport& report, const PointSet& inner);
  std::int64_t CountIterationsLeft() const;

  // The report:
  void CountRest();
  void CountBadEdges();
  void AddDefects();

  MeshInPieces& Mesh;
  const FlipOptions& Options;
  std::int32_t* const FlipCounts; ///< Of the mesh; or null.
  const ProgressObserver& Progress;

  std::vector<std::int64_t> Constraints; ///< Edges that the caller fixes: two ids for each.
  PointSet Seam; ///< The points of seam edges before the first flip.
  std::int64_t Unmatched = 0; ///< Constraints that are not edges of the mesh.
  EdgeTotals Seams; ///< To be added to the sums of the pieces' reports (EdgeTotals).
  std::vector<std::int64_t> FixedAtSeams; ///< The same for all edges there that stay.

  std::vector<std::atomic<double>> Shares; ///< Of the work for each piece that is done.
  std::atomic<bool> GoesOn{ true };
  std::atomic<bool> AreCounted{ true }; ///< Whether no piece was stopped before its edges were.
  std::mutex Mutex; ///< Of what follows, while pieces are flipped.
  std::vector<std::int64_t> Fixed; ///< All edges that stay, but boundary edges: two ids for each.
  std::vector<FlipReport> Reports; ///< Of the pieces.

  PiecesReport Report; ///< Of the whole mesh.
  bool HasBadEdges = false; ///< Whether a session has left some.
};

}

#endif
