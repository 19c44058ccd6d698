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

/// The flips of a rank in a round. They are made one by one, starting from some triangles and going
/// on as long as an edge of a changed triangle is bad. Other triangles take no time.
class RoundFlips
{
public:
  /// @param needsGuard PieceSurvey::NeedsGuard. If true, an edge does not flip if this rank has, or
  /// another rank may have, the edge that the flip would make.
  RoundFlips(PieceMesh& mesh, const QuadJudge& judge, bool needsGuard)
    : Mesh(mesh),
      Rule(judge),
      NeedsGuard(needsGuard)
  {
  }

  /// Adds a triangle whose edges are to be judged.
  void Add(std::int64_t triangle);
  /// Adds the triangles of edges that could not flip while the rank had this edge, now gone.
  void AddFreed(std::int32_t from, std::int32_t to);

  /// Whether no edge is left to be judged.
  bool AreDone() const { return this->Next.empty(); }
  /// The triangles whose edges will be judged next.
  const std::vector<std::int64_t>& GetNext() const { return this->Next; }

  /// Judges the edges of GetNext() and flips the bad ones, but changes each triangle at most once.
  /// Triangles that have changed are the next ones.
  /// @returns the record of the iteration, without its number and the smallest angle.
  IterationRecord Iterate();

  /// Whether an edge of GetNext() is bad and may flip.
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
