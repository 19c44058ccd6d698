// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef FlipRun_h
#define FlipRun_h

#include "DelaunayFlip.h"
#include "PolyDataBridge.h"
#include "UpdateProgress.h"

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace delaunayflip
{

/// What an update asks for.
struct FlipRequest
{
  vtkPolyData* Input;
  vtkPolyData* Constraints; ///< Null without a second input.
  BridgeSettings Settings;
  FlipOptions Options;
  bool IsLive; ///< More updates will follow, and points may be moved in place between them.
  bool WantsFlipCounts, WantsAngles; ///< Optional cell arrays of the output.
  ProgressObserver Progress; ///< Kept by the run.
};

/// Flips the mesh of an input: all at once or, in a live update, a few iterations at a time, with
/// an output after each step.
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

  /// What to tell of the session's progress to.
  ProgressObserver GetProgress() const { return this->Plan.For(UpdatePlan::Session); }

  /// What has happened so far. Its defects name cells of the input.
  virtual FlipReport GetReport() const = 0;

  /// Writes the mesh as it is now.
  /// @returns false when the observer stopped it; then there are no angles.
  virtual bool Store(vtkPolyData* output) const = 0;

  vtkSmartPointer<vtkCellArray> Room; ///< For the only output, unless the run is live.
  std::unique_ptr<FlipSession> Session; ///< May still touch the room when it is destroyed.
  std::string Warning; ///< What the last warning said.

protected:
  UpdatePlan Plan;
};

/// A shallow copy, but with points of its own.
vtkSmartPointer<vtkPolyData> CopyPoints(vtkPolyData* input);

/// What the arrays of an input were like, to tell whether they have changed since.
class Stamps
{
public:
  void AddNumber(vtkIdType number) { this->All.push_back({ nullptr, nullptr, 0, number }); }

  /// @param array or null. @param owner which may be marked as modified instead of the array.
  /// @param since when else it may have been modified.
  void AddArray(vtkAbstractArray* array, vtkObject* owner = nullptr, vtkMTimeType since = 0);
  void AddCells(vtkCellArray* cells);
  void AddPoints(vtkPolyData* mesh, vtkMTimeType since = 0);

  /// Adds the arrays, and which of them are active.
  void AddArrays(vtkFieldData* data);

  /// Whether these arrays are the same objects and unchanged or, as where a reader whose output was
  /// released has been executed again, others with the same values.
  bool Fit(const Stamps& now) const;

private:
  struct Stamp
  {
    vtkSmartPointer<vtkAbstractArray> Array;
    vtkSmartPointer<vtkObject> Owner;
    vtkMTimeType Time; ///< No two objects ever have the same one.
    vtkIdType Count; ///< How many values: cells grow in place without being marked as modified.

    vtkMTimeType FindTime() const;
    bool Fits(const Stamp& now) const;
  };

  std::vector<Stamp> All;
};

/// The run of a vtkDelaunayFlip.
class FlipRun : public UpdateRun
{
public:
  /// Makes `run` the run for this request. It stays itself if the request is the same, apart from
  /// attributes. If only points have been moved since, it becomes a warm start: a run that begins
  /// with the triangles of the last one and the edges that were fixed in it. Otherwise, or if it is
  /// null, it becomes a new run, which begins at the triangles of the input.
  /// @returns whether it stayed itself.
  /// @throws as PolyDataBridge's and FlipSession's constructors. After RunAborted, `run` is what it
  /// was, or null.
  /// @param run null, or a FlipRun.
  static bool ContinueOrStart(std::unique_ptr<UpdateRun>& run, const FlipRequest& request);

  FlipReport GetReport() const override;
  bool Store(vtkPolyData* output) const override;

private:
  /// Where a warm start begins; empty for other runs.
  struct Start
  {
    GeometryKind Geometry = GeometryKind::Auto;
    std::vector<std::int64_t> Triangles; ///< Vertex ids, three per slot.
    std::vector<std::int64_t> FixedEdges; ///< Pairs of vertex ids.
    FlipReport Report; ///< What the last run did.
  };

  FlipRun(const FlipRequest& request, UpdatePlan plan);

  static Stamps StampEdges(const FlipRequest& request);
  TriangleMesh GetMesh(const Start& start) const;
  void OpenSession(Start start);
  bool IsWarm() const { return !this->Begin.Triangles.empty(); }
  Start GetEnd(const ProgressObserver& progress) const;

  FlipRequest Asked; ///< Its meshes may be gone.
  Stamps Edges; ///< All but points that decides which edges exist and which are fixed.
  Stamps Points;
  vtkSmartPointer<vtkPolyData> Current; ///< The input as it was at the last update.
  vtkSmartPointer<vtkPolyData> Constraints; ///< Null without a second input.
  vtkSmartPointer<vtkPolyData> Origin; ///< With points that no later update moves.
  PolyDataBridge Bridge; ///< To the origin. The session has views of its arrays.
  Start Begin; ///< The session has views of its arrays, too.
};

}

#endif
