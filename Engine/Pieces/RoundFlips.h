// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_ROUNDFLIPS_H
#define DELAUNAYFLIP_ROUNDFLIPS_H

#include "FlipReport.h"
#include "PieceMesh.h"
#include "QuadJudge.h"

#include <cstdint>
#include <vector>

namespace delaunayflip
{

/// The flips of a rank in a round: edge by edge in the mesh of the rank, from some triangles on and
/// as far as flips reach, so that other triangles take no time.
class RoundFlips
{
public:
  /// @param needsGuard PieceSurvey::NeedsGuard. Then an edge does not flip if the rank has the edge
  /// that this would make, or if another rank may have it.
  RoundFlips(PieceMesh& mesh, const QuadJudge& judge, bool needsGuard)
    : Mesh(mesh),
      Rule(judge),
      NeedsGuard(needsGuard)
  {
  }

  /// The edges of a triangle must be judged.
  void Add(std::int64_t triangle);
  /// So must those that could not flip while the rank had this edge.
  void AddFreed(std::int32_t from, std::int32_t to);

  /// Whether no edge is left to be judged.
  bool AreDone() const { return this->Next.empty(); }
  /// The triangles whose edges will be judged next.
  const std::vector<std::int64_t>& GetNext() const { return this->Next; }

  /// Judges the edges of these triangles and flips those that are bad, but each triangle at most
  /// once; those that have changed are the next.
  /// @returns what was done; without Iteration and angle.
  IterationRecord Iterate();

  /// Whether an edge of these triangles is bad and may flip.
  bool HasBad();

private:
  void Visit(std::int64_t triangle, IterationRecord& record);
  EdgeState Judge(const PieceCorner& one, const PieceCorner& other) const;
  bool IsForbidden(std::int32_t a, std::int32_t b) const;
  void Flip(const PieceCorner& one, const PieceCorner& other);

  PieceMesh& Mesh;
  const QuadJudge& Rule;
  bool NeedsGuard;
  std::vector<std::int64_t> Next;
};

}

#endif
