// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PIECEREGION_H
#define DELAUNAYFLIP_PIECEREGION_H

#include "PieceMesh.h"
#include "PieceSurvey.h"
#include "QuadSoup.h"

#include <cstdint>
#include <vector>

namespace delaunayflip
{

/// Some triangles of a rank as a mesh of their own, with its own numbers of points.
class PieceRegion
{
public:
  /// Some triangles.
  /// @param triangles ascending.
  PieceRegion(
    const PieceMesh& mesh, std::vector<std::int64_t> triangles, const PieceSurvey& survey);

  /// All triangles of a rank, with all of its points.
  PieceRegion(const PieceMesh& mesh, const PieceSurvey& survey);

  /// Views of arrays of this object.
  TriangleMesh View() const;
  std::int64_t GetNumberOfTriangles() const
  {
    return static_cast<std::int64_t>(this->Triangles.size());
  }

  /// The rank's own id of a point.
  std::int32_t GetPoint(std::int64_t number) const { return this->PointOf[number]; }
  /// The region's number of a point, or -1.
  std::int64_t FindPoint(std::int64_t point) const;

  /// Stores the point ids and flip counts that a run on View() has made in the triangles of `mesh`,
  /// between BeginRounds and EndRounds. The marks of the triangles do not change and may be wrong
  /// until EndRounds removes them.
  void Store(const std::vector<std::int32_t>& ids, const std::vector<std::int32_t>& flips,
    PieceMesh& mesh) const;

private:
  void CollectPoints(const PieceMesh& mesh);
  void Describe(const PieceMesh& mesh, const PieceSurvey& survey, bool isWhole);
  void ListFixedEdges(const PieceMesh& mesh);

  WholeMesh Whole;
  std::vector<std::int64_t> Triangles;
  std::vector<std::int32_t> PointOf; ///< By the region's number.
  std::vector<std::int32_t> Ids; ///< Three per triangle, the region's numbers.
  PointList Points;
  std::vector<unsigned char> Shared; ///< As WholeMesh::SharedPoints; empty without a guard.
  std::vector<std::int64_t> FixedEdges;
};

}

#endif
