// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CgalDelaunay.h"
#include "DelaunayFlip.h"
#include "GeneratedMeshes.h"
#include "Machine.h"
#include "SequentialLawson.h"

#include <benchmark/benchmark.h>

#include <malloc.h>
#include <sys/wait.h>
#include <unistd.h>

#include <map>
#include <stdexcept>
#include <string>
#include <vector>

/// @file
/// Usage: delaunay-flip-benchmark [Google Benchmark's options]. Times the building of edges and the
/// flips on random bad meshes, CGAL's Delaunay triangulation of the same points, and a sequential
/// Lawson. Prints the medians of all, and the engine's peak memory.

namespace delaunayflip
{
namespace
{

const OwnedMesh<float>& GetMesh(std::int64_t points)
{
  static std::map<std::int64_t, OwnedMesh<float>> meshes;
  auto found = meshes.find(points);
  if (found == meshes.end())
  {
    found = meshes.emplace(points, MakeRandomBadMesh(points, 2013)).first;
  }
  return found->second;
}

FlipOptions MakeOptions(int threads)
{
  FlipOptions options;
  options.Backend = BackendKind::Threads;
  options.NumberOfThreads = threads;
  return options;
}

void BenchmarkEngine(benchmark::State& state, int threads, double bytesPerPoint)
{
  const OwnedMesh<float>& mesh = GetMesh(state.range(0));
  for ([[maybe_unused]] auto iteration : state)
  {
    const auto start = Clock::now();
    FlipSession session(mesh.View(), MakeOptions(threads));
    const double build = SecondsSince(start);
    session.Advance();
    state.SetIterationTime(SecondsSince(start));
    const FlipReport& report = session.GetReport();
    state.counters["build_ms"] = 1e3 * build;
    state.counters["iterations"] = static_cast<double>(report.Iterations.size());
    state.counters["flips"] = static_cast<double>(report.TotalFlips);
    state.counters["bytes_per_point"] = bytesPerPoint;
    if (report.NonDelaunayAfter != 0)
    {
      state.SkipWithError("the engine left bad edges");
    }
  }
}

void BenchmarkCgal(benchmark::State& state)
{
  const OwnedMesh<float>& mesh = GetMesh(state.range(0));
  for ([[maybe_unused]] auto iteration : state)
  {
    const CgalTime time = TimeCgalDelaunay(mesh);
    state.SetIterationTime(time.Seconds);
    if (time.Triangles != mesh.NumberOfTriangles())
    {
      state.SkipWithError("CGAL found a different number of triangles");
    }
  }
}

void BenchmarkLawson(benchmark::State& state)
{
  const OwnedMesh<float>& mesh = GetMesh(state.range(0));
  for ([[maybe_unused]] auto iteration : state)
  {
    const auto start = Clock::now();
    SequentialLawson lawson(mesh.View());
    state.counters["build_ms"] = 1e3 * SecondsSince(start);
    state.counters["flips"] = static_cast<double>(lawson.Run());
    state.SetIterationTime(SecondsSince(start));
    OwnedMesh<float> result = mesh;
    result.Triangles = lawson.GetTriangles();
    if (FlipSession(result.View(), MakeOptions(1)).GetReport().NonDelaunayBefore != 0)
    {
      state.SkipWithError("the sequential Lawson left bad edges");
    }
  }
}

double ReadStatus(const char* name) { return ReadBytes("/proc/self/status", name, 0.0); }

/// The peak resident memory of a whole run beyond its input and output arrays, in bytes.
///
/// A forked child shares the input and fills its output array first. It reads its resident size
/// (VmRSS), runs, and reads the peak since the fork (VmHWM). Threads do not survive a fork, so call
/// this before any thread is started.
double MeasurePeakMemory(const OwnedMesh<float>& mesh, const FlipOptions& options)
{
  int ends[2];
  double bytes = 0.0;
  if (pipe(ends) != 0)
  {
    throw std::runtime_error("no pipe");
  }
  const pid_t child = fork();
  if (child == 0)
  {
    std::vector<std::int32_t> output = mesh.Triangles;
    // Memory that the parent has freed but not returned would hide what the run needs.
    malloc_trim(0);
    const double before = ReadStatus("VmRSS");
    FlipToDelaunay(mesh.View(), options, { output.data(), mesh.NumberOfTriangles() });
    bytes = ReadStatus("VmHWM") - before;
    _exit(write(ends[1], &bytes, sizeof bytes) == sizeof bytes ? 0 : 1);
  }
  close(ends[1]);
  const bool isRead = child > 0 && read(ends[0], &bytes, sizeof bytes) == sizeof bytes;
  close(ends[0]);
  if (child > 0)
  {
    waitpid(child, nullptr, 0);
  }
  return isRead ? bytes : 0.0;
}

template <typename Function>
void Register(const std::string& name, std::int64_t points, const Function& function)
{
  benchmark::RegisterBenchmark(name.c_str(), function)
    ->Arg(points)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1)
    ->Repetitions(5)
    ->ReportAggregatesOnly();
}

}
}

int main(int argc, char** argv)
{
  using namespace delaunayflip;
  for (const std::int64_t points : { 100000, 1000000 })
  {
    for (const int threads : { 1, 2 })
    {
      const double bytes = MeasurePeakMemory(GetMesh(points), MakeOptions(threads));
      Register("Engine, threads: " + std::to_string(threads), points,
        [=](benchmark::State& state) { BenchmarkEngine(state, threads, bytes / points); });
    }
    Register("CGAL Delaunay", points, BenchmarkCgal);
    Register("Sequential Lawson", points, BenchmarkLawson);
  }
  // Repetitions of the programs alternate, so that other work on the machine slows all of them.
  std::string interleave = "--benchmark_enable_random_interleaving=true";
  std::vector<char*> arguments(argv, argv + argc);
  arguments.insert(arguments.begin() + 1, interleave.data());
  int count = static_cast<int>(arguments.size());
  benchmark::Initialize(&count, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(count, arguments.data()))
  {
    return 1;
  }
  benchmark::AddCustomContext("machine", DescribeMachine());
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
