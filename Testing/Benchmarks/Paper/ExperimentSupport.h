// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_EXPERIMENTSUPPORT_H
#define DELAUNAYFLIP_EXPERIMENTSUPPORT_H

#include "Experiments.h"
#include "PaperMethod.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

/// @file
/// Functions and types shared by several experiments.

namespace delaunayflip
{

/// The epsilon of eq. 5 for float angles, "experimentally estimated" like the paper's: with 5e-4
/// the loop does not end on a random bad mesh of 1 M points. Near pi a change of the cosine's last
/// bit changes acos by 3.5e-4.
constexpr double FloatEpsilon = 1e-3;

/// Milliseconds that a call takes.
template <typename Work>
double MeasureMilliseconds(const Work& work)
{
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
    .count();
}

/// Times of several runs, by what was timed.
class Stopwatches
{
public:
  explicit Stopwatches(const ExperimentSettings& settings)
    : Settings(settings)
  {
  }

  /// Calls run(), which returns an object of milliseconds, several times. The first call warms up
  /// and does not count, unless it took more than half of the available time.
  template <typename Run>
  void Repeat(const Run& run)
  {
    double spent = MeasureMilliseconds([&] { this->Add(run()); });
    const bool isWarmUp = spent < 500.0 * this->Settings.Seconds;
    if (!this->Settings.HasTimes || !isWarmUp)
    {
      return;
    }
    this->Samples.clear();
    for (int i = 0; i < this->Settings.Repetitions; ++i)
    {
      spent += MeasureMilliseconds([&] { this->Add(run()); });
      if (spent > 1e3 * this->Settings.Seconds)
      {
        break;
      }
    }
  }

  /// Adds the spread of every time to a row, unless the settings exclude times.
  void Store(Json& row) const
  {
    for (const auto& [name, times] : this->Samples.items())
    {
      std::vector<double> sorted = times.get<std::vector<double>>();
      std::sort(sorted.begin(), sorted.end());
      const std::size_t middle = sorted.size() / 2;
      const double median =
        sorted.size() % 2 == 1 ? sorted[middle] : 0.5 * (sorted[middle - 1] + sorted[middle]);
      if (this->Settings.HasTimes)
      {
        row[name] = { { "median", median }, { "smallest", sorted.front() },
          { "largest", sorted.back() }, { "runs", sorted.size() } };
      }
    }
  }

private:
  void Add(const Json& times)
  {
    for (const auto& [name, time] : times.items())
    {
      this->Samples[name].push_back(time);
    }
  }

  const ExperimentSettings& Settings;
  Json Samples = Json::object();
};

/// A result of either method: all that a row contains except times.
struct MethodRun
{
  std::vector<std::int32_t> Triangles;
  Json Row = Json::object();
};

/// Runs the engine on a mesh, as often as the settings say, and fills a row: "program", "backend",
/// "iterations", "flips", "bad_left", "blocked_left", "stop", times and, by iteration, "flipped"
/// and "excluded".
MethodRun RunOurs(const ExperimentSettings& settings, const TriangleMesh& mesh,
  const FlipOptions& options, const std::string& program);

/// The same for the paper's method. Flips are counted in a separate run.
MethodRun RunPapers(const ExperimentSettings& settings, const TriangleMesh& mesh,
  const PaperOptions& options, const std::string& program);

FlipOptions OnThreads(int threads);
FlipOptions OnGpu();

TriangleMesh WithTriangles(const TriangleMesh& mesh, const std::vector<std::int32_t>& triangles);

/// Edges that violate the exact in-circle criterion by x and y.
std::int64_t CountExactViolations(const TriangleMesh& mesh);

/// The number of triangles of `found` that are not in `expected`, in any order and winding.
std::int64_t CountDifferentTriangles(
  const std::vector<std::int32_t>& found, const std::vector<std::int32_t>& expected);

}

#endif
