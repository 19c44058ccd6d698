// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "MeshRun.h"

#include "Array.h"
#include "FlipError.h"
#include "HostMemory.h"
#include "InputChecks.h"
#include "SubMesh.h"

#include <algorithm>
#include <string>
#include <type_traits>
#include <utility>

namespace delaunayflip
{

void MeshRun::ListStages()
{
  const FixedEdges& given = this->Mesh.GetFixedEdges();
  const auto load = [this]
  { this->Load(this->Start.GetOnDevice() != nullptr, this->Mesh.CountTriangles()); };
  const auto flips = [this](LoadedMesh& loaded, std::int64_t iterations)
  { this->RepeatFlips(loaded, iterations); };
  const auto test = [this](LoadedMesh& loaded, std::int64_t) { this->RepeatTest(loaded); };
  const bool inserts = given.ConstraintsToInsert && ConstraintInsertion::IsRequested(given);
  if (inserts)
  {
    this->Stages.push_back({ "insert constraints", OnStop::Forgets, ConstraintInsertion::ShareOfRun,
      Whole([this] { this->InsertConstraints(); }), {} });
  }
  this->Stages.push_back({ "load", OnStop::Forgets, 0.0, Whole(load), {} });
  this->AfterLoad = this->Stages.size();
  if (inserts)
  {
    this->Stages.push_back({ "report constraints", OnStop::Forgets, 0.0,
      Whole([this] { this->Insertion.AddTo(this->Report); }), {} });
  }
  if (given.NumberOfRegionSeeds > 0)
  {
    CheckRegions(given.RegionSeeds, given.NumberOfRegionSeeds);
    this->Stages.push_back(
      { "label regions", OnStop::Forgets, 0.0, Whole([this] { this->LabelRegions(); }), {} });
  }
  this->Stages.push_back(
    { "test all edges", OnStop::Forgets, 0.0, Whole([this] { this->TestAllEdges(); }), test });
  this->Stages.push_back(
    { "flip", OnStop::KeepsMesh, 0.0, [this] { return this->Flip(); }, flips });
  if (this->WantsRefinement)
  {
    const auto refine = [this](LoadedMesh& loaded, std::int64_t rounds)
    { this->RepeatRounds(loaded, rounds); };
    this->Stages.push_back(
      { "refine", OnStop::KeepsMesh, 0.5, [this] { return this->Refine(); }, refine });
  }
  this->Stages.push_back(
    { "measure", OnStop::Ignores, 0.0, Whole([this] { this->MeasureEnd(); }), {} });
}

MeshRun::MeshRun(
  const CallerMesh& mesh, const FlipOptions& options, const ProgressObserver& progress)
  : LoadedRun(options, progress),
    Mesh(mesh),
    Start(mesh)
{
  CheckMeshSize(mesh.CountTriangles(), mesh.CountPoints());
  const FixedEdges& given = mesh.GetFixedEdges();
  if (given.Sizes)
  {
    CheckSizes(given.Sizes, mesh.CountPoints());
  }
  this->WantsRefinement = HasGoals(options, given);
  this->ListStages();
  if (mesh.GetOnDevice())
  {
    this->Options.Device = mesh.ChooseDevice(options.Device);
  }
}

/// Makes constraints edges by flips, on the host, before a backend is chosen.
void MeshRun::InsertConstraints()
{
  const TriangleMesh& mesh = this->Mesh.CopyToHost();
  this->Insertion = ConstraintInsertion(mesh, this->Options,
    [this](double share)
    { return this->Progress.Tell(this->Observer, ConstraintInsertion::ShareOfRun * share); });
  this->Start = CallerMesh(this->Insertion.GetMesh(mesh));
  this->ShareBefore = this->Insertion.GetShare();
}

std::unique_ptr<LoadedMesh> MeshRun::LoadOn(BackendKind backend)
{
  const FlipOptions options = this->Insertion.GetOptions(this->Options);
  if (backend == BackendKind::Threads)
  {
    return LoadOnThreads(this->Start.CopyToHost(), options, this->Building);
  }
  const DeviceMesh* device = this->Start.GetOnDevice();
  if (device)
  {
    return LoadOnCuda(*device, options, this->Building);
  }
  return LoadOnCuda(this->Start.GetOnHost(), options, this->Building);
}

void MeshRun::Reset()
{
  LoadedRun::Reset();
  this->Insertion = ConstraintInsertion();
  this->HasMoved = false;
  this->Refined = RefinedCallerMesh();
  this->Regions.clear();
  this->Report.Points = this->Mesh.CountPoints();
  this->Report.Triangles = this->Mesh.CountTriangles();
  this->Start = this->Mesh; // last, because memory may be lacking
}

void MeshRun::ListDefects()
{
  FlipReport& report = this->Report;
  report.Defects = this->InputDefects;
  AddDefect(this->FindIdleOptions(), report.Defects);
  AddDefect(this->Refined.Unrefined, report.Defects);
  if (this->Refined.HasReachedLimit)
  {
    const std::int64_t points = this->Mesh.CountPoints() + SizeOf(this->Refined.Points);
    AddDefect(this->DescribeLimit(points), report.Defects);
  }
  const EdgeCounts& edges = report.Edges;
  if (report.Triangles > 1 && edges.Edges > 0 && edges.Boundary == edges.Edges)
  {
    report.Defects.emplace_back(DefectKind::SeparateTriangles, report.Triangles);
  }
}

/// While edges flip, nothing is measured.
void MeshRun::MeasureKeptEdges()
{
  FlipReport& report = this->Report;
  const EdgeCounts& edges = report.Edges;
  const bool isRunning = report.StopReason == StopReasonKind::Running;
  report.KeepsSliver = false;
  report.HiddenByWinding = 0;
  if (!isRunning && edges.Feature + edges.Constraint > 0)
  {
    this->OnBackend([&report](LoadedMesh& mesh) { report.KeepsSliver = mesh.KeepsSliver(); });
  }
  if (!isRunning && edges.WronglyWound > 0)
  {
    this->OnBackend(
      [&report](LoadedMesh& mesh) { report.HiddenByWinding = mesh.CountHidden().WronglyWound; });
  }
}

//------------------------------------------------------------------------------
namespace
{
MovedPoints CopyPoints(const PlaneArray& places, bool asFloats)
{
  MovedPoints copy;
  const auto fill = [&](auto& coordinates)
  {
    using Real = typename std::decay_t<decltype(coordinates)>::value_type;
    coordinates.resize(places.Stride * places.Count);
    for (std::size_t i = 0; i < coordinates.size(); ++i)
    {
      coordinates[i] = static_cast<Real>(places.GetNumber(static_cast<std::int64_t>(i)));
    }
  };
  if (asFloats)
  {
    fill(copy.Floats);
  }
  else
  {
    fill(copy.Doubles);
  }
  return copy;
}
}

bool MeshRun::Move(const PointMove& move, const ProgressObserver& progress)
{
  const PlaneArray& places = move.Points;
  constexpr std::int64_t Components = 3;
  const bool areAll = !move.Ids && !move.OnDevice && places.Stride == Components &&
    places.Count == this->Mesh.CountPoints();
  if (!areAll)
  {
    throw InvalidOptions(
      "a mesh is moved by places in the host's memory, x, y and z, for each of its " +
      Count(this->Mesh.CountPoints(), "point"));
  }
  if (progress && !progress(0.0))
  {
    return false;
  }
  const TemporaryValue<ProgressObserver> told(this->Observer, {}); // what follows cannot be stopped
  try
  {
    this->GoOnAt(CopyPoints(places, this->Mesh.CopyToHost().Points.Floats != nullptr));
    return true;
  }
  catch (const InvalidOptions&) // nothing has changed
  {
    throw;
  }
  catch (...)
  {
    this->Reset();
    throw;
  }
}

/// Goes on with the triangles that flips have made, and points at other places.
/// @throws InvalidOptions if the mesh has to be loaded anew.
void MeshRun::GoOnAt(MovedPoints points)
{
  const StopWatch watch;
  const bool mayFollow = this->Loaded && !this->Mesh.GetOnDevice() && !this->WantsRefinement &&
    this->Mesh.GetFixedEdges().NumberOfRegionSeeds == 0;
  TriangleMesh moved, start;
  bool follows = false;
  if (mayFollow)
  {
    moved = this->Mesh.CopyToHost();
    start = this->Start.CopyToHost();
    moved.Points = points.View();
    start.Points = points.View();
    this->OnBackend([&](LoadedMesh& mesh)
      { follows = mesh.MoveMesh(start, this->Insertion.GetOptions(this->Options)); });
  }
  if (!follows)
  {
    throw InvalidOptions("the mesh cannot follow its points: it is on a GPU or refined, has region "
                         "seeds or points that are not finite, or another geometry suits it now; "
                         "begin another session");
  }
  this->Journal.clear();
  this->Progress = RunProgress();
  const std::string fallback = this->Report.Fallback;
  const std::string backend = this->Report.Backend;
  this->Report = this->Loaded->GetInputReport();
  this->Report.Fallback = fallback;
  this->Report.Backend = backend;
  this->Report.BuildSeconds = watch.GetSeconds();
  this->AreKeptEdgesKnown = false;
  this->Current = this->AfterLoad;
  this->RunStages(this->FindFlips());
  // Last, so that points are where they were after an exception. Threads have the mesh now, so
  // there is no fallback that loads it again.
  this->Mesh = CallerMesh(moved);
  this->Start = CallerMesh(start);
  this->Moved = std::move(points);
  this->HasMoved = true;
}

//------------------------------------------------------------------------------
/// If the caller stores to the input's own array, nothing is written there before the whole result
/// is known.
void MeshRun::StoreTriangles(const MutableTriangleArray& triangles)
{
  const auto store = [&](const LoadedMesh& mesh)
  {
    const auto storeAtOnce = [&](auto* ids)
    {
      HostMemory memory;
      Array<std::remove_pointer_t<decltype(ids)>> all(3 * triangles.Count, memory);
      mesh.StoreTriangles(MutableTriangleArray(all.Data(), triangles.Count));
      std::copy_n(all.Data(), all.Size(), ids);
    };
    if (!this->Mesh.IsTriangleArray(triangles.Data()))
    {
      mesh.StoreTriangles(triangles);
    }
    else if (triangles.Ids32)
    {
      storeAtOnce(triangles.Ids32);
    }
    else
    {
      storeAtOnce(triangles.Ids64);
    }
  };
  if (!this->TryOnBackend(store))
  {
    CopyTriangles(
      this->Mesh.CopyToHost().Triangles, triangles, ThreadBackend(this->Options.NumberOfThreads));
  }
}

void MeshRun::StoreFlipCounts(std::int32_t* counts)
{
  if (this->TryOnBackend([&](const LoadedMesh& mesh) { mesh.StoreFlipCounts(counts); }))
  {
    if (!this->HasMoved)
    {
      this->Insertion.AddFlipCounts(counts);
    }
    return;
  }
  std::fill_n(counts, this->CountTriangles(), 0);
}

bool MeshRun::StoreTrianglesOnDevice(
  const MutableTriangleArray& triangles, const DeviceStream& stream, std::int32_t* written)
{
  return this->TryStoreOnDevice([&](const LoadedMesh& mesh)
    { return mesh.StoreTrianglesOnDevice(triangles, stream, written); });
}

/// The flips of an insertion are counted on the host.
bool MeshRun::StoreFlipCountsOnDevice(std::int32_t* counts, const DeviceStream& stream)
{
  return !this->Insertion.HasFlips() &&
    this->TryStoreOnDevice(
      [&](const LoadedMesh& mesh) { return mesh.StoreFlipCountsOnDevice(counts, stream); });
}

}
