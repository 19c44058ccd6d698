// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ExperimentSupport.h"

#include "MeshAudit.h"

#include <array>

namespace delaunayflip
{

namespace
{

void FillRow(const FlipReport& report, Json& row)
{
  row["backend"] = report.Backend;
  row["points"] = report.Points;
  row["triangles"] = report.Triangles;
  row["edges"] = report.Edges.Edges;
  row["iterations"] = report.Iterations.size();
  row["flips"] = report.TotalFlips;
  row["bad_before"] = report.NonDelaunayBefore;
  row["bad_left"] = report.NonDelaunayAfter;
  row["stop"] = ToString(report.StopReason);
  Json flipped = Json::array();
  Json excluded = Json::array();
  for (const IterationRecord& iteration : report.Iterations)
  {
    flipped.push_back(iteration.Flipped);
    excluded.push_back(iteration.Excluded);
  }
  row["flipped"] = flipped;
  row["excluded"] = excluded;
}

void FillRow(const PaperResult& result, Json& row)
{
  row["backend"] = result.Backend;
  row["iterations"] = result.Iterations;
  row["flips"] = result.CountFlips();
  row["stop"] = result.Converged ? "converged" : "iteration limit";
  Json flipped = Json::array();
  Json excluded = Json::array();
  for (const PaperIteration& iteration : result.Counts)
  {
    flipped.push_back(iteration.Flipped);
    excluded.push_back(iteration.Bad - iteration.Flipped);
  }
  row["flipped"] = flipped;
  row["excluded"] = excluded;
}

using Triangle = std::array<std::int32_t, 3>;

std::vector<Triangle> SortTriangles(const std::vector<std::int32_t>& ids)
{
  std::vector<Triangle> triangles(ids.size() / 3);
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    triangles[t] = { ids[3 * t], ids[3 * t + 1], ids[3 * t + 2] };
    std::sort(triangles[t].begin(), triangles[t].end());
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

}

MethodRun RunOurs(const ExperimentSettings& settings, const TriangleMesh& mesh,
  const FlipOptions& options, const std::string& program)
{
  MethodRun run;
  run.Row["program"] = program;
  run.Triangles.resize(3 * mesh.Triangles.Count);
  Stopwatches watches(settings);
  watches.Repeat(
    [&]
    {
      std::unique_ptr<FlipSession> session;
      const double build =
        MeasureMilliseconds([&] { session = std::make_unique<FlipSession>(mesh, options); });
      const double flips = MeasureMilliseconds([&] { session->Advance(); });
      const double store = MeasureMilliseconds(
        [&] {
          session->StoreTriangles({ run.Triangles.data(), mesh.Triangles.Count });
        });
      FillRow(session->GetReport(), run.Row);
      return Json{ { "build_ms", build }, { "flips_ms", flips }, { "store_ms", store },
        { "total_ms", build + flips + store } };
    });
  watches.Store(run.Row);
  return run;
}

MethodRun RunPapers(const ExperimentSettings& settings, const TriangleMesh& mesh,
  const PaperOptions& options, const std::string& program)
{
  MethodRun run;
  run.Row["program"] = program;
  run.Row["points"] = mesh.Points.Count;
  run.Row["triangles"] = mesh.Triangles.Count;
  run.Row["precision"] = options.InDouble ? "double" : "float";
  run.Row["epsilon"] = options.Epsilon;
  PaperOptions counting = options;
  counting.CountsIterations = true;
  PaperResult result = PaperMethod(mesh, counting).Run();
  FillRow(result, run.Row);
  run.Triangles = std::move(result.Triangles);
  if (settings.HasTimes)
  {
    std::unique_ptr<PaperMethod> method;
    const double build =
      MeasureMilliseconds([&] { method = std::make_unique<PaperMethod>(mesh, options); });
    Stopwatches watches(settings);
    watches.Repeat(
      [&]
      {
        const PaperResult timed = method->Run();
        return Json{ { "build_ms", build }, { "flips_ms", 1e3 * timed.FlipSeconds },
          { "copy_ms", 1e3 * timed.CopySeconds } };
      });
    watches.Store(run.Row);
  }
  return run;
}

FlipOptions OnThreads(int threads)
{
  FlipOptions options;
  options.Backend = BackendKind::Threads;
  options.NumberOfThreads = threads;
  return options;
}

FlipOptions OnGpu()
{
  FlipOptions options;
  options.Backend = BackendKind::CUDA;
  return options;
}

TriangleMesh WithTriangles(const TriangleMesh& mesh, const std::vector<std::int32_t>& triangles)
{
  TriangleMesh changed = mesh;
  changed.Triangles =
    TriangleArray(triangles.data(), static_cast<std::int64_t>(triangles.size()) / 3);
  return changed;
}

std::int64_t CountExactViolations(const TriangleMesh& mesh)
{
  FlipOptions options;
  options.Geometry = GeometryKind::PlanarXY;
  return CountNonDelaunayEdges(mesh, options);
}

std::int64_t CountDifferentTriangles(
  const std::vector<std::int32_t>& found, const std::vector<std::int32_t>& expected)
{
  const std::vector<Triangle> a = SortTriangles(found);
  const std::vector<Triangle> b = SortTriangles(expected);
  std::vector<Triangle> different;
  std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(different));
  return static_cast<std::int64_t>(different.size());
}

}
