// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PreparedPieces.h"

#include "CallerMesh.h"
#include "InputChecks.h"

namespace delaunayflip
{

namespace
{
ConstraintInsertion InsertConstraints(
  const TriangleMesh& mesh, const FlipOptions& options, const ProgressObserver& progress)
{
  CheckOptions(options);
  if (!CallerMesh(mesh).HasConstraintsToInsert())
  {
    return {};
  }
  CheckMeshSize(mesh.Triangles.Count, mesh.Points.Count,
    "where constraints are to be inserted; give constraints that are edges of the mesh");
  return ConstraintInsertion(mesh, options,
    [&](double share) { return !progress || progress(ConstraintInsertion::ShareOfRun * share); });
}
}

PreparedPieces::PreparedPieces(const TriangleMesh& mesh, const FlipOptions& options,
  const MutableTriangleArray& triangles, const ProgressObserver& progress)
  : Insertion(InsertConstraints(mesh, options, progress)),
    Options(this->Insertion.GetOptions(options)),
    Mesh(this->Insertion.GetMesh(mesh), triangles, this->Options,
      CountPieces(options, mesh.Triangles.Count))
{
}

PiecesReport PreparedPieces::GetReport() const
{
  PiecesReport report;
  report.Points = this->Mesh.View().Points.Count;
  report.Triangles = this->Mesh.View().Triangles.Count;
  report.GeometryUsed = this->Mesh.GetSurvey().Geometry;
  report.GeometryReason = this->Mesh.GetSurvey().GeometryReason;
  report.Tolerance = DescribeTolerance(this->Options, report.GeometryUsed);
  report.Defects = this->Mesh.GetDefects();
  this->Insertion.AddTo(report);
  return report;
}

PiecesReport PreparedPieces::Abort(
  const TriangleMesh& mesh, const MutableTriangleArray& triangles, int threads)
{
  CopyTriangles(mesh.Triangles, triangles, ThreadBackend(threads));
  PiecesReport report;
  report.Points = mesh.Points.Count;
  report.Triangles = mesh.Triangles.Count;
  report.StopReason = StopReasonKind::Aborted;
  return report;
}

PiecesReport PreparedPieces::Run(const ProgressObserver& progress, std::int32_t* flipCounts)
{
  const double begin = this->Insertion.GetShare();
  const ProgressObserver observer = [&](double share)
  { return !progress || progress(begin + (1.0 - begin) * share); };
  PiecesReport report = FlipInTurn(this->Mesh, this->Options, flipCounts, observer);
  this->Insertion.AddTo(report);
  if (flipCounts)
  {
    this->Insertion.AddFlipCounts(flipCounts);
  }
  return report;
}

}
