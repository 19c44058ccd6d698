// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PIECEFLIP_H
#define DELAUNAYFLIP_PIECEFLIP_H

#include "EngineExport.h"
#include "FlipOptions.h"
#include "FlipReport.h"
#include "PieceGroup.h"
#include "TriangleMesh.h"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

/// @file
/// Flips one mesh in pieces. FlipPiece does so on several ranks, which are processes or threads:
/// every rank holds a piece, and the edges between pieces flip too. FlipInPieces divides a mesh of
/// one process, and flips one piece after the other:
///
///     const double xyz[] = { 0, 0, 0, 2, -1, 0, 4, 0, 0, 2, 1, 0 };
///     std::int32_t ids[] = { 0, 1, 2, 0, 2, 3 };
///     TriangleMesh mesh;
///     mesh.Points = PointArray(xyz, 4);
///     mesh.Triangles = TriangleArray(ids, 2);
///     FlipOptions options;
///     options.NumberOfPieces = 2;
///     const PiecesReport report = FlipInPieces(mesh, options, MutableTriangleArray(ids, 2));
///     report.SeamEdges; // 1
///     report.TotalFlips; // 1

namespace delaunayflip
{

/// Names a triangle or a point by the rank that gave it.
struct PieceOrigin
{
  std::int32_t Rank;
  std::int64_t Id; ///< Its id on that rank.
};

/// The piece of one rank. It may be empty. Triangles must not be repeated on several ranks.
struct MeshPiece
{
  /// Regions must have the same labels on all ranks. Any rank that has both ends of a constraint
  /// edge may give it, even if none of its triangles has them. Several ranks may give the same one.
  /// A constraint that is to be inserted becomes an edge if it stays within the piece of one rank;
  /// otherwise it counts as unmatched. Where flips could make an edge that another rank has, as
  /// where triangles overlap or have no area, no rank inserts any. So insert constraints before the
  /// mesh is divided.
  TriangleMesh Mesh;

  /// One number per point, the same for a point on all ranks that have it; or null. If no rank has
  /// numbers, points at the borders of pieces are the same if their coordinates are equal.
  const std::int64_t* PointNumbers = nullptr;
};

/// The piece of one rank after a run. Triangles change owner, so that it may have more or fewer
/// triangles than before.
struct FlippedPiece
{
  /// Three point ids per triangle: first those that the rank has kept, in their order, then those
  /// that it has received. An id that is not less than the number of its own points names a
  /// received point.
  std::vector<std::int32_t> Triangles;
  std::vector<std::int32_t> FlipCounts; ///< One per triangle.
  std::vector<std::int64_t> GoneTriangles; ///< Slots of given ones that left, ascending.
  std::vector<PieceOrigin> ReceivedTriangles; ///< The slots in which they were given.

  std::vector<PieceOrigin> ReceivedPoints; ///< The points of other ranks that its triangles need.
  std::vector<double> ReceivedCoordinates; ///< x, y and z of each.
  bool AreFloats = true; ///< Whether the points of all ranks have the precision of float.

  /// Empties all arrays, but keeps their memory.
  DELAUNAYFLIP_EXPORT void Clear();
};

/// @returns for each triangle, in their order, the rank and the slot in which it was given.
/// @param rank the rank that has this piece.
DELAUNAYFLIP_EXPORT std::vector<PieceOrigin> ListOrigins(const FlippedPiece& flipped, int rank);

/// Tells which points of several pieces are the same.
struct JoinedPoints
{
  /// For each point of all pieces, numbered one piece behind the other: the first that is the same.
  std::vector<std::int64_t> Same;
  /// How many coincide with others of their piece and with a point of another one. It is not known
  /// which of them are the same, so they stay apart.
  std::int64_t Ambiguous = 0;
};

/// Finds the points of pieces of one process that are the same. They have the same number. If a
/// piece with points has no numbers, they are at the same place, and at least one of them is at the
/// border of its piece. Points that neither a triangle nor a constraint has are not compared.
/// @param pieces with valid ids.
DELAUNAYFLIP_EXPORT JoinedPoints JoinPoints(const std::vector<MeshPiece>& pieces);

/// The report of the whole mesh, which is the same on every rank.
struct PiecesReport : FlipReport
{
  /// How often the pieces flipped and then tested the edges between them. 1: no such edge was bad.
  std::int64_t Rounds = 0;
  std::int64_t MovedTriangles = 0; ///< How many times a triangle changed owner.
  std::int64_t SeamEdges = 0; ///< Edges between pieces at the beginning.
  /// Points at the borders of pieces that coincide with others of the same piece. Without numbers
  /// it is not known which of them are the same, so the edges there stay.
  std::int64_t AmbiguousPoints = 0;
};

/// Compares the options of all ranks. Which hardware a rank uses is its own affair: backend,
/// threads, devices and NumberOfPieces may differ. All ranks of the group must call this together.
/// @param more names and values of settings of the caller, compared in the same way.
/// @throws InvalidOptions on every rank if some differ: it names the first of them and two ranks.
DELAUNAYFLIP_EXPORT void RequireSameOptions(const FlipOptions& options, PieceGroup& group,
  const std::vector<std::pair<std::string, std::string>>& more = {});

/// Flips a mesh to the end, or until a progress observer of any rank stops it. All ranks of the
/// group must call this together, with the same options (see RequireSameOptions).
/// FlipOptions::NumberOfPieces and TrackQuality have no effect: the smallest angle is known before
/// the first iteration and after the last. Iterations of several ranks at the same time count as
/// one. FlipOptions::MaximumIterations of them are made at most, over all rounds.
///
/// In planar geometry with TieRuleKind::Canonical the triangles with an area are those that one
/// rank would make. Otherwise the result depends on how the mesh is divided, and on nothing else.
/// @param flipped receives this rank's piece. Its contents are lost, and its memory is used again,
/// so the piece must not refer to its arrays. Its contents are undefined after an exception.
/// @throws on every rank if one fails, with its number: what FlipSession's constructor and
/// RequireSameOptions throw.
DELAUNAYFLIP_EXPORT PiecesReport FlipPiece(const MeshPiece& piece, const FlipOptions& options,
  PieceGroup& group, FlippedPiece& flipped, const ProgressObserver& progress = {});

/// Flips a mesh of one process in FlipOptions::NumberOfPieces pieces, in place: FlipToDelaunay does
/// the same with a copy of the triangles. So the mesh may be larger than the memory of a GPU and
/// have more than 715 million triangles. Constraints are inserted before, if it has no more
/// triangles than that.
///
/// The pieces are next to each other. They are flipped one after the other on each GPU; while one
/// is on a GPU, the next is prepared. Afterwards the triangles around the edges between them are
/// flipped, as far as flips reach.
/// @param triangles receives the result: the array that mesh.Triangles views, or another one. It
/// has valid triangles of the same surface at any time after InvalidMesh and InvalidOptions have
/// been ruled out, so also if another exception ends the run or `progress` stops it.
/// @returns the report of the whole mesh. Rounds are 1 and the number of times that triangles
/// between pieces were flipped; MovedTriangles is 0. The seconds are those of a GPU's pieces.
/// @throws as FlipSession's constructor.
DELAUNAYFLIP_EXPORT PiecesReport FlipInPieces(const TriangleMesh& mesh, const FlipOptions& options,
  const MutableTriangleArray& triangles, const ProgressObserver& progress = {});

}

#endif
