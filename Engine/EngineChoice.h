// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_ENGINECHOICE_H
#define DELAUNAYFLIP_ENGINECHOICE_H

#include "CallerMesh.h"
#include "FlipEngine.h"
#include "FlipError.h"
#include "FlipLoop.h"
#include "FlipOptions.h"
#include "TriangleMesh.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace delaunayflip
{

/// A mesh on the backend of the options. BackendKind::Auto uses a GPU if there is one and the mesh
/// is large enough. If the GPU fails, at any time, the CPU repeats what was done, with the same
/// bits, and continues.
class ChosenEngine
{
public:
  /// The arrays of `mesh` must stay unchanged as long as this object exists.
  /// @param progress is told of the build and, in any function, of what is repeated after a
  /// failure.
  /// @throws BackendUnavailable with BackendKind::CUDA; so do all other functions.
  /// @throws RunAborted; so do all other functions.
  ChosenEngine(const CallerMesh& mesh, const FlipOptions& options, const BuildProgress& progress);

  /// Why the CPU replaced a GPU that exists; else empty.
  const std::string& GetFallback() const { return this->Fallback; }

  const FlipReport& GetInputReport() const { return this->Engine->GetInputReport(); }

  // The same as FlipLoop's.
  StepCounts Detect();
  std::vector<IterationCounts> Advance(const AdvancePlan& plan);
  StepCounts GetFound() const { return this->Engine->GetLoop().GetFound(); }
  double FindLargestSquaredCotangent();

  // The same as FlipEngine's. With `atOnce`, as for the caller's input, nothing is written until
  // the whole result is known.
  void StoreTriangles(const MutableTriangleArray& triangles, bool atOnce);
  void StoreFlipCounts(std::int32_t* counts);
  bool StoreTrianglesOnDevice(const MutableTriangleArray& triangles, const DeviceStream& stream);
  bool StoreFlipCountsOnDevice(std::int32_t* counts, const DeviceStream& stream);
  EngineTriangles ViewTriangles() const { return this->Engine->ViewTriangles(); }
  HostTriangles ViewHostTriangles() const { return this->Engine->ViewHostTriangles(); }
  Defect FindTurnedTriangles();
  void Audit();

private:
  /// Calls work(engine), and calls it again on the CPU if the GPU fails.
  template <typename Work>
  auto Run(const Work& work)
  {
    try
    {
      return this->RunOnce(work);
    }
    catch (const BackendUnavailable& error)
    {
      if (this->Options.Backend == BackendKind::CUDA)
      {
        throw;
      }
      this->FallBack(error.what());
    }
    return this->RunOnce(work);
  }

  template <typename Work>
  auto RunOnce(const Work& work)
  {
    const std::unique_ptr<DeviceScope> current = this->Engine->MakeCurrent();
    return work(*this->Engine);
  }

  void FallBack(const std::string& reason);
  void Repeat();

  std::unique_ptr<FlipEngine> MakeEngine();

  CallerMesh Mesh;
  FlipOptions Options;
  BuildProgress Progress;
  std::unique_ptr<FlipEngine> Engine;
  std::string Fallback;
  bool HasDetected = false;
  std::int64_t Iterations = 0;
};

}

#endif
