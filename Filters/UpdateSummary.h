// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef UpdateSummary_h
#define UpdateSummary_h

#include "FlipFailure.h"
#include "Notes.h"
#include "UpdateReport.h"

#include <cstdint>
#include <string>
#include <vector>

namespace delaunayflip
{

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
