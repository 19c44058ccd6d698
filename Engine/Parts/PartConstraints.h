// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PARTCONSTRAINTS_H
#define DELAUNAYFLIP_PARTCONSTRAINTS_H

#include "ConstraintInsertion.h"
#include "FlipReport.h"
#include "PartMesh.h"
#include "SeamSurvey.h"

#include <cstdint>
#include <vector>

namespace delaunayflip
{

/// The mesh that the first flips start from, and its seams. In planar geometry, this is the
/// caller's mesh after insertion of the constraints that are to be inserted; otherwise the caller's
/// mesh.
///
/// Each rank inserts the constraints that stay within its part. Of those between shared points,
/// which several ranks may have, it tries all whose two points it has. A constraint that no rank
/// inserts counts as unmatched, once. Where flips need a guard, ranks insert nothing.
class PartConstraints
{
public:
  /// All ranks must call this together.
  /// @param mesh before BeginRounds; receives the changed triangles.
  PartConstraints(const PartJob& job, PartMesh& mesh);

  MeshPiece Piece; ///< Views of the caller's arrays and of arrays of this object.
  SeamSurvey Seams;
  bool IsAborted = false; ///< Whether an observer of any rank has stopped the insertion.
  double Share = 0.0; ///< Of the run that is done after the insertion.

  /// Adds the constraints that this rank has inserted and refused.
  void AddTo(FlipReport& report) const;

private:
  void Run();
  ConstraintInsertion Insert(const TriangleMesh& mesh);
  void Count(const ConstraintInsertion& insertion, std::vector<char> fates);
  void Keep(const ConstraintInsertion& insertion, const TriangleMesh& mesh, std::int64_t known);

  PartJob Job;
  PartMesh& Mesh;
  std::int64_t Inserted = 0;
  std::int64_t Flips = 0;
  std::vector<RefusedConstraint> Refused; ///< Those that this rank counts.

  // What Piece views:
  std::vector<std::int64_t> Constraints;
  std::vector<std::int32_t> Ids;
};

}

#endif
