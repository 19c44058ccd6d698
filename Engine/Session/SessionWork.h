// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_SESSIONWORK_H
#define DELAUNAYFLIP_SESSIONWORK_H

#include "Array.h"
#include "BuildProgress.h"
#include "CallerMesh.h"
#include "ConstraintInsertion.h"
#include "DelaunayFlip.h"
#include "DividedSession.h"
#include "FlipError.h"
#include "HostMemory.h"
#include "LoadedMesh.h"
#include "PointRun.h"
#include "RunProgress.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>

namespace delaunayflip
{

constexpr std::int64_t NoLimit = std::numeric_limits<std::int64_t>::max();

/// An array in the memory of a device, ordered by a stream.
template <typename Value>
struct DeviceArray
{
  Value* Values;
  std::int64_t Size;
  DeviceStream Stream;
};

/// What a session has. BackendKind::Auto uses a GPU if there is one and the mesh is large enough.
/// If the GPU fails, at any time, the CPU repeats what was done, with the same bits, and continues.
struct FlipSession::Work
{
  Work(const CallerMesh& mesh, const FlipOptions& options, const ProgressObserver& progress);
  Work(const PointInput& points, const PointOptions& options, const ProgressObserver& progress);

  /// Calls work(mesh), and calls it again on the CPU if the GPU fails.
  /// @throws BackendUnavailable with BackendKind::CUDA.
  template <typename Function>
  auto OnBackend(const Function& work)
  {
    try
    {
      const std::unique_ptr<DeviceScope> current = this->Loaded->MakeCurrent();
      return work(*this->Loaded);
    }
    catch (const BackendUnavailable& error)
    {
      this->FallBack(error);
    }
    return work(*this->Loaded);
  }

  /// The same, if a mesh is loaded. @returns whether it was called and no observer stopped it.
  template <typename Function>
  bool TryOnBackend(const Function& work)
  {
    try
    {
      if (this->Loaded)
      {
        this->OnBackend(work);
      }
    }
    catch (const RunAborted&)
    {
      this->Abort();
    }
    return this->Loaded != nullptr;
  }

  /// Stores `width` values for every triangle by store(values), through an array of its own if
  /// triangles are removed, or if nothing may be written until all are known.
  template <typename Value, typename Store>
  void StoreKept(int width, Value* values, bool atOnce, const Store& store) const
  {
    const bool areRemoved = this->Cloud && this->Cloud->HasRemoved();
    if (!areRemoved && !atOnce)
    {
      store(values);
      return;
    }
    HostMemory memory;
    const auto size = static_cast<std::size_t>(width * this->Loaded->GetInputReport().Triangles);
    Array<Value> all(size, memory);
    store(all.Data());
    areRemoved ? this->Cloud->CopyKept(all.Data(), width, values)
               : static_cast<void>(std::copy_n(all.Data(), size, values));
  }

  /// Writes values into device memory by store(mesh), which says whether it could, or else by
  /// storeOnHost(values) and a copy.
  /// @param what the array, for messages.
  template <typename Value, typename Store, typename StoreOnHost>
  void StoreOnDevice(
    DeviceArray<Value> values, const char* what, const Store& store, const StoreOnHost& storeOnHost)
  {
    RequireOnDevice(values.Values, values.Size, what);
    bool isStored = false;
    if (!this->Cloud || !this->Cloud->HasRemoved())
    {
      this->TryOnBackend([&](const LoadedMesh& mesh) { isStored = store(mesh); });
    }
    if (!isStored)
    {
      StoreThroughHost(values.Values, values.Size, values.Stream, storeOnHost);
    }
  }

  /// @throws InvalidOptions
  const PointRun& RequirePoints() const
  {
    if (!this->Cloud)
    {
      throw InvalidOptions("the session is not one from points");
    }
    return *this->Cloud;
  }

  void TryToBuild();
  void Build();
  void Detect();
  void Load();
  std::unique_ptr<LoadedMesh> LoadOn(BackendKind backend);
  void DivideIfLong();
  void InsertIfDone();
  void FallBack(const BackendUnavailable& error);
  void Reset();
  void Abort();

  bool IsRunning() const { return this->Report.StopReason == StopReasonKind::Running; }
  std::int64_t CountIterations() const
  {
    return static_cast<std::int64_t>(this->Report.Iterations.size());
  }
  std::int64_t GetIterationLimit() const;
  void Resume();
  void KeepFound(const StepCounts& found);
  void Keep(const IterationCounts& counts, double seconds);
  double MeasureAngle();
  void MeasureEnd();
  void ListDefects();
  void ReportPoints();

  CallerMesh Mesh; ///< Empty in a session from points.
  std::unique_ptr<PointRun> Cloud; ///< Of a session from points.
  bool ByDivision = false; ///< Whether these are triangulated by divide and conquer.
  std::int64_t IterationsBeforeDivision = 0;
  std::int64_t IterationsBeforeInsertion = 0; ///< Of segments, if they are inserted.
  FlipOptions Options;
  ProgressObserver Observer; ///< Of the call under way, else the constructor's.
  FlipReport Report;
  std::unique_ptr<DividedSession>
    Divided; ///< Null unless in several parts. Then only this is used.

  ConstraintInsertion Insertion; ///< The loaded mesh starts from its arrays.
  std::optional<CallerMesh> Start; ///< The mesh that iterations start from.
  BuildProgress Building; ///< Of the loading.
  std::unique_ptr<LoadedMesh> Loaded; ///< None if the build was aborted.
  std::string Fallback; ///< Why the CPU replaced a GPU that exists; else empty.
  RunProgress Progress;
  StepCounts Found; ///< The counts of the last detection.
  bool HasDetected = false; ///< Whether the first detection has been made.
  bool IsMeasured = true; ///< Whether MinimumAngleAfter is that of the mesh.
  bool AreSliversKnown = false; ///< Whether KeepsSliver is that of the mesh.
};

}

#endif
