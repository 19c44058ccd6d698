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

/// The mesh that the first flips start from, and its seams. In planar geometry, this is the
/// caller's mesh after insertion of the constraints that are to be inserted; otherwise the caller's
/// mesh.
///
/// Each rank first inserts the constraints that stay within its piece. For any other constraint,
/// all triangles that it touches are lent to one rank, which inserts it and returns the triangles.
class PieceConstraints
{
public:
  /// All ranks must call this together.
  /// @param mesh before BeginRounds; receives the changed triangles.
  PieceConstraints(const PieceJob& job, PieceMesh& mesh);

  /// Views of the caller's arrays and of arrays of this object.
  const MeshPiece& GetPiece() const { return this->Piece; }
  SeamSurvey& GetSeams() { return this->Seams; }

  /// Whether the observer of this rank wanted to stop; or that of any rank, while ranks inserted
  /// alone.
  bool HasAborted() const { return this->IsAborted; }

  /// The share of the run that is done after the insertion.
  double GetShare() const { return this->Share; }

  /// Adds the constraints that this rank has inserted and refused.
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
  std::vector<FarConstraint> Far; ///< MeshPiece::FarConstraints.
  SeamSurvey Seams;
  bool IsAborted = false;
  double Share = 0.0;
  MarkedEdges Fixed; ///< The fixed edges while constraints are inserted.
  std::vector<PointPair>
    Left; ///< Ids of constraints that this rank cannot insert alone, ascending.
  FlipReport Found; ///< The counts and defects of all insertions.
  PieceArrays Arrays;
};

}

#endif
