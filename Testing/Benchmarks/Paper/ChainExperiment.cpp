// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ExperimentSupport.h"
#include "SequentialLawson.h"

/// @file
/// Fig. 6: the worst case.

namespace delaunayflip
{

namespace
{

/// Whether the flips of iterations 1, 2, ... are 1, 2, ... m / 2 ... 2, 1.
bool IsRamp(const Json& flipped, std::int64_t triangles)
{
  bool isRamp = static_cast<std::int64_t>(flipped.size()) == triangles - 1;
  for (std::int64_t i = 1; isRamp && i < triangles; ++i)
  {
    isRamp = flipped[static_cast<std::size_t>(i - 1)] == std::min(i, triangles - i);
  }
  return isRamp;
}

/// The small integers of the chain in single precision.
OwnedMesh<float> MakeChain(std::int64_t triangles)
{
  const OwnedMesh<double> chain = MakeWorstCaseMesh(static_cast<std::int32_t>(triangles / 2 + 1));
  OwnedMesh<float> mesh;
  mesh.Points.assign(chain.Points.begin(), chain.Points.end());
  mesh.Triangles = chain.Triangles;
  return mesh;
}

/// Removes long lists of flips, which only repeat what "is_ramp" says.
Json Shorten(Json row, std::int64_t triangles)
{
  constexpr std::int64_t LongestList = 100;
  row["is_ramp"] = IsRamp(row["flipped"], triangles);
  if (triangles > LongestList)
  {
    row.erase("flipped");
    row.erase("excluded");
  }
  return row;
}

Json RunLawsonOnChain(const ExperimentSettings& settings, const OwnedMesh<float>& mesh)
{
  Json row = { { "program", "lawson" }, { "triangles", mesh.NumberOfTriangles() } };
  Stopwatches watches(settings);
  watches.Repeat(
    [&]
    {
      SequentialLawson lawson(mesh);
      return Json{ { "flips_ms", MeasureMilliseconds([&] { row["flips"] = lawson.Run(); }) } };
    });
  watches.Store(row);
  return row;
}

}

Json RunChain(const ExperimentSettings& settings, const std::vector<std::int64_t>& triangles)
{
  Json rows = Json::array();
  for (const std::int64_t count : triangles)
  {
    const OwnedMesh<float> mesh = MakeChain(count);
    const auto add = [&](const FlipOptions& options, const std::string& program)
    { rows.push_back(Shorten(RunOurs(settings, mesh.View(), options, program).Row, count)); };
    add(OnThreads(1), "ours-1");
    if (settings.OnGpu)
    {
      add(OnGpu(), "ours-gpu");
    }
    PaperOptions paper;
    paper.OnGpu = settings.OnGpu;
    paper.InDouble = true;
    paper.Epsilon = 1e-9;
    paper.MaximumIterations = 2 * count;
    Json row = RunPapers(settings, mesh.View(), paper, "paper").Row;
    rows.push_back(Shorten(row, count));
    rows.push_back(RunLawsonOnChain(settings, mesh));
  }
  return rows;
}

}
