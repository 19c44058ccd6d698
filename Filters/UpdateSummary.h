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

/// What became of one mesh.
struct MeshOutcome
{
  UpdateReport Report;
  FlipFailure Failure;
  std::string Trouble; ///< What to warn of, or empty.
};

/// What one update did to all of its meshes, and what is to be told.
struct UpdateSummary
{
  UpdateReport Report; ///< Of the meshes without a failure.
  int Failure = 0; ///< The kind of the first one; 0: none.
  std::vector<Note> Errors;
  std::vector<Note> Warnings;
  std::vector<std::int64_t> Blocks; ///< Numbers of the meshes that have triangles.
  bool HasSeams = false; ///< Whether a mesh lies in pieces, between which no edge can flip.

  /// Adds a mesh: a block of this number, with `where` as notes call it, or, 0 and "", the only
  /// one.
  void AddMesh(const MeshOutcome& mesh, std::int64_t block, const std::string& where);

  /// Adds what another process did at the same time. A block that both have lies in pieces.
  void AddRank(const UpdateSummary& other, int rank);
};

}

#endif
