// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CgalDelaunay.h"
#include "ExperimentSupport.h"
#include "MeshAudit.h"
#include "SequentialLawson.h"

#include <cmath>
#include <fstream>
#include <functional>
#include <stdexcept>
#include <utility>

/// @file
/// Section 5.1: random bad meshes in the plane.

namespace delaunayflip
{

namespace
{

constexpr std::uint32_t Seed = 2013;
constexpr std::int64_t LargestUntiledMesh = 5000000;
constexpr double PointsOfTile = 250000.0;

PaperOptions MakePaperOptions(bool onGpu, int threads)
{
  PaperOptions options;
  options.Epsilon = FloatEpsilon;
  options.OnGpu = onGpu;
  options.NumberOfThreads = threads;
  options.MaximumIterations = 150;
  return options;
}

Json RunLawsonOn(const ExperimentSettings& settings, const OwnedMesh<float>& mesh)
{
  Json row = { { "program", "lawson" }, { "points", mesh.NumberOfPoints() },
    { "triangles", mesh.NumberOfTriangles() } };
  Stopwatches watches(settings);
  watches.Repeat(
    [&]
    {
      std::unique_ptr<SequentialLawson> lawson;
      const double build =
        MeasureMilliseconds([&] { lawson = std::make_unique<SequentialLawson>(mesh); });
      const double flips = MeasureMilliseconds([&] { row["flips"] = lawson->Run(); });
      return Json{ { "build_ms", build }, { "flips_ms", flips }, { "total_ms", build + flips } };
    });
  watches.Store(row);
  return row;
}

Json RunCgalOn(const ExperimentSettings& settings, const OwnedMesh<float>& mesh)
{
  Json row = { { "program", "cgal" }, { "points", mesh.NumberOfPoints() },
    { "triangles", mesh.NumberOfTriangles() } };
  Stopwatches watches(settings);
  watches.Repeat([&] { return Json{ { "total_ms", 1e3 * TimeCgalDelaunay(mesh).Seconds } }; });
  watches.Store(row);
  return row;
}

/// Surfaces are flipped without chunks. So a plane that is treated as a surface is flipped in
/// iterations over the whole mesh from the first one on.
FlipOptions WithoutChunks()
{
  FlipOptions options = OnThreads(0);
  options.Geometry = GeometryKind::Surface;
  options.FeatureAngle = 180.0;
  return options;
}

/// The programs of RunRandom by name.
std::vector<std::pair<std::string, std::function<Json()>>> ListPrograms(
  const ExperimentSettings& settings, const OwnedMesh<float>& mesh)
{
  const auto ours = [&](const std::string& name, const FlipOptions& options)
  {
    return [&settings, &mesh, name, options]
    { return RunOurs(settings, mesh.View(), options, name).Row; };
  };
  const auto papers = [&](const std::string& name, const PaperOptions& options)
  {
    return [&settings, &mesh, name, options]
    {
      MethodRun run = RunPapers(settings, mesh.View(), options, name);
      run.Row["bad_left"] = CountExactViolations(WithTriangles(mesh.View(), run.Triangles));
      return run.Row;
    };
  };
  return { { "ours-gpu", ours("ours-gpu", OnGpu()) }, { "ours-1", ours("ours-1", OnThreads(1)) },
    { "ours-all", ours("ours-all", OnThreads(0)) },
    { "no-chunks", ours("no-chunks", WithoutChunks()) },
    { "paper-gpu", papers("paper-gpu", MakePaperOptions(true, 0)) },
    { "paper-1", papers("paper-1", MakePaperOptions(false, 1)) },
    { "paper-all", papers("paper-all", MakePaperOptions(false, 0)) },
    { "lawson", [&] { return RunLawsonOn(settings, mesh); } },
    { "cgal", [&] { return RunCgalOn(settings, mesh); } } };
}

bool IsWanted(
  const ExperimentSettings& settings, const ProgramList& programs, const std::string& name)
{
  if (!settings.OnGpu && name.find("-gpu") != std::string::npos)
  {
    return false;
  }
  return programs.empty() || std::find(programs.begin(), programs.end(), name) != programs.end();
}

/// Adds "different" and "percent", the triangles that differ from CGAL's, and the number of edges
/// that are not Delaunay.
Json Compare(Json row, const TriangleMesh& mesh, const std::vector<std::int32_t>& triangles,
  const std::vector<std::int32_t>& expected)
{
  row.erase("flipped");
  row.erase("excluded");
  const std::int64_t different = CountDifferentTriangles(triangles, expected);
  row["different"] = different;
  row["percent"] = 300.0 * static_cast<double>(different) / static_cast<double>(expected.size());
  row["bad_left"] = CountExactViolations(WithTriangles(mesh, triangles));
  return row;
}

}

OwnedMesh<float> MakePaperRandomMesh(std::int64_t points)
{
  if (points <= LargestUntiledMesh)
  {
    return MakeRandomBadMesh(points, Seed);
  }
  const double tiles = static_cast<double>(points) / PointsOfTile;
  return MakeTiledBadMesh(points, static_cast<std::int32_t>(std::ceil(std::sqrt(tiles))), Seed);
}

Json RunRandom(const ExperimentSettings& settings, std::int64_t points, const ProgramList& programs)
{
  const OwnedMesh<float> mesh = MakePaperRandomMesh(points);
  Json rows = Json::array();
  for (const auto& [name, run] : ListPrograms(settings, mesh))
  {
    if (IsWanted(settings, programs, name))
    {
      rows.push_back(run());
    }
  }
  return rows;
}

Json RunQuality(
  const ExperimentSettings& settings, std::int64_t points, const std::vector<double>& epsilons)
{
  ExperimentSettings untimed = settings;
  untimed.HasTimes = false;
  const OwnedMesh<float> mesh = MakePaperRandomMesh(points);
  const std::vector<std::int32_t> expected = MakeCgalTriangles(mesh);
  Json rows = Json::array();
  const auto add = [&](const MethodRun& run)
  { rows.push_back(Compare(run.Row, mesh.View(), run.Triangles, expected)); };
  FlipOptions options = settings.OnGpu ? OnGpu() : OnThreads(0);
  add(RunOurs(untimed, mesh.View(), options, "ours"));
  options.TieRule = TieRuleKind::Canonical;
  add(RunOurs(untimed, mesh.View(), options, "ours, canonical"));
  for (const bool inDouble : { false, true })
  {
    for (const double epsilon : epsilons)
    {
      PaperOptions paper = MakePaperOptions(settings.OnGpu, 0);
      paper.InDouble = inDouble;
      paper.Epsilon = epsilon;
      add(RunPapers(untimed, mesh.View(), paper, "paper"));
    }
  }
  return rows;
}

Json RunComparison(std::int64_t points, const std::string& path)
{
  const OwnedMesh<float> mesh = MakePaperRandomMesh(points);
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  std::vector<std::int32_t> triangles(file ? static_cast<std::size_t>(file.tellg()) / 4 : 0);
  file.seekg(0);
  if (!file.read(reinterpret_cast<char*>(triangles.data()),
        static_cast<std::streamsize>(4 * triangles.size())))
  {
    throw std::runtime_error("cannot read " + path);
  }
  const Json row = { { "points", mesh.NumberOfPoints() }, { "triangles", triangles.size() / 3 } };
  return Json::array({ Compare(row, mesh.View(), triangles, MakeCgalTriangles(mesh)) });
}

}
