// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "DividedSession.h"

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

PiecesReport FlipInPieces(const TriangleMesh& mesh, const FlipOptions& options,
  const MutableTriangleArray& triangles, const ProgressObserver& progress)
{
  try
  {
    return PreparedPieces(mesh, options, triangles, progress).Run(progress, nullptr);
  }
  catch (const RunAborted&) // before the first flip
  {
    return PreparedPieces::Abort(mesh, triangles, options.NumberOfThreads);
  }
}

//------------------------------------------------------------------------------
DividedSession::DividedSession(
  const CallerMesh& mesh, const FlipOptions& options, const ProgressObserver& progress)
  : SessionWork(mesh),
    Options(options),
    Threads(options.NumberOfThreads)
{
  const std::int64_t size = 3 * mesh.CountTriangles();
  if (this->Mesh.GetOnHost().Triangles.Ids32)
  {
    this->Ids32 = this->Threads.MakeArray<std::int32_t>(size);
  }
  else
  {
    this->Ids64 = this->Threads.MakeArray<std::int64_t>(size);
  }
  this->Prepare(progress);
}

MutableTriangleArray DividedSession::GetTriangles()
{
  const std::int64_t count = this->Mesh.CountTriangles();
  return this->Ids64.Size() > 0 ? MutableTriangleArray(this->Ids64.Data(), count)
                                : MutableTriangleArray(this->Ids32.Data(), count);
}

/// Begins at the triangles of the caller.
/// @returns whether the observer did not stop it.
bool DividedSession::Prepare(const ProgressObserver& progress)
{
  this->Pieces.reset();
  this->FlipCounts = {};
  try
  {
    this->Pieces.emplace(this->Mesh.GetOnHost(), this->Options, this->GetTriangles(), progress);
    this->Report = this->Pieces->GetReport();
    return true;
  }
  catch (const RunAborted&)
  {
    this->Report = PreparedPieces::Abort(
      this->Mesh.GetOnHost(), this->GetTriangles(), this->Options.NumberOfThreads);
    return false;
  }
}

bool DividedSession::IsOver() const
{
  return this->Report.StopReason == StopReasonKind::Converged ||
    this->Report.StopReason == StopReasonKind::IterationLimit;
}

bool DividedSession::Advance(
  std::int64_t iterations, const FlipObserver& observer, const ProgressObserver& progress)
{
  if (iterations == 0 || this->IsOver())
  {
    return !this->IsOver();
  }
  if (!this->Pieces && !this->Prepare(progress))
  {
    return false;
  }
  this->FlipCounts = this->Threads.MakeArray<std::int32_t>(this->Mesh.CountTriangles());
  try
  {
    this->Report = this->Pieces->Run(progress, this->FlipCounts.Data());
  }
  catch (...)
  {
    this->Pieces.reset(); // its triangles have changed
    throw;
  }
  this->Pieces.reset();
  for (std::size_t i = 0; observer && i < this->Report.Iterations.size(); ++i)
  {
    observer(this->Report.Iterations[i]);
  }
  if (progress && this->IsOver())
  {
    progress(1.0);
  }
  return false;
}

void DividedSession::StoreTriangles(const MutableTriangleArray& triangles)
{
  const MutableTriangleArray stored = this->GetTriangles();
  CopyTriangles(stored.Ids32 ? TriangleArray(stored.Ids32, stored.Count)
                             : TriangleArray(stored.Ids64, stored.Count),
    triangles, this->Threads);
}

void DividedSession::StoreFlipCounts(std::int32_t* counts)
{
  const bool areKnown = this->FlipCounts.Size() > 0;
  this->Threads.ForEach(this->Mesh.CountTriangles(),
    [&](std::int64_t t) { counts[t] = areKnown ? this->FlipCounts[t] : 0; });
}

}
