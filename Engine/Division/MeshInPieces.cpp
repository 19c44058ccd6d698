// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "MeshInPieces.h"

#include "FixedEdges.h"
#include "InputChecks.h"
#include "MeshSurveyBuilder.h"
#include "PieceCuts.h"
#include "WholeStars.h"

#include <utility>

namespace delaunayflip
{

void CopyTriangles(
  const TriangleArray& from, const MutableTriangleArray& to, const ThreadBackend& threads)
{
  if (from.Data() != to.Data())
  {
    threads.ForEach(from.Count,
      [&](std::int64_t t)
      {
        for (int slot = 0; slot < 3; ++slot)
        {
          to.Set(t, slot, from.Get(t, slot));
        }
      });
  }
}

MeshInPieces::MeshInPieces(const TriangleMesh& mesh, const MutableTriangleArray& triangles,
  const FlipOptions& options, int pieces)
  : Mesh(mesh),
    Triangles(triangles),
    Pieces(pieces),
    Threads(options.NumberOfThreads)
{
  this->Examine(options);
  this->Divide();
  CopyTriangles(mesh.Triangles, triangles, this->Threads);
  this->Mesh.Triangles = triangles.Ids32 ? TriangleArray(triangles.Ids32, triangles.Count)
                                         : TriangleArray(triangles.Ids64, triangles.Count);
}

void MeshInPieces::Examine(const FlipOptions& options)
{
  for (std::int64_t i = 0; i < 2 * this->Mesh.NumberOfConstraintEdges; ++i)
  {
    CheckConstraint(this->Mesh, i / 2, static_cast<int>(i % 2));
  }
  const MeshSurvey found =
    BuildMeshSurvey(MeshInput{ this->Mesh, this->Mesh }, options.Geometry, this->Threads);
  CheckTieRule(options, found.Geometry);
  this->Survey.Geometry = found.Geometry;
  this->Survey.GeometryReason = found.GeometryReason;
  this->Survey.Projection = found.Projection;
  this->Survey.NearlyHeightField = found.NearlyHeightField;
  this->Survey.Range = found.Range;
  this->Survey.IsFloat = this->Mesh.Points.Floats != nullptr;
  if (found.Geometry == GeometryKind::Planar)
  {
    this->Survey.Whole.PlaneAxis = found.Projection.AxisW;
    this->Survey.Whole.PlaneIsTilted = found.Projection.Tilted;
  }
  if (found.Geometry != GeometryKind::Surface)
  {
    SurveyStars(this->Mesh, found.Projection, this->Threads, this->Survey.Whole);
  }
  this->Mesh.Whole = this->Survey.Whole;
  this->UsedPoints = found.UsedPoints;
  for (const Defect& defect : { found.RepeatedIds, found.NonFinitePoints, found.NearlyHeightField })
  {
    if (defect.Count > 0)
    {
      this->Defects.push_back(defect);
    }
  }
}

/// Those along which the mesh may be cut: in planar geometry not across its plane.
std::vector<int> MeshInPieces::GetAxes() const
{
  std::vector<int> axes;
  for (int axis = 0; axis < 3; ++axis)
  {
    if (this->Survey.Geometry == GeometryKind::Surface || axis != this->Survey.Projection.AxisW)
    {
      axes.push_back(axis);
    }
  }
  return axes;
}

void MeshInPieces::Divide()
{
  const std::int64_t count = this->Mesh.Triangles.Count;
  const PieceCuts cuts(this->Mesh, this->GetAxes(), this->Pieces);
  this->PieceOf = this->Threads.MakeArray<unsigned char>(count);
  this->Threads.ForEach(count,
    [&](std::int64_t t)
    { this->PieceOf[t] = static_cast<unsigned char>(cuts.FindPiece(this->Mesh, t)); });
}

SubMesh MeshInPieces::GetPiece(int piece) const
{
  const auto isIn = [&](std::int64_t t) { return this->PieceOf[t] == piece; };
  return SubMesh(
    this->Mesh, ListNumbers(this->Mesh.Triangles.Count, isIn, this->Threads), this->Threads);
}

SubMesh MeshInPieces::GetPieceOf(const SubMesh& part, int piece) const
{
  const auto isIn = [&](std::int64_t t) { return this->PieceOf[part.GetSlot(t)] == piece; };
  Array<std::int64_t> slots = ListNumbers(part.GetNumberOfTriangles(), isIn, this->Threads);
  this->Threads.ForEach(static_cast<std::int64_t>(slots.Size()),
    [&](std::int64_t i) { slots[i] = part.GetSlot(slots[i]); });
  return SubMesh(this->Mesh, std::move(slots), this->Threads);
}

PointSet MeshInPieces::FindSeamPoints() const
{
  const TriangleArray& triangles = this->Mesh.Triangles;
  PointSet seam(this->Mesh.Points.Count, this->Threads);
  Array<unsigned char> pieceOfPoint =
    this->Threads.MakeArray<unsigned char>(this->Mesh.Points.Count);
  const auto forEachCorner = [&](const auto& work)
  {
    this->Threads.ForEach(triangles.Count,
      [&](std::int64_t t)
      {
        for (int slot = 0; slot < 3; ++slot)
        {
          work(triangles.Get(t, slot), this->PieceOf[t]);
        }
      });
  };
  // Whichever of its pieces a point keeps, it differs from another one of them.
  forEachCorner([&](std::int64_t point, unsigned char piece)
    { AtomicStore(pieceOfPoint.Data() + point, piece); });
  forEachCorner(
    [&](std::int64_t point, unsigned char piece)
    {
      if (pieceOfPoint[point] != piece)
      {
        seam.Add(point);
      }
    });
  return seam;
}

SubMesh MeshInPieces::GetTrianglesAt(const PointSet& points) const
{
  const TriangleArray& triangles = this->Mesh.Triangles;
  const auto isIn = [&](std::int64_t t) { return points.Touches(triangles, t); };
  return SubMesh(this->Mesh, ListNumbers(triangles.Count, isIn, this->Threads), this->Threads);
}

PointSet MeshInPieces::FindPointsAround(const PointSet& points) const
{
  const TriangleArray& triangles = this->Mesh.Triangles;
  PointSet around(this->Mesh.Points.Count, this->Threads);
  this->Threads.ForEach(triangles.Count,
    [&](std::int64_t t)
    {
      if (points.Touches(triangles, t))
      {
        for (int slot = 0; slot < 3; ++slot)
        {
          around.Add(triangles.Get(t, slot));
        }
      }
    });
  return around;
}

}
