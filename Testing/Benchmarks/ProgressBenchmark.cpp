// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "DelaunayFlip.h"
#include "GeneratedMeshes.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

/// @file
/// delaunay-flip-progress: measures how accurate the engine's progress is, and how long an abort
/// may have to wait. Usage: delaunay-flip-progress [TRIANGLES [points]], by default 1,000,000. For
/// several meshes of about that many triangles, on one thread and on two, or for points alone, it
/// prints the longest time between two calls of a progress observer, and the progress when one
/// tenth, two tenths, ... of the time have passed.

using namespace delaunayflip;

namespace
{

using Clock = std::chrono::steady_clock;

double SecondsSince(Clock::time_point start)
{
  return std::chrono::duration<double>(Clock::now() - start).count();
}

struct Call
{
  double Seconds;
  double Fraction;
};

using Run = std::function<void(const FlipOptions& options, const ProgressObserver& progress)>;

/// The calls of a run, and its begin and end.
std::vector<Call> WatchRun(const Run& run, const FlipOptions& options)
{
  std::vector<Call> calls{ { 0.0, 0.0 } };
  const auto start = Clock::now();
  run(options,
    [&](double fraction)
    {
      calls.push_back({ SecondsSince(start), fraction });
      return true;
    });
  calls.push_back({ SecondsSince(start), 1.0 });
  return calls;
}

double FindLongestWait(const std::vector<Call>& calls)
{
  double longest = 0.0;
  for (std::size_t i = 1; i < calls.size(); ++i)
  {
    longest = std::max(longest, calls[i].Seconds - calls[i - 1].Seconds);
  }
  return longest;
}

/// The progress in the last call before `seconds`.
double GetFraction(const std::vector<Call>& calls, double seconds)
{
  const auto next = std::upper_bound(calls.begin(), calls.end(), seconds,
    [](double value, const Call& call) { return value < call.Seconds; });
  return std::prev(next)->Fraction;
}

/// The share of the time in which progress is off by at most 15 percentage points.
double MeasureAccuracy(const std::vector<Call>& calls)
{
  constexpr int Samples = 1000;
  constexpr double Tolerance = 0.15;
  int accurate = 0;
  for (int i = 0; i < Samples; ++i)
  {
    const double time = (i + 0.5) / Samples;
    const double reported = GetFraction(calls, time * calls.back().Seconds);
    accurate += std::fabs(reported - time) <= Tolerance ? 1 : 0;
  }
  return static_cast<double>(accurate) / Samples;
}

void Print(const char* name, const Run& run)
{
  constexpr int Runs = 5;
  for (const int threads : { 1, 2 })
  {
    FlipOptions options;
    options.Backend = BackendKind::Threads;
    options.NumberOfThreads = threads;
    // Other programs may slow the machine, so the run whose longest wait is the shortest counts.
    std::vector<Call> calls = WatchRun(run, options);
    for (int i = 1; i < Runs; ++i)
    {
      std::vector<Call> others = WatchRun(run, options);
      calls = FindLongestWait(others) < FindLongestWait(calls) ? std::move(others) : calls;
    }
    std::printf("| %s | %d | %.0f | %zu | %.0f | %.0f %% |", name, threads,
      1000 * calls.back().Seconds, calls.size() - 2, 1000 * FindLongestWait(calls),
      100 * MeasureAccuracy(calls));
    for (int tenth = 1; tenth < 10; ++tenth)
    {
      std::printf(" %.0f |", 100 * GetFraction(calls, 0.1 * tenth * calls.back().Seconds));
    }
    std::printf("\n");
    std::fflush(stdout);
  }
}

void Print(const char* name, const OwnedMesh<double>& mesh, GeometryKind geometry)
{
  std::vector<std::int32_t> result(mesh.Triangles.size());
  Print(name,
    [&](FlipOptions options, const ProgressObserver& progress)
    {
      options.Geometry = geometry;
      FlipToDelaunay(mesh.View(), options,
        MutableTriangleArray(result.data(), mesh.NumberOfTriangles()), {}, progress);
    });
}

/// Triangulates the points of a mesh.
void PrintPoints(const OwnedMesh<double>& mesh)
{
  std::vector<std::int32_t> result(6 * mesh.Points.size());
  PointInput input;
  input.Points = PlaneArray(mesh.Points.data(), mesh.NumberOfPoints(), 3);
  Print("points of it",
    [&](const FlipOptions& options, const ProgressObserver& progress)
    {
      FlipSession session(input, PointOptions{ options }, progress);
      session.Advance(-1, {}, progress);
      session.StoreTriangles(MutableTriangleArray(result.data(), session.GetReport().Triangles));
    });
}

/// A Delaunay mesh whose points have been moved by up to `share` of their mean distance.
OwnedMesh<double> MoveDelaunayPoints(OwnedMesh<double> mesh, double share)
{
  FlipToDelaunay(
    mesh.View(), {}, MutableTriangleArray(mesh.Triangles.data(), mesh.NumberOfTriangles()));
  const double step = share / std::sqrt(static_cast<double>(mesh.NumberOfPoints()));
  std::uint32_t random = 1;
  for (std::size_t i = 0; i < mesh.Points.size(); ++i)
  {
    random = random * 1664525u + 1013904223u;
    mesh.Points[i] += i % 3 == 2 ? 0.0 : step * (random / 2147483648.0 - 1.0);
  }
  return mesh;
}

/// A plane mesh as hills: its points get heights.
OwnedMesh<double> Raise(OwnedMesh<double> mesh)
{
  for (std::size_t i = 0; i < mesh.Points.size(); i += 3)
  {
    mesh.Points[i + 2] =
      0.05 * std::sin(20.0 * mesh.Points[i]) * std::cos(17.0 * mesh.Points[i + 1]);
  }
  return mesh;
}

}

int main(int argc, char** argv)
{
  const std::int64_t triangles = std::max(argc > 1 ? std::atoll(argv[1]) : 1000000, 1000LL);
  std::printf("| mesh | threads | ms | calls | longest wait, ms | within 15 points "
              "| 10 %% | 20 %% | 30 %% | 40 %% | 50 %% | 60 %% | 70 %% | 80 %% | 90 %% |\n");
  std::printf("|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  const OwnedMesh<double> bad = MakeRandomBadMeshDouble(triangles / 2, 1);
  PrintPoints(bad);
  if (argc > 2)
  {
    return 0;
  }
  const OwnedMesh<double> moved = MoveDelaunayPoints(bad, 0.3);
  const auto side = static_cast<std::int32_t>(std::sqrt(0.5 * static_cast<double>(triangles)));
  Print("random bad mesh", bad, GeometryKind::Planar);
  Print("terrain of it", Raise(bad), GeometryKind::PlanarXY);
  Print("surface of it", Raise(bad), GeometryKind::Surface);
  Print("Delaunay, points moved", moved, GeometryKind::Planar);
  Print("surface of it", Raise(moved), GeometryKind::Surface);
  Print("bad sphere", MakeBadSphere(side, side, 1), GeometryKind::Auto);
  Print("grid, nothing to flip", MakeGridMesh(side, side), GeometryKind::Auto);
  return 0;
}
