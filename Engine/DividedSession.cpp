// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "DividedSession.h"

namespace delaunayflip
{

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
