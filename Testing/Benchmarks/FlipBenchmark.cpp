// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CgalDelaunay.h"
#include "DelaunayFlip.h"
#include "GeneratedMeshes.h"
#include "Machine.h"
#include "PeakMemory.h"
#include "SequentialLawson.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

/// @file
/// Usage: delaunay-flip-benchmark [Google Benchmark's options]. Times the building of edges and the
/// flips on random bad meshes, CGAL's Delaunay triangulation of the same points, and a sequential
/// Lawson. Ends with a table of the medians, their ratios and the peak memory, all from this run.

namespace delaunayflip
{
namespace
{

constexpr std::int64_t Sizes[] = { 100000, 1000000 };
constexpr int ThreadCounts[] = { 1, 2 };
constexpr int Repetitions = 5;
constexpr std::uint32_t Seed = 2013;

using Clock = std::chrono::steady_clock;

double SecondsSince(Clock::time_point start)
{
  return std::chrono::duration<double>(Clock::now() - start).count();
}

const OwnedMesh<float>& GetMesh(std::int64_t points)
{
  static std::map<std::int64_t, OwnedMesh<float>> meshes;
  auto found = meshes.find(points);
  if (found == meshes.end())
  {
    found = meshes.emplace(points, MakeRandomBadMesh(points, Seed)).first;
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

void BenchmarkEngine(benchmark::State& state)
{
  const OwnedMesh<float>& mesh = GetMesh(state.range(0));
  const FlipOptions options = MakeOptions(static_cast<int>(state.range(1)));
  for (auto iteration : state)
  {
    (void)iteration;
    const auto start = Clock::now();
    FlipSession session(mesh.View(), options);
    const double build = SecondsSince(start);
    session.Advance();
    state.SetIterationTime(SecondsSince(start));
    const FlipReport& report = session.GetReport();
    state.counters["build_ms"] = 1e3 * build;
    state.counters["iterations"] = static_cast<double>(report.Iterations.size());
    state.counters["flips"] = static_cast<double>(report.TotalFlips);
    if (report.NonDelaunayAfter != 0)
    {
      state.SkipWithError("the engine left bad edges");
    }
  }
}

void BenchmarkCgal(benchmark::State& state)
{
  const OwnedMesh<float>& mesh = GetMesh(state.range(0));
  for (auto iteration : state)
  {
    (void)iteration;
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
  for (auto iteration : state)
  {
    (void)iteration;
    const auto start = Clock::now();
    SequentialLawson lawson(mesh);
    state.counters["build_ms"] = 1e3 * SecondsSince(start);
    state.counters["flips"] = static_cast<double>(lawson.Run());
    state.SetIterationTime(SecondsSince(start));
    state.PauseTiming();
    OwnedMesh<float> result = mesh;
    result.Triangles = lawson.GetTriangles();
    if (FlipSession(result.View(), MakeOptions(1)).GetReport().NonDelaunayBefore != 0)
    {
      state.SkipWithError("the sequential Lawson left bad edges");
    }
    state.ResumeTiming();
  }
}

std::string EngineName(int threads)
{
  return "Engine " + std::to_string(threads) + (threads == 1 ? " thread" : " threads");
}

/// Prints as usual and keeps the times of every repetition.
class KeepingReporter : public benchmark::ConsoleReporter
{
public:
  void ReportRuns(const std::vector<Run>& runs) override
  {
    for (const Run& run : runs)
    {
      if (run.run_type == Run::RT_Iteration && !run.error_occurred)
      {
        this->Milliseconds[run.run_name.function_name + "/" + run.run_name.args].push_back(
          run.GetAdjustedRealTime());
      }
    }
    ConsoleReporter::ReportRuns(runs);
  }

  /// Median of the repetitions in milliseconds; 0 if the benchmark did not run.
  double GetMedian(const std::string& function, const std::string& arguments) const
  {
    const auto found = this->Milliseconds.find(function + "/" + arguments);
    if (found == this->Milliseconds.end())
    {
      return 0.0;
    }
    std::vector<double> sorted = found->second;
    std::sort(sorted.begin(), sorted.end());
    return sorted[sorted.size() / 2];
  }

private:
  std::map<std::string, std::vector<double>> Milliseconds;
};

void Register(
  const std::string& name, void (*function)(benchmark::State&), std::vector<std::int64_t> arguments)
{
  benchmark::RegisterBenchmark(name.c_str(), function)
    ->Args(arguments)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1)
    ->Repetitions(Repetitions);
}

void RegisterAll()
{
  for (std::int64_t points : Sizes)
  {
    for (int threads : ThreadCounts)
    {
      Register(EngineName(threads), BenchmarkEngine, { points, threads });
    }
    Register("CGAL Delaunay", BenchmarkCgal, { points });
    Register("Sequential Lawson", BenchmarkLawson, { points });
  }
}

void PrintRow(const KeepingReporter& reporter, const std::string& name, std::int64_t points,
  const std::string& arguments)
{
  const std::string size = std::to_string(points);
  const double time = reporter.GetMedian(name, arguments);
  const double cgal = reporter.GetMedian("CGAL Delaunay", size);
  const double lawson = reporter.GetMedian("Sequential Lawson", size);
  if (time > 0.0)
  {
    std::printf("%10s  %-18s %10.1f %13.2f %15.2f\n", size.c_str(), name.c_str(), time, cgal / time,
      lawson / time);
  }
}

void PrintRatios(const KeepingReporter& reporter)
{
  std::printf(
    "\n%10s  %-18s %10s %13s %15s\n", "points", "", "median ms", "CGAL / this", "Lawson / this");
  for (std::int64_t points : Sizes)
  {
    const std::string size = std::to_string(points);
    for (int threads : ThreadCounts)
    {
      PrintRow(reporter, EngineName(threads), points, size + "/" + std::to_string(threads));
    }
    PrintRow(reporter, "CGAL Delaunay", points, size);
    PrintRow(reporter, "Sequential Lawson", points, size);
  }
}

/// Bytes per point beyond input and output, by size and number of threads.
using MemoryTable = std::map<std::pair<std::int64_t, int>, double>;

MemoryTable MeasureMemory()
{
  MemoryTable table;
  for (std::int64_t points : Sizes)
  {
    for (int threads : ThreadCounts)
    {
      const std::int64_t bytes = MeasurePeakMemory(GetMesh(points), MakeOptions(threads));
      table[{ points, threads }] = static_cast<double>(bytes) / static_cast<double>(points);
    }
  }
  return table;
}

void PrintMemory(const MemoryTable& table)
{
  std::printf("\nPeak memory above input and output (resident size of a forked child, VmHWM at the "
              "end - VmRSS before):\n");
  for (const auto& [key, bytes] : table)
  {
    std::printf("%10lld  %-18s %10.1f bytes per point\n", static_cast<long long>(key.first),
      EngineName(key.second).c_str(), bytes);
  }
}

}
}

int main(int argc, char** argv)
{
  using namespace delaunayflip;
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
  const MemoryTable memory = MeasureMemory(); // forks, so it must come before any thread
  RegisterAll();
  KeepingReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  PrintRatios(reporter);
  PrintMemory(memory);
  std::printf("\n%s\n", DescribeMachine().c_str());
  return 0;
}
