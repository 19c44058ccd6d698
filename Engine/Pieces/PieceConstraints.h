// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PIECECONSTRAINTS_H
#define DELAUNAYFLIP_PIECECONSTRAINTS_H

#include "ConstraintLoan.h"
#include "FarConstraints.h"
#include "FixedPairs.h"
#include "FlipReport.h"
#include "PieceArrays.h"
#include "PieceJob.h"
#include "PieceMesh.h"
#include "SeamSurvey.h"

#include <cstdint>
#include <vector>

namespace delaunayflip
{

class ConstraintInsertion;
class ConstraintList;
class PieceRegion;

/// The mesh that the first flips start from, and its seams: the caller's or, in planar geometry,
/// one in which those constraints are edges that are to be inserted.
///
/// Each rank first inserts those that stay within its piece. For the others, all triangles that
/// such a constraint touches are lent to one rank, which inserts it and gives them back.
class PieceConstraints
{
public:
  /// All ranks make it together.
  /// @param mesh before its rounds; receives the triangles.
  PieceConstraints(const PieceJob& job, PieceMesh& mesh);

  /// Views of the caller's arrays and of arrays of this object.
  const MeshPiece& GetPiece() const { return this->Piece; }
  SeamSurvey& GetSeams() { return this->Seams; }

  /// Whether an observer wanted to stop: of this rank, or while ranks inserted alone of any.
  bool HasAborted() const { return this->IsAborted; }

  /// The share of a run that is over then.
  double GetShare() const { return this->Share; }

  /// Adds what this rank has inserted and refused.
  void AddTo(FlipReport& report) const;

private:
  struct OwnWork;

  void Run();
  ConstraintInsertion Insert(const TriangleMesh& mesh, double end);
  void InsertOwn(OwnWork& own);
  void LeaveMissing(const TriangleMesh& mesh);
  bool IsLeft(const PointPair& ends) const;
  std::vector<FarConstraint> ListLeft() const;
  void Keep(const OwnWork& own);
  void AddEdge(std::int64_t from, std::int64_t to);
  void InsertFar(const std::vector<FarConstraint>& constraints);
  std::vector<std::int64_t> InsertFar(const InsertionTask& task);
  ConstraintList ListFar(const std::vector<FarConstraint>& constraints, const PieceRegion& region);

  PieceJob Job;
  PieceMesh& Mesh;
  MeshPiece Piece;
  std::vector<FarConstraint> Far; ///< Those that the caller gives as such.
  SeamSurvey Seams;
  bool IsAborted = false;
  double Share = 0.0;
  MarkedEdges Fixed; ///< While constraints are inserted.
  std::vector<PointPair> Left; ///< Ids: those that this rank cannot insert alone, ascending.
  FlipReport Found; ///< The counts and defects of all insertions.
  PieceArrays Arrays;
};

}

#endif
