// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PiecesRun.h"

#include "ConstraintInsertion.h"
#include "SubMesh.h"
#include "ThreadBackend.h"

#include <algorithm>
#include <numeric>

namespace delaunayflip
{

namespace
{
/// The stages that the constructor does.
constexpr std::size_t StagesOfBegin = 1;
}

void PiecesRun::ListStages()
{
  this->Stages = {
    { "insert constraints and cut the mesh into parts", OnStop::Forgets,
      ConstraintInsertion::ShareOfRun, Whole([this] { this->Cut(); }), {} },
    { "examine the edges between parts", OnStop::Ignores, 0.0,
      Whole([this] { this->Parts->ExamineSeams(); }), {} },
    { "flip each part", OnStop::KeepsMesh, MeshInParts::PartsShare,
      Whole([this] { this->Parts->FlipParts(this->Observer); }), {} },
    { "flip around the edges between parts", OnStop::KeepsMesh, 1.0 - MeshInParts::PartsShare,
      Whole([this] { this->Parts->FlipSeams(); }), {} },
    { "count what is left", OnStop::Ignores, 0.0, Whole([this] { this->Parts->Complete(); }), {} },
  };
}

PiecesRun::PiecesRun(const TriangleMesh& mesh, const FlipOptions& options,
  const ProgressObserver& progress, const MutableTriangleArray& triangles)
  : Mesh(mesh),
    Options(options),
    Given(triangles)
{
  this->Observer = progress;
  this->ListStages();
  try
  {
    this->Begin();
  }
  catch (const RunAborted&)
  {
    this->Abort();
  }
}

void PiecesRun::Cut()
{
  this->Parts = CutIntoParts(this->Mesh, this->Options, this->Observer, this->Given);
}

void PiecesRun::Begin()
{
  this->Reset(); // frees the arrays of a run before
  this->RunStages(StagesOfBegin);
  this->Report = this->Parts->Report;
}

void PiecesRun::Reset()
{
  this->Parts.reset();
  this->Current = 0;
  this->Report = FlipReport();
  this->Report.Points = this->Mesh.Points.Count;
  this->Report.Triangles = this->Mesh.Triangles.Count;
}

bool PiecesRun::Advance(
  std::int64_t iterations, const FlipObserver& observer, const ProgressObserver& progress)
try
{
  const auto isDone = [this]
  {
    return this->Report.StopReason == StopReasonKind::Converged ||
      this->Report.StopReason == StopReasonKind::IterationLimit;
  };
  if (iterations == 0 || isDone())
  {
    return !isDone();
  }
  const TemporaryValue<ProgressObserver> told(this->Observer, progress);
  if (this->Current != StagesOfBegin)
  {
    this->Begin();
  }
  this->RunStages(this->Stages.size());
  this->Report = this->Parts->Report;
  this->TellEnd(observer, isDone() ? progress : ProgressObserver());
  return false;
}
catch (const RunAborted&)
{
  this->Abort();
  return false;
}
catch (...)
{
  this->Reset();
  throw;
}

PiecesReport PiecesRun::GetPiecesReport() const
{
  if (this->Parts)
  {
    return this->Parts->Report;
  }
  PiecesReport report;
  static_cast<FlipReport&>(report) = this->Report;
  return report;
}

void PiecesRun::StoreTriangles(const MutableTriangleArray& triangles)
{
  TriangleArray present = this->Mesh.Triangles;
  if (this->Parts)
  {
    present = AsConst(this->Parts->Triangles);
  }
  CopyTriangles(present, triangles, ThreadBackend(this->Options.NumberOfThreads));
}

void PiecesRun::StoreFlipCounts(std::int32_t* counts)
{
  if (this->Parts)
  {
    std::copy(this->Parts->FlipCounts.begin(), this->Parts->FlipCounts.end(), counts);
    return;
  }
  std::fill_n(counts, this->Mesh.Triangles.Count, 0);
}

void PiecesRun::StoreSources(std::int32_t* sources)
{
  std::iota(sources, sources + this->CountTriangles(), 0);
}

//------------------------------------------------------------------------------
PiecesReport FlipInPieces(const TriangleMesh& mesh, const FlipOptions& options,
  const MutableTriangleArray& triangles, const ProgressObserver& progress)
{
  PiecesRun run(mesh, options, progress, triangles);
  if (run.GetReport().StopReason == StopReasonKind::Aborted) // before the triangles were copied
  {
    run.StoreTriangles(triangles);
  }
  else
  {
    run.Advance(-1, {}, progress);
  }
  return run.GetPiecesReport();
}

}
