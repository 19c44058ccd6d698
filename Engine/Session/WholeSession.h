// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_WHOLESESSION_H
#define DELAUNAYFLIP_WHOLESESSION_H

#include "ConstraintInsertion.h"
#include "FlipEngine.h"
#include "RunProgress.h"
#include "SessionWork.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace delaunayflip
{

/// Flips the whole mesh on one backend, and reports its iterations. BackendKind::Auto uses a GPU if
/// there is one and the mesh is large enough. If the GPU fails, at any time, the CPU repeats what
/// was done, with the same bits, and continues.
class WholeSession : public SessionWork
{
public:
  WholeSession(
    const CallerMesh& mesh, const FlipOptions& options, const ProgressObserver& progress);

  bool Advance(std::int64_t iterations, const FlipObserver& observer,
    const ProgressObserver& progress) override;
  const FlipReport& GetReport() override;

  using SessionWork::StoreTriangles;
  void StoreTriangles(const MutableTriangleArray& triangles) override;
  using SessionWork::StoreFlipCounts;
  void StoreFlipCounts(std::int32_t* counts) override;
  EngineTriangles ViewTriangles() const override;
  HostTriangles ViewHostTriangles() const override;

protected:
  bool TryToStoreTriangles(
    const MutableTriangleArray& triangles, const DeviceStream& stream) override;
  bool TryToStoreFlipCounts(std::int32_t* counts, const DeviceStream& stream) override;

private:
  /// What an engine is made from.
  struct EngineInput
  {
    CallerMesh Mesh; ///< With the constraints inserted.
    FlipOptions Options;
    BuildProgress Progress;
  };

  /// Calls work(), and forgets all when an observer stops it before there is a mesh to show for it:
  /// while one is built, or while the CPU repeats what a GPU has lost.
  /// @returns whether it was not stopped.
  template <typename Work>
  bool Try(const Work& work)
  {
    try
    {
      work();
      return true;
    }
    catch (const RunAborted&)
    {
      this->Reset();
      this->Report.StopReason = StopReasonKind::Aborted;
      return false;
    }
  }

  /// Calls work(engine), and calls it again on the CPU if the GPU fails.
  /// @throws BackendUnavailable with BackendKind::CUDA.
  template <typename Work>
  auto OnEngine(const Work& work)
  {
    try
    {
      const std::unique_ptr<DeviceScope> current = this->Engine->MakeCurrent();
      return work(*this->Engine);
    }
    catch (const BackendUnavailable& error)
    {
      this->FallBack(error);
    }
    return work(*this->Engine);
  }

  void Build();
  void BuildEngine();
  CallerMesh InsertConstraints(const ProgressObserver& tell);
  void MakeEngine();
  void FallBack(const BackendUnavailable& error);
  void Reset();

  bool IsRunning() const { return this->Report.StopReason == StopReasonKind::Running; }
  std::int64_t GetIterationLimit() const;
  void Resume();
  void Iterate(std::int64_t most, const FlipObserver& observer, const ProgressObserver& progress);
  void Detected(const StepCounts& found);
  void Keep(const IterationCounts& counts, double seconds);
  void Tell(const FlipObserver& observer, std::size_t first);
  void MeasureEnd();
  double MeasureAngle();

  FlipOptions Options;
  ConstraintInsertion Insertion; ///< The engine starts from its arrays.
  ProgressObserver Observer; ///< Of the call under way, else the constructor's.
  std::optional<EngineInput> Input; ///< None if the build was aborted.
  std::unique_ptr<FlipEngine> Engine; ///< None if the build was aborted.
  std::string Fallback; ///< Why the CPU replaced a GPU that exists; else empty.
  RunProgress Progress;
  StepCounts Found; ///< The counts of the last detection.
  bool HasDetected = false; ///< Whether the engine has made the first detection.
  FlipReport Report;
  bool IsMeasured = true; ///< Whether MinimumAngleAfter is that of the mesh.
};

}

#endif
