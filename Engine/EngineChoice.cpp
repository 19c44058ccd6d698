// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "EngineChoice.h"

#include "CudaDevice.h"
#include "HostMemory.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace delaunayflip
{

namespace
{
bool WantsCuda(const CallerMesh& mesh, const FlipOptions& options)
{
  if (options.Backend != BackendKind::Auto)
  {
    return options.Backend == BackendKind::CUDA;
  }
  return mesh.GetOnDevice() || (mesh.CountTriangles() >= SmallestMeshForCuda && HasCudaDevice());
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
  const CallerMesh& mesh, const FlipOptions& options, const BuildProgress& progress)
  : Mesh(mesh),
    Options(options),
    Progress(progress)
{
  try
  {
    this->Engine = this->MakeEngine();
  }
  catch (const BackendUnavailable& error)
  {
    if (options.Backend == BackendKind::CUDA)
    {
      throw;
    }
    this->FallBack(error.what());
  }
}

std::unique_ptr<FlipEngine> ChosenEngine::MakeEngine()
{
  if (!WantsCuda(this->Mesh, this->Options))
  {
    return MakeThreadEngine(this->Mesh.GetOnHost(), this->Options, this->Progress);
  }
  const DeviceMesh* device = this->Mesh.GetOnDevice();
  return device ? MakeCudaEngine(*device, this->Options, this->Progress)
                : MakeCudaEngine(this->Mesh.GetOnHost(), this->Options, this->Progress);
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

bool ChosenEngine::StoreTrianglesOnDevice(
  const MutableTriangleArray& triangles, const DeviceStream& stream)
{
  return this->Run(
    [&](const FlipEngine& engine) { return engine.StoreTrianglesOnDevice(triangles, stream); });
}

bool ChosenEngine::StoreFlipCountsOnDevice(std::int32_t* counts, const DeviceStream& stream)
{
  return this->Run(
    [&](const FlipEngine& engine) { return engine.StoreFlipCountsOnDevice(counts, stream); });
}

Defect ChosenEngine::FindTurnedTriangles()
{
  return this->Run([](const FlipEngine& engine) { return engine.FindTurnedTriangles(); });
}

void ChosenEngine::Audit()
{
  this->Run([](const FlipEngine& engine) { engine.Audit(); });
}

void ChosenEngine::FallBack(const std::string& reason)
{
  this->Fallback = reason;
  this->Engine.reset();
  this->Engine = MakeThreadEngine(this->Mesh.GetOnHost(), this->Options, this->Progress);
  if (this->HasDetected)
  {
    this->Progress.Reach(this->GetInputReport().GeometryUsed, BuildStep::Measured);
    this->Engine->GetLoop().Detect();
    this->Progress.Reach(this->GetInputReport().GeometryUsed, BuildStep::Tested);
    this->Repeat();
  }
}

/// The iterations that have been reported, in batches of up to a tenth of a second.
void ChosenEngine::Repeat()
{
  using Clock = std::chrono::steady_clock;
  std::int64_t batch = 1;
  for (std::int64_t done = 0; done < this->Iterations;)
  {
    const Clock::time_point start = Clock::now();
    const AdvancePlan plan{ std::min(batch, this->Iterations - done), false, false };
    done += static_cast<std::int64_t>(this->Engine->GetLoop().Advance(plan).size());
    batch = Clock::now() - start < std::chrono::milliseconds(50) ? 2 * batch : batch;
    this->Progress.Tell(0.0);
  }
}

}
