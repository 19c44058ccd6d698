// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_CONSTRAINTINSERTION_H
#define DELAUNAYFLIP_CONSTRAINTINSERTION_H

#include "FlipOptions.h"
#include "FlipReport.h"
#include "TriangleMesh.h"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace delaunayflip
{

/// The mesh that iterations start from: the caller's, or in planar geometry one in which those
/// constraints are edges that the caller wants inserted. The same for all backends, which is why
/// the host makes it.
class ConstraintInsertion
{
public:
  /// What is said of constraints that leave the mesh.
  static constexpr const char* LeavesMesh =
    "constraint edges that cannot be inserted because they leave the mesh";

  /// What is said of those that are no edges of a surface.
  static constexpr const char* OnSurface =
    "constraint edges that are not edges of the mesh and cannot be inserted on a surface";

  /// Nothing is to be inserted.
  ConstraintInsertion() = default;

  /// @param progress of the insertion; not told where the mesh has all the edges.
  /// @throws as FlipSession's constructor; RunAborted.
  ConstraintInsertion(
    const TriangleMesh& mesh, const FlipOptions& options, const ProgressObserver& progress);

  /// The constraints that leave the mesh, two points for each, in their order. From now on they
  /// are not refused: the mesh may go on elsewhere.
  std::vector<std::int64_t> TakeLeaving();

  /// The share of a run that an insertion takes: it builds an edge mesh of its own.
  static constexpr double ShareOfRun = 0.3;

  /// Whether constraints were inserted, which takes time.
  bool HasFlips() const { return this->Flips > 0; }

  /// The share of a run that is over when the mesh is there.
  double GetShare() const { return this->HasFlips() ? ShareOfRun : 0.0; }

  /// Views of this and of the caller's arrays.
  TriangleMesh GetMesh(const TriangleMesh& caller) const;

  /// With the geometry that the caller's triangles have, for flips change slopes.
  FlipOptions GetOptions(const FlipOptions& caller) const;

  /// What the report of a run that starts from GetMesh() does not say.
  void AddTo(FlipReport& report) const;
  void AddTo(std::vector<Defect>& defects) const;

  /// Adds how many of the flips each triangle slot was part of.
  void AddFlipCounts(std::int32_t* counts) const;

private:
  friend class ConstraintInserter;

  std::vector<std::int32_t> Ids32; ///< Triangles, if the caller's ids have 32 bits and one changed.
  std::vector<std::int64_t> Ids64; ///< If they have 64 bits.
  std::vector<std::pair<std::int64_t, std::int32_t>> FlipCounts; ///< Of triangle slots.
  bool HasEdges = false; ///< Whether Edges are the constraints, else the caller's are.
  std::vector<std::int64_t> Edges; ///< Pairs of vertex ids.
  GeometryKind Geometry = GeometryKind::Auto;
  std::string GeometryReason;
  std::int64_t Inserted = 0;
  std::int64_t Flips = 0;
  std::vector<Defect> Refused;
  std::vector<std::int64_t> Leaving; ///< Two points for each.
};

}

#endif
