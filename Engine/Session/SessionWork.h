// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_SESSIONWORK_H
#define DELAUNAYFLIP_SESSIONWORK_H

#include "Array.h"
#include "BuildProgress.h"
#include "ConstraintInsertion.h"
#include "DelaunayFlip.h"
#include "DeviceMesh.h"
#include "DividedRun.h"
#include "FlipError.h"
#include "HostMemory.h"
#include "LoadedMesh.h"
#include "PointRun.h"
#include "TriangleMesh.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <future>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace delaunayflip
{

constexpr std::int64_t NoLimit = std::numeric_limits<std::int64_t>::max();

/// The caller's mesh, in the host's memory or in a device's.
class CallerMesh
{
public:
  explicit CallerMesh(const TriangleMesh& mesh)
    : Host(mesh)
  {
  }
  explicit CallerMesh(const DeviceMesh& mesh);

  std::int64_t CountPoints() const { return this->Host.Points.Count; }
  std::int64_t CountTriangles() const { return this->Host.Triangles.Count; }

  const FixedEdges& GetFixedEdges() const { return this->Host; }

  /// Whether this array in the host's memory is that of the triangles.
  bool HasTriangles(const void* ids) const { return ids && ids == this->Host.Triangles.Data(); }

  /// The arrays in device memory; null if they are in the host's.
  const DeviceMesh* GetOnDevice() const { return this->Device ? &*this->Device : nullptr; }

  /// The arrays in the host's memory. They are copied from a device in the first call; the copies
  /// belong to this object and to those copied from it later.
  /// @throws BackendUnavailable.
  const TriangleMesh& GetOnHost();

  /// The GPU to use: `requested`, or if that is -1 the one that has the arrays.
  /// @throws InvalidOptions if another GPU, or none, has them.
  int ChooseDevice(int requested) const;

private:
  TriangleMesh Host; ///< Without points and triangles, except counts, until they are copied.
  std::optional<DeviceMesh> Device;
  std::vector<std::shared_ptr<const void>> Copies; ///< Of the arrays of a device.
};

/// @param what the array, for the message, e.g. "the points are".
/// @returns CUDA's number of the GPU that has an array, or -1 if the array is empty.
/// @throws InvalidOptions if no GPU has it.
int RequireOnDevice(const void* memory, std::int64_t size, const char* what);

/// An array in the memory of a device, ordered by a stream.
template <typename Value>
struct DeviceArray
{
  Value* Values;
  std::int64_t Size;
  DeviceStream Stream;
};

/// Gives a variable another value for as long as this lives.
template <typename Value>
class TemporaryValue
{
public:
  TemporaryValue(Value& variable, const Value& value)
    : Variable(variable),
      Before(std::exchange(variable, value))
  {
  }
  ~TemporaryValue() { this->Variable = std::move(this->Before); }
  TemporaryValue(const TemporaryValue&) = delete;
  TemporaryValue& operator=(const TemporaryValue&) = delete;

private:
  Value& Variable;
  Value Before;
};

/// The progress of a run that its observer is told, and how many iterations to make before it is
/// told again.
class RunProgress
{
public:
  /// Tells the observer a fraction of the run, or the last fraction if that is larger.
  /// @returns false if the observer asks to stop.
  bool Tell(const ProgressObserver& observer, double fraction)
  {
    this->Told = std::max(this->Told, fraction);
    return !observer || observer(this->Told);
  }

  /// Called when the build is done.
  /// @param badEdges the number of edges that may flip.
  /// @param buildSeconds the time without the test that found them.
  /// @param hasRest whether something follows the flips.
  void StartFlips(std::int64_t badEdges, double buildSeconds, double testSeconds, bool hasRest)
  {
    this->BadEdgesBefore = badEdges;
    this->Rest = hasRest ? 0.25 : 0.0;
    this->ToldBeforeFlips = this->Told;
    this->SecondsPerIteration = TestsPerIteration * testSeconds;
    this->SecondsBetweenCalls =
      std::max(LeastSecondsBetweenCalls, BuildsBetweenCalls * buildSeconds);
  }

  /// @param report has the iterations up to now, at least one.
  /// @param badEdges the number of edges that may flip next.
  /// @param limit the most iterations of the run. @returns the same as Tell.
  bool TellFlips(const ProgressObserver& observer, const FlipReport& report, std::int64_t badEdges,
    std::int64_t limit)
  {
    const double byLimit =
      static_cast<double>(report.Iterations.size()) / static_cast<double>(limit);
    const double share = std::max(byLimit, this->EstimateFlipped(report, badEdges));
    const double all = 1.0 - this->Rest - this->ToldBeforeFlips;
    return this->Tell(observer, this->ToldBeforeFlips + all * share);
  }

  /// @param share of what follows the flips. @returns the same as Tell.
  bool TellRest(const ProgressObserver& observer, double share)
  {
    return this->Tell(observer, 1.0 - this->Rest * (1.0 - share));
  }

  /// How many iterations, at least one, observers can wait for.
  std::int64_t GetBatch() const
  {
    constexpr double Most = 1e6;
    const double batch = this->SecondsBetweenCalls / std::max(this->SecondsPerIteration, 1e-9);
    return static_cast<std::int64_t>(std::clamp(batch, 1.0, Most));
  }

  void KeepTime(double secondsPerIteration) { this->SecondsPerIteration = secondsPerIteration; }

private:
  /// The more iterations in chunks run together, the faster they are. So observers of large meshes
  /// wait longer: for this share of the time that the build took.
  static constexpr double LeastSecondsBetweenCalls = 0.1;
  static constexpr double BuildsBetweenCalls = 0.5;

  /// The first iterations that span the mesh take up to this many times as long as the test of all
  /// edges.
  static constexpr double TestsPerIteration = 3.0;

  /// If bad edges do not become fewer, this many more iterations are expected than have been made.
  static constexpr double SpareIterations = 20.0;
  /// The share of all flips that have been made. Bad edges have decreased by some mean factor per
  /// iteration, and they, and flips with them, are expected to continue so; every bad edge takes a
  /// flip. If they have not decreased, as many more iterations are expected as have been made.
  double EstimateFlipped(const FlipReport& report, std::int64_t badEdges) const
  {
    const auto iterations = static_cast<double>(report.Iterations.size());
    const double left = static_cast<double>(badEdges) / static_cast<double>(this->BadEdgesBefore);
    const double factor =
      std::min(std::pow(left, 1.0 / iterations), 1.0 - 1.0 / (iterations + SpareIterations));
    const double expected =
      static_cast<double>(report.Iterations.back().Flipped) * factor / (1.0 - factor);
    const auto flipped = static_cast<double>(report.TotalFlips);
    return flipped / (flipped + std::max(expected, static_cast<double>(badEdges)));
  }

  double Told = 0.0;
  double ToldBeforeFlips = 0.0;
  double Rest = 0.0; ///< The share of the run after the flips.
  std::int64_t BadEdgesBefore = 0;
  double SecondsPerIteration = 0.0;
  double SecondsBetweenCalls = 0.0;
};

/// What a session has. BackendKind::Auto uses a GPU if there is one and the mesh is large enough.
/// If the GPU fails, at any time, the CPU repeats what was done, with the same bits, and continues.
struct FlipSession::Work
{
  Work(const CallerMesh& mesh, const FlipOptions& options, const ProgressObserver& progress,
    const std::vector<ResultMemory>& expected = {});
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

  /// Begins to touch the pages of the memory that is expected, if a GPU flips.
  void TouchExpected();

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
    std::vector<Value> all(isStored ? 0 : values.Size);
    if (!all.empty())
    {
      storeOnHost(all.data());
      CopyMemory(all.data(), values.Size * static_cast<std::int64_t>(sizeof(Value)), values.Values,
        values.Stream);
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
  bool FlipDivided(
    std::int64_t iterations, const FlipObserver& observer, const ProgressObserver& progress);
  void Build();
  void Detect();
  void Load();
  std::unique_ptr<LoadedMesh> LoadOn(BackendKind backend);
  void DivideIfLong();
  void InsertIfDone();
  void FallBack(const BackendUnavailable& error);
  void RepeatOnThreads();
  void Reset();
  void Abort();

  bool IsRunning() const { return this->Report.StopReason == StopReasonKind::Running; }
  std::int64_t CountIterations() const { return SizeOf(this->Report.Iterations); }
  std::int64_t GetIterationLimit() const;
  std::int64_t GetBatch() const;
  void Resume();
  void KeepFound(const StepCounts& found);
  void Keep(const std::vector<IterationCounts>& batch, double seconds);
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
  bool MayStop = false; ///< Whether the observer may stop what is under way, all of which is lost.
  FlipReport Report;
  bool IsDivided = false; ///< Whether the mesh is flipped in several parts.
  std::unique_ptr<DividedRun> Divided; ///< Of such a mesh, for which nothing is loaded.

  ConstraintInsertion Insertion; ///< The loaded mesh starts from its arrays.
  std::optional<CallerMesh> Start; ///< The mesh that iterations start from.
  BuildProgress Building; ///< Of the loading.
  std::unique_ptr<LoadedMesh> Loaded; ///< None if the build was aborted.
  bool OnCuda = false; ///< Whether a GPU has it.
  std::string Fallback; ///< Why the CPU replaced a GPU that exists; else empty.
  std::vector<ResultMemory> Expected; ///< Announced memory that nobody touches yet.
  std::vector<std::future<void>> Touching; ///< Their destructors wait for the end.
  RunProgress Progress;
  StepCounts Found; ///< The counts of the last detection.
  bool HasDetected = false; ///< Whether the first detection has been made.
  bool IsMeasured = true; ///< Whether MinimumAngleAfter is that of the mesh.
  bool AreSliversKnown = false; ///< Whether what kept edges hide is that of the mesh.
};

}

#endif
