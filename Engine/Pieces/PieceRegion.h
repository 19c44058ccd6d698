// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PIECEREGION_H
#define DELAUNAYFLIP_PIECEREGION_H

#include "IdSet.h"
#include "PieceMesh.h"
#include "PieceSurvey.h"
#include "QuadSoup.h"

#include <cstdint>
#include <vector>

namespace delaunayflip
{

/// Room that regions use one after the other. The sets are empty between two regions, so that a
/// region takes no time for the rest of the piece.
struct RegionScratch
{
  std::vector<std::int32_t> Numbers; ///< By point: that of the region, if it has one.
  IdSet Triangles, Points, Inner;
};

/// Some triangles of a rank as a mesh of their own, with its own numbers of points.
class PieceRegion
{
public:
  /// The triangles at some points, and those that share a point with them.
  PieceRegion(const PieceMesh& mesh, const std::vector<std::int32_t>& points,
    const PieceSurvey& survey, RegionScratch& scratch);

  /// Some triangles.
  /// @param triangles ascending.
  PieceRegion(const PieceMesh& mesh, std::vector<std::int64_t> triangles, const PieceSurvey& survey,
    RegionScratch& scratch);

  /// All triangles of a rank, with all of its points.
  PieceRegion(const PieceMesh& mesh, const PieceSurvey& survey);

  /// Views of arrays of this object.
  TriangleMesh View() const;
  std::int64_t GetNumberOfTriangles() const
  {
    return static_cast<std::int64_t>(this->Triangles.size());
  }

  /// Their places in the piece, ascending.
  const std::vector<std::int64_t>& GetTriangles() const { return this->Triangles; }
  /// The rank's own id of a point.
  std::int32_t GetPoint(std::int64_t number) const { return this->PointOf[number]; }
  /// The region's number of a point, or -1.
  std::int64_t FindPoint(std::int64_t point) const;

  /// Gives the triangles of `mesh` the ids and flips of a run on View(), and their marks.
  void Store(const std::vector<std::int32_t>& ids, const std::vector<std::int32_t>& flips,
    PieceMesh& mesh) const;

  /// The points of changed triangles at which there may be triangles outside the region. Edges at
  /// them must be judged again.
  std::vector<std::int32_t> FindNext(
    const std::vector<std::int32_t>& ids, const std::vector<std::int32_t>& flips) const;

private:
  void Collect(
    const PieceMesh& mesh, const std::vector<std::int32_t>& points, RegionScratch& scratch);
  void CollectPoints(const PieceMesh& mesh, RegionScratch& scratch);
  void Describe(const PieceMesh& mesh, const PieceSurvey& survey);
  void ListFixedEdges(const PieceMesh& mesh);

  WholeMesh Whole;
  std::vector<std::int64_t> Triangles;
  std::vector<std::int32_t> PointOf; ///< By the region's number.
  std::vector<unsigned char> Inner; ///< By that number: whether all triangles at it are here.
  std::vector<std::int32_t> Ids; ///< Three per triangle, the region's numbers.
  PointList Points;
  std::vector<unsigned char> Shared; ///< As WholeMesh::SharedPoints; empty without a guard.
  std::vector<std::int64_t> FixedEdges;
};

}

#endif
