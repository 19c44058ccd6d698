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

/// Flags of the points of a rank, which are cleared by the same lists that set them.
class PointFlags
{
public:
  void Set(std::int32_t point)
  {
    if (static_cast<std::size_t>(point) >= this->Flags.size())
    {
      this->Flags.resize(point + std::size_t(1) + this->Flags.size() / 2);
    }
    this->Flags[point] = 1;
  }
  void Clear(std::int32_t point) { this->Flags[point] = 0; }
  bool Has(std::int32_t point) const
  {
    return static_cast<std::size_t>(point) < this->Flags.size() && this->Flags[point] != 0;
  }
  int Count(const PieceTriangle& triangle) const
  {
    return int(this->Has(triangle.Points[0])) + int(this->Has(triangle.Points[1])) +
      int(this->Has(triangle.Points[2]));
  }

private:
  std::vector<unsigned char> Flags;
};

/// Some triangles of a rank as a mesh of their own, with its own numbers of points.
class PieceRegion
{
public:
  /// The triangles at some points, and those that share a point with them.
  PieceRegion(const PieceMesh& mesh, const std::vector<std::int32_t>& points, PointFlags& flags,
    const PieceSurvey& survey);

  /// All triangles of a rank, with all of its points.
  PieceRegion(const PieceMesh& mesh, const PieceSurvey& survey);

  /// Views of arrays of this object.
  TriangleMesh View() const;
  std::int64_t GetNumberOfTriangles() const
  {
    return static_cast<std::int64_t>(this->Triangles.size());
  }

  /// Gives the triangles of `mesh` the ids and flips of a run on View(), and their marks.
  void Store(const std::vector<std::int32_t>& ids, const std::vector<std::int32_t>& flips,
    PieceMesh& mesh) const;

  /// The points of changed triangles at which there may be triangles outside the region. Edges at
  /// them must be judged again.
  std::vector<std::int32_t> FindNext(
    const std::vector<std::int32_t>& ids, const std::vector<std::int32_t>& flips) const;

private:
  void Collect(const PieceMesh& mesh, const std::vector<std::int32_t>& points, PointFlags& flags);
  void Describe(const PieceMesh& mesh, const PieceSurvey& survey);
  void NumberPoints(const PieceMesh& mesh);
  void ListFixedEdges(const PieceMesh& mesh);

  WholeMesh Whole;
  std::vector<std::int64_t> Triangles; ///< Their places in the piece, ascending.
  std::vector<std::int32_t> PointOf; ///< By the region's number.
  std::vector<unsigned char> Inner; ///< By that number: whether all triangles at it are here.
  std::vector<std::int32_t> Ids; ///< Three per triangle, the region's numbers.
  PointList Points;
  std::vector<unsigned char> Shared; ///< As WholeMesh::SharedPoints; empty without a guard.
  std::vector<std::int64_t> FixedEdges;
};

}

#endif
