// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_EXPERIMENTS_H
#define DELAUNAYFLIP_EXPERIMENTS_H

#include "DelaunayFlip.h"
#include "GeneratedMeshes.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <string>
#include <vector>

/// @file
/// The experiments of the paper, one function each. They return rows of JSON: one object for each
/// program and mesh. Times are {"median", "smallest", "largest", "runs"} in milliseconds.

namespace delaunayflip
{

using Json = nlohmann::ordered_json;

/// The settings of all experiments.
struct ExperimentSettings
{
  int Repetitions = 5; ///< Of each timed program, after one run to warm up.
  double Seconds = 20.0; ///< No repetition begins after this time.
  bool OnGpu = false; ///< Whether to use the GPU, too.
  bool HasTimes = true; ///< Without times every program runs once, and no row has a time.
};

/// The programs of an experiment to run. Empty: all.
using ProgramList = std::vector<std::string>;

/// Fig. 6: the chain of `triangles` triangles (even, at least 4).
Json RunChain(const ExperimentSettings& settings, const std::vector<std::int64_t>& triangles);

/// Figs. 8a and 9: a random bad mesh. Programs: "ours-gpu", "ours-1" (one thread), "ours-all",
/// "no-chunks", "paper-gpu", "paper-1", "paper-all", "lawson", "cgal".
Json RunRandom(
  const ExperimentSettings& settings, std::int64_t points, const ProgramList& programs);

/// Fig. 8b: triangles that differ from CGAL's.
Json RunQuality(
  const ExperimentSettings& settings, std::int64_t points, const std::vector<double>& epsilons);

/// Counts the triangles in a file of 32-bit ids that differ from CGAL's for the same random bad
/// mesh.
Json RunComparison(std::int64_t points, const std::string& path);

/// Fig. 11 and Table 2: a surface, by the paper's method, sequential Lawson and ours, with the
/// normal threshold (degrees) and without.
Json RunSurface(const ExperimentSettings& settings, const std::string& path, double threshold);

/// Future work 1: in-circle against opposite angles. Meshes: "random", "grid", "circles", "offset".
Json RunTests(const ExperimentSettings& settings, const std::string& mesh, std::int64_t points);

/// Future work 2: bad surfaces. Kinds: "flips", "splits", "anisotropic".
Json RunRuined(const ExperimentSettings& settings, const std::string& kind, std::int64_t points,
  const std::vector<double>& featureAngles);

/// The same rows for a surface of a file.
Json RunAsItIs(const ExperimentSettings& settings, const std::string& path,
  const std::vector<double>& featureAngles);

/// The mesh of RunRandom.
OwnedMesh<float> MakePaperRandomMesh(std::int64_t points);

}

#endif
