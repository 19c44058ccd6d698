// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "DividedCopy.h"

namespace delaunayflip
{

DividedCopy::DividedCopy(
  const TriangleMesh& mesh, const FlipOptions& options, const ProgressObserver& progress)
  : Mesh(mesh),
    Options(options),
    Threads(options.NumberOfThreads)
{
  const std::int64_t count = mesh.Triangles.Count;
  if (mesh.Triangles.Ids32)
  {
    this->Ids32 = this->Threads.MakeArray<std::int32_t>(3 * count);
    this->Triangles = MutableTriangleArray(this->Ids32.Data(), count);
  }
  else
  {
    this->Ids64 = this->Threads.MakeArray<std::int64_t>(3 * count);
    this->Triangles = MutableTriangleArray(this->Ids64.Data(), count);
  }
  this->Prepare(progress);
}

/// Begins at the triangles of the caller.
/// @returns whether the observer did not stop it.
bool DividedCopy::Prepare(const ProgressObserver& progress)
{
  this->Parts.reset();
  this->FlipCounts = {};
  try
  {
    this->Parts.emplace(this->Mesh, this->Triangles, this->Options, progress);
    this->Report = this->Parts->GetReport();
    return true;
  }
  catch (const RunAborted&)
  {
    this->Report = StopBeforeFlips(this->Mesh, this->Triangles, this->Threads);
    return false;
  }
}

bool DividedCopy::IsOver() const
{
  return this->Report.StopReason == StopReasonKind::Converged ||
    this->Report.StopReason == StopReasonKind::IterationLimit;
}

bool DividedCopy::Advance(
  std::int64_t iterations, const FlipObserver& observer, const ProgressObserver& progress)
{
  if (iterations == 0 || this->IsOver())
  {
    return !this->IsOver();
  }
  if (!this->Parts && !this->Prepare(progress))
  {
    return false;
  }
  this->FlipCounts = this->Threads.MakeArray<std::int32_t>(this->Mesh.Triangles.Count);
  try
  {
    this->Report = FlipInTurn(*this->Parts, this->FlipCounts.Data(), progress);
  }
  catch (...)
  {
    this->Parts.reset(); // its triangles have changed
    throw;
  }
  this->Parts.reset();
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

void DividedCopy::StoreTriangles(const MutableTriangleArray& triangles) const
{
  CopyTriangles(AsConst(this->Triangles), triangles, this->Threads);
}

void DividedCopy::StoreFlipCounts(std::int32_t* counts) const
{
  const bool areKnown = this->FlipCounts.Size() > 0;
  this->Threads.ForEach(this->Mesh.Triangles.Count,
    [&](std::int64_t t) { counts[t] = areKnown ? this->FlipCounts[t] : 0; });
}

}
