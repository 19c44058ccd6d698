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

/// The mesh that iterations start from: the caller's mesh, in planar geometry after insertion of
/// the constraints that the caller wants inserted. It is always made on the host, so that it is the
/// same for all backends.
class ConstraintInsertion
{
public:
  /// The defect of constraints that leave the mesh.
  static constexpr const char* LeavesMesh =
    "constraint edges that cannot be inserted because they leave the mesh";

  /// The defect of constraints that are not edges of a surface.
  static constexpr const char* OnSurface =
    "constraint edges that are not edges of the mesh and cannot be inserted on a surface";

  /// For a mesh without constraints to be inserted.
  ConstraintInsertion() = default;

  /// @param progress is told of the insertion; not called if the mesh has all constraints as edges.
  /// @throws as FlipSession's constructor; RunAborted.
  ConstraintInsertion(
    const TriangleMesh& mesh, const FlipOptions& options, const ProgressObserver& progress);

  /// Takes the constraints that leave the mesh out of the refused ones, because the mesh may
  /// continue on other ranks. @returns two point ids for each, in the caller's order.
  std::vector<std::int64_t> TakeLeaving();

  /// About the share of a run that an insertion takes, because it builds an edge mesh of its own.
  static constexpr double ShareOfRun = 0.3;

  /// Whether the insertion has flipped edges.
  bool HasFlips() const { return this->Flips > 0; }

  /// The share of a run that is done after the insertion.
  double GetShare() const { return this->HasFlips() ? ShareOfRun : 0.0; }

  /// The mesh as views of arrays of this object and of the caller.
  TriangleMesh GetMesh(const TriangleMesh& caller) const;

  /// The caller's options, with the geometry that was chosen from the caller's triangles. (Flips
  /// change slopes, so another choice could follow from the new triangles.)
  FlipOptions GetOptions(const FlipOptions& caller) const;

  /// Adds what the report of a run that starts from GetMesh() lacks.
  void AddTo(FlipReport& report) const;
  void AddTo(std::vector<Defect>& defects) const;

  /// Adds, for each triangle slot, the number of flips of the insertion that changed it.
  void AddFlipCounts(std::int32_t* counts) const;

private:
  friend class ConstraintInserter;

  std::vector<std::int32_t> Ids32; ///< Triangles, if the caller's ids have 32 bits and one changed.
  std::vector<std::int64_t> Ids64; ///< If they have 64 bits.
  std::vector<std::pair<std::int64_t, std::int32_t>> FlipCounts; ///< Of triangle slots.
  bool HasEdges = false; ///< Whether Edges replace the caller's constraints.
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
