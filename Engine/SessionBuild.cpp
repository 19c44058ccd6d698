// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// How a session begins: checks, constraints, the engine, and what is reported of the input.

#include "WholeSession.h"

#include "BuildProgress.h"
#include "InputChecks.h"

namespace delaunayflip
{

WholeSession::WholeSession(
  const CallerMesh& mesh, const FlipOptions& options, const ProgressObserver& progress)
  : SessionWork(mesh),
    Options(Check(mesh, options)),
    Observer(progress)
{
  this->Try([this]() { this->Build(); });
}

FlipOptions WholeSession::Check(const CallerMesh& mesh, const FlipOptions& options)
{
  CheckOptions(options);
  CheckMeshSize(mesh.CountTriangles(), mesh.CountPoints());
  FlipOptions checked = options;
  checked.Device = mesh.ChooseDevice(options.Device);
  return checked;
}

//------------------------------------------------------------------------------
/// When an exception leaves, there is no engine.
void WholeSession::Build()
{
  try
  {
    this->BuildEngine([this](double share) { return this->Progress.Tell(this->Observer, share); });
  }
  catch (...)
  {
    this->Reset();
    throw;
  }
}

void WholeSession::BuildEngine(const ProgressObserver& tell)
{
  const StopWatch watch;
  const CallerMesh mesh = this->InsertConstraints(tell);
  const double begin = this->Insertion.GetShare();
  // A copy stays in the engine, for when the CPU must start again.
  const BuildProgress progress(
    [tell, begin](double share) { return tell(begin + (1.0 - begin) * share); });
  this->Engine.emplace(mesh, this->Insertion.GetOptions(this->Options), progress);
  this->Report = this->Engine->GetInputReport();
  this->Insertion.AddTo(this->Report);
  progress.Reach(this->Report.GeometryUsed, BuildStep::Prepared);
  this->Report.MinimumAngleBefore = this->MeasureAngle();
  this->Report.MinimumAngleAfter = this->Report.MinimumAngleBefore;
  this->Report.BuildSeconds = watch.GetSeconds();
  progress.Reach(this->Report.GeometryUsed, BuildStep::Measured);
  this->DetectFirst();
  progress.Reach(this->Report.GeometryUsed, BuildStep::Tested);
  this->Progress.StartFlips(this->Found.Bad, this->Report.BuildSeconds, this->Report.FlipSeconds);
}

/// @returns the mesh that iterations start from.
CallerMesh WholeSession::InsertConstraints(const ProgressObserver& tell)
{
  this->Insertion = ConstraintInsertion();
  if (!this->Mesh.HasConstraintsToInsert())
  {
    return this->Mesh;
  }
  const TriangleMesh& mesh = this->Mesh.GetOnHost();
  this->Insertion = ConstraintInsertion(mesh, this->Options,
    [&](double share) { return tell(ConstraintInsertion::ShareOfRun * share); });
  return CallerMesh(this->Insertion.GetMesh(mesh));
}

/// Reports on the input, and ends the run if there is nothing to do or no iteration is allowed.
void WholeSession::DetectFirst()
{
  const StopWatch watch;
  this->Detected(this->Engine->Detect());
  this->Report.NonDelaunayBefore = this->Found.Bad + this->Found.GetBlocked();
  this->Report.FlipSeconds = watch.GetSeconds();
}

void WholeSession::Reset()
{
  this->Engine.reset();
  this->Insertion = ConstraintInsertion();
  this->Report = FlipReport();
  this->Report.Points = this->Mesh.CountPoints();
  this->Report.Triangles = this->Mesh.CountTriangles();
  this->IsMeasured = true;
}

}
