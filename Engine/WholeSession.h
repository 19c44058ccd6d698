// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_WHOLESESSION_H
#define DELAUNAYFLIP_WHOLESESSION_H

#include "ConstraintInsertion.h"
#include "EngineChoice.h"
#include "FlipLoop.h"
#include "RunProgress.h"
#include "SessionWork.h"

#include <cstddef>
#include <cstdint>
#include <optional>

namespace delaunayflip
{

/// Makes a loop from the whole mesh, and a report from its iterations.
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
  static FlipOptions Check(const CallerMesh& mesh, const FlipOptions& options);

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

  // The beginning: SessionBuild.cpp.
  void Build();
  void BuildEngine(const ProgressObserver& tell);
  CallerMesh InsertConstraints(const ProgressObserver& tell);
  void DetectFirst();
  void Reset();

  // Iterations: SessionRun.cpp.
  void Run(std::int64_t iterations, const FlipObserver& observer, const ProgressObserver& progress);
  bool IsRunning() const { return this->Report.StopReason == StopReasonKind::Running; }
  std::int64_t GetIterationLimit() const;
  void Resume();
  void Iterate(std::int64_t most, const FlipObserver& observer, const ProgressObserver& progress);
  void Detected(const StepCounts& found);
  void Keep(const IterationCounts& counts, double seconds);
  void Tell(const FlipObserver& observer, std::size_t first);
  void Tell(const ProgressObserver& progress);
  void MeasureEnd();
  void UpdateDefects();
  double MeasureAngle();

  FlipOptions Options;
  ConstraintInsertion Insertion; ///< The engine starts from its arrays.
  ProgressObserver Observer; ///< Of the call under way, else the constructor's.
  std::optional<ChosenEngine> Engine; ///< None if its build was aborted.
  RunProgress Progress;
  StepCounts Found; ///< The counts of the last Detect.
  FlipReport Report;
  bool IsMeasured = true; ///< Whether MinimumAngleAfter is that of the mesh.
};

}

#endif
