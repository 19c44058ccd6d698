// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "BenchmarkRow.h"

#include "CgalDelaunay.h"
#include "CudaDevice.h"
#include "DelaunayFlip.h"
#include "RowTiming.h"

#include <algorithm>

namespace delaunayflip
{
namespace
{

struct EngineTimes
{
  std::vector<double> Build, Flips, Store, Total;
};

class EngineBenchmark
{
public:
  EngineBenchmark(
    const BenchmarkMesh& mesh, const FlipOptions& options, std::vector<std::int64_t>& output)
    : Mesh(mesh),
      Options(options),
      Output(output)
  {
    this->Options.Geometry = mesh.Geometry;
  }

  double RunOnce(bool isWarm)
  {
    LapWatch watch;
    FlipSession session(this->Mesh.View(), this->Options);
    const double build = watch.Lap();
    session.Advance();
    const double flips = watch.Lap();
    session.StoreTriangles(MutableTriangleArray(this->Output.data(), this->Mesh.CountTriangles()));
    const double store = watch.Lap();
    if (isWarm)
    {
      this->Times.Build.push_back(build);
      this->Times.Flips.push_back(flips);
      this->Times.Store.push_back(store);
      this->Times.Total.push_back(build + flips + store);
    }
    this->Report = session.GetReport();
    return build + flips + store;
  }

  void Fill(BenchmarkRow& row) const
  {
    row.Program = this->Report.Backend;
    row.Build = GetMedian(this->Times.Build);
    row.Flips = GetMedian(this->Times.Flips);
    row.Store = GetMedian(this->Times.Store);
    row.Total = GetMedian(this->Times.Total);
    row.TotalFlips = this->Report.TotalFlips;
    row.Iterations = static_cast<std::int64_t>(this->Report.Iterations.size());
    row.Left = this->Report.NonDelaunayAfter;
    row.HasFailed = this->Mesh.EndsDelaunay && row.Left != 0;
    row.Note = row.HasFailed ? "FAILED: bad edges left" : "";
  }

private:
  const BenchmarkMesh& Mesh;
  FlipOptions Options;
  std::vector<std::int64_t>& Output;
  EngineTimes Times;
  FlipReport Report;
};

}

BenchmarkRow TimeEngine(const BenchmarkMesh& mesh, const FlipOptions& options,
  const RepetitionPlan& plan, std::vector<std::int64_t>& output)
{
  const bool onGpu = options.Backend == BackendKind::CUDA;
  BenchmarkRow row =
    MakeRow(mesh, onGpu ? "CUDA" : "Threads: " + std::to_string(options.NumberOfThreads));
  Try(row,
    [&]
    {
      output.assign(mesh.Ids.size(), 0);
      EngineBenchmark benchmark(mesh, options, output);
      TakePeakCudaMemory(); // of earlier runs
      row.Repetitions = Repeat(plan, [&](bool isWarm) { return benchmark.RunOnce(isWarm); });
      benchmark.Fill(row);
      const auto peak = static_cast<double>(TakePeakCudaMemory());
      row.DeviceBytes = onGpu && peak > 0 ? peak / static_cast<double>(row.Points) : NAN;
    });
  if (row.Repetitions == 0)
  {
    output.clear();
  }
  return row;
}

BenchmarkRow TimeCgal(const BenchmarkMesh& mesh, const RepetitionPlan& plan)
{
  BenchmarkRow row = MakeRow(mesh, "CGAL");
  Try(row,
    [&]
    {
      OwnedMesh<float> points;
      points.Points = mesh.Floats;
      std::vector<double> times;
      row.Repetitions = Repeat(plan,
        [&](bool isWarm)
        {
          const CgalTime time = TimeCgalDelaunay(points);
          if (isWarm)
          {
            times.push_back(1e3 * time.Seconds);
          }
          row.HasFailed = time.Triangles != row.Triangles;
          return 1e3 * time.Seconds;
        });
      row.Total = GetMedian(times);
      row.Note = row.HasFailed ? "FAILED: different number of triangles" : "from the points alone";
    });
  return row;
}

}
