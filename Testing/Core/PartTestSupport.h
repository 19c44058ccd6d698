// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PARTTESTSUPPORT_H
#define DELAUNAYFLIP_PARTTESTSUPPORT_H

#include "FlipTestSupport.h"
#include "MeshDivision.h"
#include "PieceFlip.h"

/// @file
/// Meshes that are flipped in parts: on ranks, which are threads here, or one part after the other.

namespace delaunayflip
{

/// Planar, with canonical ties, on one thread per rank: the triangles are unique.
FlipOptions MakeCanonical(int pieces = 0);

/// On a surface, on one thread per rank.
FlipOptions OnSurfaceOfRanks(double featureAngle = 180.0);

/// Every triangle to any rank: the worst there is.
Owners DivideAtRandom(const TriangleMesh& mesh, int ranks, std::uint32_t seed = 21);

/// What all parts together made, in the slots of the whole mesh.
struct PartsResult
{
  std::vector<std::int32_t> Triangles;
  std::vector<std::int32_t> FlipCounts;
  PiecesReport Report; ///< All ranks have this one.
  std::vector<std::int64_t> Sizes; ///< How many triangles every rank has in the end.
};

/// Flips a divided mesh by as many threads as it has pieces. Reports a failure for a triangle that
/// is lost or comes twice, for points with other coordinates, and for reports that differ.
PartsResult FlipDivided(const TriangleMesh& mesh, const std::vector<OwnPiece>& pieces,
  const FlipOptions& options, bool withNumbers = true);

/// Flips a mesh of this process, part by part.
PartsResult FlipHere(
  const TriangleMesh& mesh, int parts, FlipOptions options, const ProgressObserver& progress = {});

void ExpectSameOnAllRanks(const std::vector<PiecesReport>& reports);

/// Reports a failure for everything that does not depend on the order of flips, and differs.
void ExpectSameCounts(const FlipReport& alone, PiecesReport together);

/// For meshes with a unique result: expects the triangles and counts of a run on the whole mesh.
void ExpectAsAlone(
  const TriangleMesh& mesh, const FlipOptions& options, const PartsResult& together);

/// For meshes with a result that depends on the order of flips: expects the counts of a run on the
/// whole mesh, that nothing is broken, and that no edge is left that may flip.
void ExpectGood(const TriangleMesh& mesh, const FlipOptions& options, const PartsResult& together);

/// Expects that a run on the whole result, with the edges fixed that are fixed in the input, finds
/// what the report says and nothing to flip.
void ExpectNothingLeft(const TriangleMesh& mesh, FlipOptions options, const PartsResult& together);

}

#endif
