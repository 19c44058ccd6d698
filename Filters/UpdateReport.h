// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef UpdateReport_h
#define UpdateReport_h

#include "FlipReport.h"
#include "Notes.h"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace delaunayflip
{

/// What an update did to a mesh, or the sum over several meshes: the blocks of a composite dataset
/// or the pieces of several processes.
struct UpdateReport : FlipReport
{
  UpdateReport() = default;
  explicit UpdateReport(FlipReport report)
    : FlipReport(std::move(report))
  {
  }

  /// Whether two meshes were flipped one after the other or at the same time.
  enum class Timing
  {
    InTurn,
    AtOnce
  };

  /// Adds the report of another mesh. Counts are summed, those of iterations row by row; the stop
  /// reason is the worse of the two, and angles are the smaller ones. Ids of defects are dropped:
  /// they mean nothing outside their mesh.
  void Add(const UpdateReport& other, Timing timing);

  /// GeometryUsed in words, or "mixed".
  const char* GetGeometryName() const;

  bool HasMixedGeometry = false; ///< GeometryUsed is then that of the first mesh.
  std::int64_t Rounds = 0; ///< PiecesReport's; 0 if the mesh was not flipped in pieces.
  std::int64_t MovedTriangles = 0;
};

/// The outcome of an update for one mesh.
struct MeshOutcome
{
  UpdateReport Report;
  FlipFailure Failure;
  std::string Trouble; ///< The text of a warning, or empty.
};

/// What one update did to all of its meshes, and the messages about it.
struct UpdateSummary
{
  UpdateReport Report; ///< The sum over the meshes without a failure.
  int Failure = 0; ///< The kind of the first one; 0: none.
  std::vector<Note> Errors;
  std::vector<Note> Warnings;
  std::vector<std::int64_t> Blocks; ///< Numbers of the meshes that have triangles.
  bool HasSeams = false; ///< Whether some mesh is divided into pieces, whose seams never flip.

  /// Adds a mesh: the block with this number, which notes call `where`; or 0 and "" if it is the
  /// only mesh.
  void AddMesh(const MeshOutcome& mesh, std::int64_t block, const std::string& where);

  /// Adds what another process did at the same time. A block that both have is divided into pieces.
  void AddRank(const UpdateSummary& other, int rank);
};

}

#endif
