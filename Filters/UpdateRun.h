// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef UpdateRun_h
#define UpdateRun_h

#include "DelaunayFlip.h"
#include "UpdateReport.h"

#include "vtkCellArray.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <functional>
#include <memory>
#include <set>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

class vtkFieldData;

namespace delaunayflip
{

class UpdateRun;

/// What an update asks for.
struct UpdateRequest
{
  virtual ~UpdateRequest() = default;

  /// Whether there are triangles, or points from which to make them.
  virtual bool HasWork() const = 0;

  /// Makes `run` the run for this request. It stays the same run if the request has not changed,
  /// apart from attributes. Otherwise, or if it is null, it becomes another one, with the session
  /// of the last run or without one.
  /// @returns whether it stayed the same run.
  /// @throws as the functions that read an input. After RunAborted, `run` is what it was, or null.
  virtual bool ContinueOrStart(std::unique_ptr<UpdateRun>& run) const = 0;

  vtkPolyData* Input = nullptr;
  vtkPolyData* Others = nullptr; ///< The second input, or null.
  bool IsLive = false; ///< More updates will follow, and points may be moved in place between them.
  /// The run is kept for the next update, which may have the same points at other places.
  bool KeepsRun = false;
  vtkIdType IterationsPerUpdate = 1; ///< If the run is live; 0: as many as fit into 50 ms.
  ProgressObserver Progress; ///< Kept by the run.
  std::function<bool()> IsAborted; ///< Asked before a run begins.
};

/// Returns a visitor for a filter's ForEachOption that copies its properties to these options.
template <typename Options>
auto SetterOf(Options& options)
{
  return [&options](const char*, const auto& property, auto member)
  {
    auto& option = options.*member;
    option = static_cast<std::decay_t<decltype(option)>>(property);
  };
}

/// A mesh that is flipped at once or, in a live update, a few iterations at a time, with an output
/// after each step.
class UpdateRun
{
public:
  explicit UpdateRun(UpdatePlan plan)
    : Plan(std::move(plan))
  {
  }
  virtual ~UpdateRun() = default;
  UpdateRun(const UpdateRun&) = delete;
  UpdateRun& operator=(const UpdateRun&) = delete;

  /// Opens a session. To be called if there is none. @throws as FlipSession's constructor.
  virtual void OpenSession() = 0;

  /// Makes all iterations or, in a live update, those of a step.
  /// @param report receives each iteration when it is done, for observers of the progress.
  /// @returns whether there is more to do.
  bool Advance(const UpdateRequest& request, FlipReport& report);

  /// What has happened so far. Its defects name cells of the input.
  virtual FlipReport GetReport() const = 0;

  /// Writes the mesh as it is now.
  /// @returns false when the observer stopped it. Then there are no angles.
  virtual bool Store(vtkPolyData* output) const = 0;

  const FlipSession* GetSession() const { return this->Session.get(); }

  /// The session, for views that draw its triangles with the points of the output. Null if the
  /// session may add points.
  virtual const FlipSession* GetSessionToDraw() const { return this->GetSession(); }

  /// Whether this run has moved the points of the one before it. There may be more or fewer
  /// triangles than before.
  virtual bool HasFollowed() const { return false; }

  std::set<std::string> Warnings; ///< The texts of all so far.

protected:
  ProgressObserver GetProgress() const { return this->Plan.For(UpdatePlan::Session); }

  UpdatePlan Plan;
  vtkSmartPointer<vtkCellArray> Room; ///< For the only output, unless the run is live.
  std::unique_ptr<FlipSession> Session; ///< May still touch the room when it is destroyed.
};

/// Makes the runs of a filter. In a live update it keeps the run until the next update. It does so,
/// too, if the request says so; but such a run is at its end.
///
/// Its states between two updates, where a run is that of a live update:
///
///     run   next          can continue  what the next update does
///     null  StepAndStore  yes           begins a run; the filter is new or was restarted
///     null  StepAndStore  no            the same, after a failure or without a live update; but
///                                       nobody is told that there is more to do
///     kept  StepAndStore  yes           makes a step and puts the mesh out
///     kept  StepAndStore  no            puts the mesh out, at the end of the run
///     any   Step          any           makes a step of a kept run and puts nothing out
///     kept  Store         any           puts the mesh out after such a step
///
/// A change of the input or of an option begins another run, whatever the state. Its first step
/// puts the mesh out, unless only a step is asked for and the run has followed points that have
/// moved.
class RunKeeper
{
public:
  enum class UpdateKind
  {
    StepAndStore,
    Step,
    Store
  };

  /// Flips a mesh. Observers may call any other function meanwhile.
  /// @param report receives what happens while it happens.
  /// @throws what a run throws. The caller then drops the run.
  void Update(const UpdateRequest& request, FlipReport& report, vtkPolyData* output);

  /// Frees the run, if there is one.
  /// @param canContinue whether the next update is asked for as a step of a live run.
  void Drop(bool canContinue);

  /// Whether there is a live run.
  bool HasRun() const { return this->Run != nullptr && this->IsLive; }

  /// The session of the live run; null if there is none.
  const FlipSession* GetSession() const;

  /// Likewise, but see UpdateRun::GetSessionToDraw.
  const FlipSession* GetSessionToDraw() const;

  /// Keeps the text of a warning.
  /// @returns whether it differs from all before it about this run, or there is no run.
  bool IsNewWarning(const std::string& text);

  bool CanContinue = true; ///< Whether another step can change the mesh.
  UpdateKind Next = UpdateKind::StepAndStore; ///< What the next update does.

private:
  std::unique_ptr<UpdateRun> Run;
  bool IsLive = false; ///< The run is that of a live update.
};

//------------------------------------------------------------------------------
/// Makes a shallow copy that has points of its own.
vtkSmartPointer<vtkPolyData> CopyPoints(vtkPolyData* input);

/// How the arrays of an input were, to find out whether they have changed since.
class Stamps
{
public:
  void AddNumber(vtkIdType number) { this->All.push_back({ nullptr, nullptr, 0, number, 0 }); }

  /// @param array may be null.
  /// @param owner may be marked as modified instead of the array.
  /// @param since is another time at which the array may have been modified.
  void AddArray(vtkAbstractArray* array, vtkObject* owner = nullptr, vtkMTimeType since = 0);
  void AddCells(vtkCellArray* cells);
  void AddPoints(vtkPolyData* mesh, vtkMTimeType since = 0);

  /// Adds the arrays, and which of them are active.
  void AddArrays(vtkFieldData* data, vtkMTimeType since = 0);

  /// Whether these arrays are the same objects and unchanged, or others with the same values. A
  /// reader makes others if its output was released and it is executed again.
  bool Fit(const Stamps& now) const;

private:
  struct Stamp
  {
    vtkSmartPointer<vtkAbstractArray> Array;
    vtkSmartPointer<vtkObject> Owner;
    vtkMTimeType Time; ///< No two objects ever have the same one.
    vtkIdType Count; ///< How many values: cells grow in place without being marked as modified.
    vtkMTimeType Since; ///< Several stamps may have the same one.

    vtkMTimeType FindTime() const;
    bool Fits(const Stamp& now) const;
    bool MayHaveSameValues(const Stamp& now) const;
    bool HasSameValues(const Stamp& now) const;
  };

  std::vector<Stamp> All;
};

}

#endif
