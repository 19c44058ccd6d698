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
  /// @param triangles where flips change them: the array of the mesh, or another one.
  /// @param options whose threads are used.
  /// @throws InvalidMesh, InvalidOptions; then nothing has been copied.
  MeshInPieces(const TriangleMesh& mesh, const MutableTriangleArray& triangles,
    const FlipOptions& options, int pieces);

  const TriangleMesh& View() const { return this->Mesh; }
  const MutableTriangleArray& GetTriangles() const { return this->Triangles; }
  int GetNumberOfPieces() const { return this->Pieces; }
  const PieceSurvey& GetSurvey() const { return this->Survey; }
  std::int64_t GetUsedPoints() const { return this->UsedPoints; }
  /// What is wrong with ids and coordinates.
  const std::vector<Defect>& GetDefects() const { return this->Defects; }
  const ThreadBackend& GetThreads() const { return this->Threads; }

  SubMesh GetPiece(int piece) const;
  /// The points that triangles of several pieces have at the moment.
  PointSet FindSeamPoints() const;
  /// The triangles at some points.
  SubMesh GetTrianglesAt(const PointSet& points) const;
  /// Those triangles of another sub-mesh that belong to a piece.
  SubMesh GetPieceOf(const SubMesh& part, int piece) const;
  /// The points of those triangles.
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
