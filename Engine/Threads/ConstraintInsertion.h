// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_CONSTRAINTINSERTION_H
#define DELAUNAYFLIP_CONSTRAINTINSERTION_H

#include "FlipOptions.h"
#include "FlipReport.h"
#include "SpatialOrder.h"
#include "ThreadBackend.h"
#include "TriangleMesh.h"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace delaunayflip
{

enum class PathResult;
struct MissingConstraints;

/// Why a constraint is not inserted.
enum class Refusal : char
{
  LeavesMesh,
  LeavesPart, ///< It leaves the part of this rank, and perhaps the mesh, too.
  CrossesFixedEdge,
  MeetsOverlap,
  NeedsGuard, ///< Flips might make edges that other ranks have (WholeMesh::SharedPoints).
  OnSurface
};

struct RefusedConstraint
{
  std::int64_t Ends[2]; ///< Point ids.
  Refusal Why;
  CrossedEdge Crossed = {}; ///< Known for the first ones that cross an edge.
};

/// Adds a defect for every reason, which names the first constraints.
void AddDefects(const std::vector<RefusedConstraint>& refused, std::vector<Defect>& defects);

/// The mesh that iterations start from: the caller's mesh, in planar geometry after insertion of
/// the constraints that the caller wants inserted. It is always made on the host, so that it is the
/// same for all backends.
class ConstraintInsertion
{
public:
  /// For a mesh without constraints to be inserted.
  ConstraintInsertion() = default;

  /// Whether flips may have to make constraint edges. @param edges with ConstraintsToInsert.
  static bool IsRequested(const FixedEdges& edges);

  /// @param observer is told of the insertion; not called if the mesh has all constraints as edges.
  /// @throws as FlipSession's constructor; RunAborted.
  ConstraintInsertion(
    const TriangleMesh& mesh, const FlipOptions& options, const ProgressObserver& observer);

  std::int64_t GetNumberOfFlips() const { return this->Flips; }
  /// The numbers of the constraints that were no edges, or are refused, ascending; only the first
  /// of equal ones.
  const std::vector<std::int64_t>& GetTried() const { return this->Tried; }
  /// Those of them that are not inserted, in the caller's order.
  const std::vector<RefusedConstraint>& GetRefused() const { return this->Refused; }

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

  /// Adds, for each triangle slot, the number of flips of the insertion that changed it.
  void AddFlipCounts(std::int32_t* counts) const;

private:
  void RefuseAll(const TriangleMesh& mesh, const MissingConstraints& missing, Refusal why);
  void Refuse(const TriangleMesh& mesh, std::int64_t constraint, Refusal why);
  void Take(const TriangleMesh& mesh, std::int64_t constraint, PathResult result, bool wasMissing);
  void Store(const EdgeMesh& edges, const SpatialOrderView& order, const ThreadBackend& backend);

  std::vector<std::int64_t> Triangles; ///< Ids, if one has changed.
  std::vector<std::pair<std::int64_t, std::int32_t>>
    FlipCounts; ///< Triangle slots and their counts.
  std::vector<std::int64_t> Edges; ///< Pairs of vertex ids, if some were tried.
  GeometryKind Geometry = GeometryKind::Auto;
  std::string GeometryReason;
  std::int64_t Flips = 0;
  std::vector<std::int64_t> Tried;
  std::vector<RefusedConstraint> Refused;
};

/// Constraint edges that are to be inserted and are no edges of the mesh.
struct MissingConstraints
{
  std::vector<std::int64_t> First; ///< Their numbers, ascending; of equal ones the first.
  std::vector<std::int64_t> Wanted; ///< The numbers of all that are to be inserted, edges or not.
  std::vector<bool> IsMissing; ///< For every constraint edge; also of equal ones.
};

/// Does not trust the ids of triangles.
/// @throws InvalidMesh for a constraint that names no point.
MissingConstraints FindMissingConstraints(const TriangleMesh& mesh, const ThreadBackend& backend);

}

#endif
