// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_LOADEDRUN_H
#define DELAUNAYFLIP_LOADEDRUN_H

#include "LoadedMesh.h"
#include "RunProgress.h"
#include "SessionRun.h"
#include "ThreadBackend.h"

#include <cstdint>
#include <functional>
#include <future>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace delaunayflip
{

constexpr std::int64_t NoLimit = std::numeric_limits<std::int64_t>::max();

/// A run with a mesh on a backend: what the runs of a mesh and of points have in common.
/// BackendKind::Auto uses a GPU if there is one and the mesh is large enough. A journal records
/// what stages have done to the loaded mesh. If the GPU fails, at any time, threads repeat what is
/// in the journal, with the same bits, and the run continues there.
class LoadedRun : public SessionRun
{
public:
  bool Advance(
    std::int64_t iterations, const FlipObserver& observer, const ProgressObserver& progress) final;
  void Expect(const ResultMemory& memory) final { this->Expected.push_back(memory); }
  const FlipReport& GetReport() final;
  /// From now on angles are not measured. The report says that there are none.
  void LeaveAnglesOut() { this->MeasuresAngles = false; }

  /// Begins anew, and does all stages before the first flip. An observer may stop this.
  /// @returns whether it was not stopped.
  /// @throws as FlipSession's constructor.
  bool Begin();

  /// An entry of the journal: how much of a stage was done to the loaded mesh.
  struct Entry
  {
    std::size_t Stage; ///< The number of the stage.
    std::int64_t Count; ///< For Stage::Repeat.
  };
  /// For tests.
  const std::vector<Entry>& GetJournal() const { return this->Journal; }

protected:
  LoadedRun(const FlipOptions& options, const ProgressObserver& progress);

  //------------------------------------------------------------------------------
  // What a run adds.

  /// Loads the mesh. @param backend CUDA or Threads.
  virtual std::unique_ptr<LoadedMesh> LoadOn(BackendKind backend) = 0;

  void Reset() override;

  /// Reports the defects of the input, without those that flips have caused, and the counts of a
  /// run from points.
  virtual void ListDefects() = 0;

  /// Finds what fixed edges keep or hide, if the run reports it.
  virtual void MeasureKeptEdges() {}

  /// Plans refinement before its first round.
  virtual RefinementPlan PlanRefinement(LoadedMesh&) { return {}; }
  /// Takes over what refinement has made so far.
  virtual void TakeRefinement(LoadedMesh&) {}

  /// How many iterations observers can wait for.
  virtual std::int64_t GetBatch() const { return this->Progress.GetBatch(); }

  //------------------------------------------------------------------------------
  // Stages.

  /// Chooses a backend and loads the mesh there.
  /// @param isOnDevice whether the caller's arrays are on a GPU.
  /// @param triangles about how many there are.
  void Load(bool isOnDevice, std::int64_t triangles);
  void TestAllEdges();
  void RepeatTest(LoadedMesh& mesh);

  /// Flips until no bad edge or no iteration is left.
  /// @param givesUp is asked after each batch of iterations whether flips end here; it may take
  /// iterations out of the report.
  /// @returns whether they have ended.
  bool Flip(const std::function<bool()>& givesUp = {});
  void RepeatFlips(LoadedMesh& mesh, std::int64_t iterations);

  /// Makes rounds of refinement until all triangles are good, or no iteration is left. A round
  /// counts as an iteration. (LoadedRefinement.cpp)
  /// @returns whether refinement has ended.
  bool Refine();
  void RepeatRounds(LoadedMesh& mesh, std::int64_t rounds);
  /// Whether no more rounds follow.
  bool IsRefinementOver() const { return this->IsRefined || this->IsAtIterationLimit(); }
  /// Whether no more rounds follow in this call, so that triangles that are not good stay as they
  /// are.
  bool HasEndedRefinement() const { return this->IsRefinementOver() || this->WasStopped; }
  /// Whether the options allow no more iterations. Rounds count as iterations.
  bool IsAtIterationLimit() const;
  /// Makes a plan with the goals of the options.
  /// @param given the number of the caller's points. @param used those that the limit counts.
  RefinementPlan PlanGoals(const LoadedMesh& mesh, std::int64_t given, std::int64_t used);
  /// Finds options of refinement that have no effect: the goals, if the limit on iterations allows
  /// no round, or others, if there are no goals.
  Defect FindIdleOptions() const;
  /// Says that there are so many points, and refinement may add no more.
  Defect DescribeLimit(std::int64_t points) const;

  /// Measures the mesh at the end of a run.
  void MeasureEnd();

  /// Measures what the report has beside the counts of iterations. Reads the mesh, and only if the
  /// mesh has changed since the last call.
  void Measure();

  //------------------------------------------------------------------------------
  // What stages and getters consist of.

  /// The number of the first stage that may flip.
  std::size_t FindFlips() const;

  using MeshWork = std::function<void(LoadedMesh&)>;

  /// Calls work(mesh), and calls it again on the CPU if the GPU fails.
  /// @throws BackendUnavailable with BackendKind::CUDA.
  void OnBackend(const MeshWork& work);

  /// Does what OnBackend does, for a getter and if a mesh is loaded.
  /// @returns whether work was called and no observer stopped it.
  bool TryOnBackend(const MeshWork& work);

  /// Calls store(mesh), which writes to device memory, by TryOnBackend. @returns what it returns,
  /// or false if it was not called.
  template <typename Store>
  bool TryStoreOnDevice(const Store& store)
  {
    bool isStored = false;
    this->TryOnBackend([&](const LoadedMesh& mesh) { isStored = store(mesh); });
    return isStored;
  }

  /// Adds to the journal that the current stage has changed the mesh.
  /// @param count how much of it was done, as in Entry.
  void RecordChange(std::int64_t count);

  /// Begins to touch the pages of the memory that is expected, if a GPU flips.
  void TouchExpected();

  bool HasMoreFlips() const;
  bool MayIterate() const { return !this->WasStopped && this->CountIterations() < this->Limit; }
  std::int64_t CountIterations() const { return SizeOf(this->Report.Iterations); }
  void RunBatch();
  /// Tells observers of the iterations from one on, and records whether they stop the run.
  void TellIterations(std::int64_t first, bool hasMore);
  void RecordFound(const StepCounts& found);
  /// The share of the progress that the stages after the current one take.
  double SumLaterShares() const;
  /// Tells the observer that a share of the current stage, which follows flips, is done.
  /// @returns false if it asks to stop.
  bool TellStage(double share);

  FlipOptions Options;
  bool WantsRefinement = false; ///< Whether the options ask for refinement. Runs set it when made.
  BuildProgress Building; ///< Tells of the loading, and of what divide and conquer does later.
  double ShareBefore = 0.0; ///< The share of the progress before the loading.
  std::unique_ptr<LoadedMesh> Loaded; ///< None if the build was stopped.
  std::vector<Entry> Journal; ///< What has happened to the loaded mesh.
  RunProgress Progress;
  std::vector<Defect> InputDefects; ///< What stages have found before all edges are tested.
  StepCounts Found; ///< The counts of the last detection.
  std::int64_t Rounds = 0; ///< How often refinement has added points.
  std::int64_t MostPoints = 0; ///< FlipOptions::PointLimit, or its default.

  // What is known of the mesh as it is; Measure finds out the rest.
  bool AreAnglesKnown = true;
  /// Whether angles are measured when a mesh is loaded, and after the first iteration.
  bool MeasuresStart = true;
  bool MeasuresAngles = true; ///< Whether they are measured at the end.
  bool AreKeptEdgesKnown = false; ///< Whether it is known what kept edges hide.

private:
  void FallBack(const BackendUnavailable& error);
  void Replay();
  std::int64_t RefineOnce(LoadedMesh& mesh);
  std::int64_t GetIterationLimit() const;
  void RecordIterations(const std::vector<IterationCounts>& batch, double seconds);

  FlipObserver IterationObserver; ///< That of the Advance under way.
  std::int64_t Limit = 0; ///< The number of iterations at which it returns.
  std::int64_t RoundsBefore = 0; ///< Rounds of refinement before the Advance under way.
  bool IsRefined = false; ///< Whether there is nothing more to refine.
  StopWatch SinceBegin;
  bool OnCuda = false; ///< Whether a GPU has the mesh.
  std::vector<ResultMemory> Expected; ///< Announced memory that nobody touches yet.
  std::vector<std::future<void>> Touching; ///< Their destructors wait for the end.
};

}

#endif
