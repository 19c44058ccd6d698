// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_ROWTIMING_H
#define DELAUNAYFLIP_ROWTIMING_H

#include "BenchmarkRow.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <new>
#include <string>
#include <vector>

/// @file
/// Helpers for the timings of rows.

namespace delaunayflip
{

/// Milliseconds since the last call.
class LapWatch
{
public:
  double Lap()
  {
    const std::chrono::steady_clock::time_point now = std::chrono::steady_clock::now();
    const std::chrono::duration<double, std::milli> elapsed = now - this->Last;
    this->Last = now;
    return elapsed.count();
  }

private:
  std::chrono::steady_clock::time_point Last = std::chrono::steady_clock::now();
};

inline double GetMedian(std::vector<double> values)
{
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

/// Calls run() once to warm up, then as often as planned. run() returns milliseconds, and by
/// `isWarm` whether they count. @returns how many of them count.
template <typename Run>
int Repeat(const RepetitionPlan& plan, const Run& run)
{
  run(false);
  double spent = 0.0;
  int done = 0;
  while (done < plan.Repetitions && (done == 0 || spent < 1e3 * plan.Seconds))
  {
    spent += run(true);
    ++done;
  }
  return done;
}

/// Calls work() and turns an exception into the note of a row. Running out of memory does not count
/// as a failure: some machines are too small.
template <typename Work>
void Try(BenchmarkRow& row, const Work& work)
{
  const std::string noMemory = "out of memory";
  try
  {
    work();
  }
  catch (const std::bad_alloc&)
  {
    row.Note = "skipped: " + noMemory;
  }
  catch (const std::exception& error)
  {
    row.Note = error.what();
    row.HasFailed = row.Note.find(noMemory) == std::string::npos;
    row.Note = (row.HasFailed ? "FAILED: " : "skipped: ") + row.Note;
  }
}

inline BenchmarkRow MakeRow(const BenchmarkMesh& mesh, const std::string& program)
{
  BenchmarkRow row;
  row.Mesh = mesh.Name;
  row.Program = program;
  row.Points = mesh.CountPoints();
  row.Triangles = mesh.CountTriangles();
  return row;
}

}

#endif
