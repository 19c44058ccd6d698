// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CudaDevice.h"
#include "DelaunayFlip.h"
#include "GeneratedMeshes.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

namespace delaunayflip
{
namespace
{

using Clock = std::chrono::steady_clock;

double MillisecondsSince(Clock::time_point start)
{
  return 1e3 * std::chrono::duration<double>(Clock::now() - start).count();
}

double MedianOf(std::vector<double> values)
{
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

template <typename Real>
void Measure(
  const char* name, const OwnedMesh<Real>& mesh, BackendKind backend, int threads, int repetitions)
{
  FlipOptions options;
  options.Backend = backend;
  options.NumberOfThreads = threads;
  std::vector<double> build, flip, store;
  std::vector<std::int64_t> ids(mesh.Triangles.begin(), mesh.Triangles.end());
  std::vector<std::int64_t> out(ids.size());
  TriangleMesh view = mesh.View();
  view.Triangles = TriangleArray(ids.data(), mesh.NumberOfTriangles());
  FlipReport report;
  for (int i = 0; i < repetitions + 1; ++i)
  {
    auto start = Clock::now();
    FlipSession session(view, options);
    const double buildTime = MillisecondsSince(start);
    start = Clock::now();
    session.Advance();
    const double flipTime = MillisecondsSince(start);
    start = Clock::now();
    session.StoreTriangles(MutableTriangleArray(out.data(), mesh.NumberOfTriangles()));
    const double storeTime = MillisecondsSince(start);
    report = session.GetReport();
    if (i > 0)
    {
      build.push_back(buildTime);
      flip.push_back(flipTime);
      store.push_back(storeTime);
    }
  }
  std::printf(
    "%-12s %10lld points %-22s build %9.2f  flips %9.2f  store %8.2f ms  %10lld flips %6zu "
    "iterations %lld left\n",
    name, static_cast<long long>(mesh.NumberOfPoints()), report.Backend.c_str(), MedianOf(build),
    MedianOf(flip), MedianOf(store), static_cast<long long>(report.TotalFlips),
    report.Iterations.size(), static_cast<long long>(report.NonDelaunayAfter));
  std::fflush(stdout);
}
}
}

int main(int argc, char** argv)
{
  using namespace delaunayflip;
  const BackendKind cuda = HasCudaDevice() ? BackendKind::CUDA : BackendKind::Threads;
  for (int i = 1; i < argc; ++i)
  {
    const auto mesh = MakeRandomBadMesh(std::atoll(argv[i]), 2013);
    Measure("random bad", mesh, cuda, 0, 5);
    Measure("random bad", mesh, BackendKind::Threads, 0, 1);
  }
  Measure("chain", MakeWorstCaseMesh(1000), cuda, 0, 2);
  Measure("grid", MakeGridMesh(1000, 1000), cuda, 0, 3);
  return 0;
}
