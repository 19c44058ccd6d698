// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_BENCHMARKROW_H
#define DELAUNAYFLIP_BENCHMARKROW_H

#include "BenchmarkMesh.h"

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace delaunayflip
{

/// One program on one mesh. Times are medians in milliseconds; NaN and -1 mean that a number does
/// not apply.
struct BenchmarkRow
{
  std::string Mesh;
  std::string Program; ///< E.g. "CUDA: NVIDIA H200", "Threads: 8" or "CGAL".
  std::int64_t Points = -1;
  std::int64_t Triangles = -1;
  int Repetitions = 0; ///< After one to warm up; 0: there are no times, and Note says why.
  double Build = NAN; ///< From the caller's arrays to the engine's mesh with its bad edges found.
  double Flips = NAN;
  double Store = NAN; ///< Into an array whose memory has been written before.
  double Total = NAN;
  double TimesCuda = NAN; ///< Total divided by that of CUDA on the same mesh in the same run.
  std::int64_t TotalFlips = -1;
  std::int64_t Iterations = -1;
  std::int64_t Left = -1; ///< Bad edges of the result.
  double DeviceBytes = NAN; ///< Peak device memory in bytes per point.
  std::string Note;
  bool HasFailed = false;
};

/// How often a run is repeated: `Repetitions` times, fewer once they have taken `Seconds`.
struct RepetitionPlan
{
  int Repetitions = 5;
  double Seconds = 5.0;
};

/// Times the engine on a mesh.
/// @param output the result of the last run, three ids per triangle; empty if it failed.
BenchmarkRow TimeEngine(const BenchmarkMesh& mesh, const FlipOptions& options,
  const RepetitionPlan& plan, std::vector<std::int64_t>& output);

/// Times CGAL's Delaunay triangulation of the mesh's points, which are those of a convex mesh.
BenchmarkRow TimeCgal(const BenchmarkMesh& mesh, const RepetitionPlan& plan);

}

#endif
