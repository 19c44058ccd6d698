// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PAPERLOOP_H
#define DELAUNAYFLIP_PAPERLOOP_H

#include "Array.h"
#include "PaperMethod.h"
#include "PaperSteps.h"

#include <chrono>
#include <cstdint>
#include <vector>

/// @file
/// The loop on the host, the same for both backends. A backend has RunPhase(backend, size, step),
/// which calls step(i) for i = 0 .. size - 1, and WaitFor(backend).

namespace delaunayflip
{

/// A copy of a vector in the backend's memory.
template <typename T, typename Backend>
Array<T> CopyTo(const Backend& backend, const std::vector<T>& values)
{
  Array<T> copy = backend.template MakeArray<T>(static_cast<std::int64_t>(values.size()));
  backend.Upload(values.data(), static_cast<std::int64_t>(values.size()), copy.Data());
  return copy;
}

template <typename T>
struct SetToZero
{
  T* Values;
  DELAUNAYFLIP_HOST_DEVICE void operator()(std::int64_t i) const { this->Values[i] = T{}; }
};

template <typename T, typename Backend>
Array<T> MakeZeros(const Backend& backend, std::int64_t size)
{
  Array<T> zeros = backend.template MakeArray<T>(size);
  RunPhase(backend, size, SetToZero<T>{ zeros.Data() });
  return zeros;
}

/// All arrays of a run in the backend's memory.
template <typename Point, typename Backend>
class PaperState
{
public:
  PaperState(const PaperMesh<Point>& mesh, const Backend& backend)
    : Vertices(CopyTo(backend, mesh.Vertices)),
      Triangles(CopyTo(backend, mesh.Triangles)),
      Ends(CopyTo(backend, mesh.Ends)),
      TriangleA(CopyTo(backend, mesh.TriangleA)),
      TriangleB(CopyTo(backend, mesh.TriangleB)),
      Opposites(CopyTo(backend, mesh.Opposites)),
      Flags(MakeZeros<std::int32_t>(backend, mesh.NumberOfTriangles())),
      Rotations(MakeZeros<std::int32_t>(backend, mesh.NumberOfTriangles()))
  {
  }

  PaperArrays<Point> View()
  {
    return { this->Vertices.Data(), this->Triangles.Data(), this->Ends.Data(),
      this->TriangleA.Data(), this->TriangleB.Data(), this->Opposites.Data(), this->Flags.Data(),
      this->Rotations.Data() };
  }

private:
  Array<Point> Vertices;
  Array<std::int32_t> Triangles;
  Array<IndexPair> Ends, TriangleA, TriangleB, Opposites;
  Array<std::int32_t> Flags, Rotations;
};

/// The parameters of a run besides its mesh.
template <typename Test>
struct PaperPlan
{
  Test EdgeTest;
  double NormalCosine;
  std::int64_t MaximumIterations;
  bool CountsIterations;
};

template <typename Point, typename Test, typename Backend>
class PaperLoop
{
public:
  PaperLoop(PaperState<Point, Backend>& state, std::int64_t edges, const PaperPlan<Test>& plan,
    const Backend& backend)
    : Arrays(state.View()),
      Edges(edges),
      Plan(plan),
      Place(backend),
      LastBad(MakeZeros<std::int32_t>(backend, 1)),
      Counts(MakeZeros<PaperCounts>(backend, plan.CountsIterations ? plan.MaximumIterations : 0))
  {
  }

  /// Sets Iterations and Converged.
  void Run(PaperResult& result)
  {
    while (!result.Converged && result.Iterations < this->Plan.MaximumIterations)
    {
      const auto iteration = static_cast<std::int32_t>(result.Iterations + 1);
      RunPhase(this->Place, this->Edges, this->MakeDetection(iteration));
      std::int32_t lastBad = 0;
      this->Place.Download(this->LastBad.Data(), 1, &lastBad);
      result.Converged = lastBad != iteration;
      if (!result.Converged)
      {
        RunPhase(this->Place, this->Edges, RepairReferences<Point>{ this->Arrays });
        ++result.Iterations;
      }
    }
    WaitFor(this->Place);
  }

  void StoreCounts(PaperResult& result)
  {
    std::vector<PaperCounts> counts(this->Plan.CountsIterations ? result.Iterations : 0);
    this->Place.Download(
      this->Counts.Data(), static_cast<std::int64_t>(counts.size()), counts.data());
    for (const PaperCounts& count : counts)
    {
      result.Counts.push_back({ count.Bad, count.Flipped });
    }
  }

private:
  DetectAndFlip<Point, Test> MakeDetection(std::int32_t iteration)
  {
    using Real = typename Point::Number;
    return { this->Arrays, this->Plan.EdgeTest,
      NormalThreshold<Real>{ static_cast<Real>(this->Plan.NormalCosine) }, iteration,
      this->LastBad.Data(),
      this->Plan.CountsIterations ? this->Counts.Data() + iteration - 1 : nullptr };
  }

  PaperArrays<Point> Arrays;
  std::int64_t Edges;
  PaperPlan<Test> Plan;
  const Backend& Place;
  Array<std::int32_t> LastBad;
  Array<PaperCounts> Counts;
};

/// Copies a mesh to the backend, runs the loop there and copies the triangles back.
template <typename Point, typename Test, typename Backend>
PaperResult RunPaperLoop(
  const PaperMesh<Point>& mesh, const PaperPlan<Test>& plan, const Backend& backend)
{
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  PaperState<Point, Backend> state(mesh, backend);
  PaperLoop<Point, Test, Backend> loop(state, mesh.NumberOfEdges(), plan, backend);
  WaitFor(backend);
  const auto copied = Clock::now();
  PaperResult result;
  loop.Run(result);
  const auto done = Clock::now();
  result.CopySeconds = std::chrono::duration<double>(copied - start).count();
  result.FlipSeconds = std::chrono::duration<double>(done - copied).count();
  result.Backend = backend.GetName();
  loop.StoreCounts(result);
  result.Triangles.resize(mesh.Triangles.size());
  backend.Download(state.View().Triangles, static_cast<std::int64_t>(result.Triangles.size()),
    result.Triangles.data());
  return result;
}

/// The same on the current GPU (PaperCuda.cu). @throws BackendUnavailable.
template <typename Point, typename Test>
PaperResult RunPaperLoopOnGpu(const PaperMesh<Point>& mesh, const PaperPlan<Test>& plan);

}

#endif
