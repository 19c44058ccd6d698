// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PAPERMETHOD_H
#define DELAUNAYFLIP_PAPERMETHOD_H

#include "TriangleMesh.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

/// @file
/// The method of the paper itself, as a baseline for benchmarks: C. A. Navarro, N.
/// Hitschfeld-Kahler, E. Scheihing, GRAPP 2013. Written from the text of the paper alone. It works
/// on the paper's four arrays, with one thread per edge for all edges in every iteration, on a GPU
/// or on threads of the CPU.
///
/// Choices where the paper says nothing:
/// - if a thread claims only one triangle of its edge, that triangle stays claimed until the end of
///   the iteration;
/// - the loop ends after an iteration that found no bad edge, or at a limit;
/// - cosines are clamped to -1 .. 1 before acos.

namespace delaunayflip
{

enum class PaperTestKind
{
  OppositeAngles, ///< The paper's own.
  InCircle ///< The test that the paper names as future work. Planar only.
};

struct PaperOptions
{
  PaperTestKind Test = PaperTestKind::OppositeAngles;
  bool InDouble = false; ///< Coordinates and arithmetic in double; the paper uses float.
  int Dimension = 2; ///< 2: by x and y; 3: in space.

  /// Of eq. 5, in radians; of InCircle, relative to the magnitude of the determinant's terms.
  double Epsilon = 1e-3;

  /// In space, an edge stays if the normals of its two triangles differ by more than this many
  /// degrees when it is tested; 180 turns this off.
  double NormalThreshold = 180.0;

  std::int64_t MaximumIterations = 1000; ///< The paper has no limit.
  bool OnGpu = false;
  int NumberOfThreads = 0; ///< 0: as many as the machine has.
  bool CountsIterations = false; ///< Fill PaperResult::Counts, which slows the loop.
};

struct PaperIteration
{
  std::int64_t Bad = 0;
  std::int64_t Flipped = 0;
};

struct PaperResult
{
  std::vector<std::int32_t> Triangles;
  std::int64_t Iterations = 0; ///< Iterations that found a bad edge.
  bool Converged = false; ///< Whether the last iteration found no bad edge.
  std::vector<PaperIteration> Counts; ///< By iteration, if asked for.
  std::string Backend; ///< E.g. "CUDA: NVIDIA H200".
  double CopySeconds = 0.0; ///< For copying the mesh to the backend.
  double FlipSeconds = 0.0; ///< For the loop.

  std::int64_t CountFlips() const;
};

/// The arrays of a mesh, ready to run the loop once or several times.
class PaperMethod
{
public:
  /// Builds the arrays on the host.
  /// @param mesh with valid ids and fewer than 2^31 / 3 triangles; not used after the constructor.
  PaperMethod(const TriangleMesh& mesh, const PaperOptions& options);
  ~PaperMethod();

  /// Runs the loop on a copy of the arrays.
  /// @throws BackendUnavailable if a GPU is requested and there is none.
  PaperResult Run() const;

  class Runner;

private:
  std::unique_ptr<Runner> Implementation;
};

}

#endif
