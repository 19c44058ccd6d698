// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "EngineChoice.h"

#include "CudaDevice.h"
#include "HostMemory.h"

#include <algorithm>
#include <utility>

namespace delaunayflip
{

namespace
{
bool WantsCuda(const TriangleMesh& mesh, const FlipOptions& options)
{
  return options.Backend == BackendKind::CUDA ||
    (options.Backend == BackendKind::Auto && mesh.Triangles.Count >= SmallestMeshForCuda &&
      HasCudaDevice());
}

/// Stores into a temporary array first, so that the target is unchanged after a failure.
template <typename Id>
void StoreAtOnce(const FlipEngine& engine, Id* ids, std::int64_t count)
{
  HostMemory memory;
  Array<Id> stored(static_cast<std::size_t>(3 * count), memory);
  engine.StoreTriangles(MutableTriangleArray(stored.Data(), count));
  std::copy_n(stored.Data(), 3 * count, ids);
}
}

ChosenEngine::ChosenEngine(
  const TriangleMesh& mesh, const FlipOptions& options, const BuildProgress& progress)
  : Mesh(mesh),
    Options(options)
{
  try
  {
    this->Engine = WantsCuda(mesh, options) ? MakeCudaEngine(mesh, options, progress)
                                            : MakeThreadEngine(mesh, options, progress);
  }
  catch (const BackendUnavailable& error)
  {
    if (options.Backend == BackendKind::CUDA)
    {
      throw;
    }
    this->FallBack(error.what(), progress);
  }
}

StepCounts ChosenEngine::Detect()
{
  const StepCounts found = this->Run([](FlipEngine& engine) { return engine.GetLoop().Detect(); });
  this->HasDetected = true;
  return found;
}

std::vector<IterationCounts> ChosenEngine::Advance(const AdvancePlan& plan)
{
  std::vector<IterationCounts> iterations =
    this->Run([&](FlipEngine& engine) { return engine.GetLoop().Advance(plan); });
  this->Iterations += static_cast<std::int64_t>(iterations.size());
  return iterations;
}

double ChosenEngine::FindLargestSquaredCotangent()
{
  return this->Run(
    [](FlipEngine& engine) { return engine.GetLoop().FindLargestSquaredCotangent(); });
}

void ChosenEngine::StoreTriangles(const MutableTriangleArray& triangles, bool atOnce)
{
  this->Run(
    [&](const FlipEngine& engine)
    {
      if (atOnce && triangles.Ids32)
      {
        StoreAtOnce(engine, triangles.Ids32, triangles.Count);
      }
      else if (atOnce)
      {
        StoreAtOnce(engine, triangles.Ids64, triangles.Count);
      }
      else
      {
        engine.StoreTriangles(triangles);
      }
    });
}

void ChosenEngine::StoreFlipCounts(std::int32_t* counts)
{
  this->Run([&](const FlipEngine& engine) { engine.StoreFlipCounts(counts); });
}

Defect ChosenEngine::FindTurnedTriangles()
{
  return this->Run([](const FlipEngine& engine) { return engine.FindTurnedTriangles(); });
}

void ChosenEngine::Audit()
{
  this->RunOnce([](const FlipEngine& engine) { engine.Audit(); });
}

void ChosenEngine::FallBack(const std::string& reason, const BuildProgress& progress)
{
  this->Fallback = reason;
  this->Engine.reset();
  this->Engine = MakeThreadEngine(this->Mesh, this->Options, progress);
  if (this->HasDetected)
  {
    this->Engine->GetLoop().Detect();
  }
  for (std::int64_t done = 0; done < this->Iterations;)
  {
    const AdvancePlan plan{ this->Iterations - done, false, false };
    done += static_cast<std::int64_t>(this->Engine->GetLoop().Advance(plan).size());
  }
}

}
