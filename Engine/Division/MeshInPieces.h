// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_MESHINPIECES_H
#define DELAUNAYFLIP_MESHINPIECES_H

#include "Array.h"
#include "FlipOptions.h"
#include "PieceSurvey.h"
#include "PointSet.h"
#include "SubMesh.h"
#include "ThreadBackend.h"
#include "TriangleMesh.h"

#include <cstdint>
#include <vector>

namespace delaunayflip
{

void CopyTriangles(
  const TriangleArray& from, const MutableTriangleArray& to, const ThreadBackend& threads);

/// A mesh whose triangle slots are divided among pieces. Flips change its triangles in place.
class MeshInPieces
{
public:
  /// Surveys the mesh as a whole, divides it, and copies its triangles.
  /// @param triangles receives the copy, which flips change. May be the mesh's own array.
  /// @param options whose threads are used.
  /// @throws InvalidMesh, InvalidOptions, both before anything is copied.
  MeshInPieces(const TriangleMesh& mesh, const MutableTriangleArray& triangles,
    const FlipOptions& options, int pieces);

  const TriangleMesh& View() const { return this->Mesh; }
  const MutableTriangleArray& GetTriangles() const { return this->Triangles; }
  int GetNumberOfPieces() const { return this->Pieces; }
  const PieceSurvey& GetSurvey() const { return this->Survey; }
  std::int64_t GetUsedPoints() const { return this->UsedPoints; }
  /// Defects of point ids and coordinates.
  const std::vector<Defect>& GetDefects() const { return this->Defects; }
  const ThreadBackend& GetThreads() const { return this->Threads; }

  SubMesh GetPiece(int piece) const;
  /// The points that triangles of several pieces share at the moment.
  PointSet FindSeamPoints() const;
  /// The triangles that have one of these points.
  SubMesh GetTrianglesAt(const PointSet& points) const;
  /// The triangles of a sub-mesh that belong to one piece.
  SubMesh GetPieceOf(const SubMesh& part, int piece) const;
  /// All points of the triangles that have one of these points.
  PointSet FindPointsAround(const PointSet& points) const;

private:
  void Examine(const FlipOptions& options);
  std::vector<int> GetAxes() const;
  void Divide();

  TriangleMesh Mesh;
  MutableTriangleArray Triangles;
  int Pieces;
  ThreadBackend Threads;
  PieceSurvey Survey;
  std::int64_t UsedPoints = 0;
  std::vector<Defect> Defects;
  Array<unsigned char> PieceOf; ///< By triangle slot.
};

}

#endif
