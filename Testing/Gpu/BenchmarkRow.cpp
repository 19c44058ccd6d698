// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "BenchmarkRow.h"

#include "CgalDelaunay.h"
#include "CudaDevice.h"
#include "EngineTiming.h"

#include <algorithm>

namespace delaunayflip
{

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
      FlipOptions onMesh = options;
      onMesh.Geometry = mesh.Geometry;
      const MutableTriangleArray result(output.data(), mesh.CountTriangles());
      EngineTiming timing;
      TakePeakCudaMemory(); // of earlier runs
      row.Repetitions = Repeat(plan,
        [&](bool isWarm)
        {
          return timing.RunOnce(
            isWarm, [&]() { return FlipSession(mesh.View(), onMesh); },
            [&](const FlipSession& session) { session.StoreTriangles(result); });
        });
      timing.Fill(row, mesh.EndsDelaunay);
      row.Program = timing.GetReport().Backend;
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
