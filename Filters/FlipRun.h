// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef FlipRun_h
#define FlipRun_h

#include "DelaunayFlip.h"
#include "PolyDataBridge.h"
#include "UpdateProgress.h"

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

class vtkPolyData;

namespace delaunayflip
{

/// Flips the mesh of an input: all at once or, in a live update, a few iterations at a time, with
/// an output after each step.
class FlipRun
{
public:
  /// Optional cell arrays of the output.
  struct Extras
  {
    bool FlipCounts;
    bool Angles;
  };

  /// What an update asks for.
  struct Request
  {
    vtkPolyData* Input;
    vtkPolyData* Constraints; ///< Or null.
    PolyDataBridge::Settings Settings;
    FlipOptions Options;
    bool IsLive; ///< More updates will follow, and points may be moved in place between them.
    Extras Wanted;
    ProgressObserver Progress; ///< Kept by the run.
  };

  /// Begins at the triangles of the input.
  /// @throws as PolyDataBridge's and FlipSession's constructors.
  explicit FlipRun(const Request& request);
  FlipRun(const FlipRun&) = delete;
  FlipRun& operator=(const FlipRun&) = delete;

  /// Makes `run` the run for this request. It stays itself if the request is the same, apart from
  /// attributes. If only points have been moved since, it becomes a warm start: a run that begins
  /// with the triangles of the last one and the edges that were fixed in it. Otherwise, or if it is
  /// null, it becomes a new run.
  /// @returns whether it stayed itself.
  /// @throws as the constructor. After RunAborted, `run` is what it was, or null.
  static bool ContinueOrStart(std::unique_ptr<FlipRun>& run, const Request& request);

  FlipSession& GetSession() { return this->Session; }
  const FlipSession& GetSession() const { return this->Session; }

  /// Whether the observer of this update stopped the run before its first iteration.
  bool IsStopped() const { return this->Stopped; }

  /// What to tell of the session's progress to.
  ProgressObserver GetProgress() const { return this->Plan.ForSession(); }

  /// What has happened so far. Its defects name cells of the input.
  FlipReport GetReport() const;

  /// Writes the mesh as it is now.
  /// @returns false when the observer stopped it; then there are no angles.
  bool Store(vtkPolyData* output) const;

  /// What the last warning said.
  std::string Warning;

private:
  /// Modification times, of which no two objects ever have the same one, and places of arrays.
  using Stamps = std::vector<vtkMTimeType>;

  /// An input as it was at some update, and the bridge to it.
  struct Snapshot
  {
    Snapshot(const Request& request, bool copyPoints, const UpdatePlan& plan);

    Request Repeat(const Request& request) const;

    vtkSmartPointer<vtkPolyData> Mesh;
    vtkSmartPointer<vtkPolyData> Constraints; ///< Or null.
    Stamps Edges; ///< Of all, points aside, that decides which edges exist and which are fixed.
    Stamps Points;
    vtkMTimeType Time;
    PolyDataBridge Bridge;
  };

  /// The two snapshots of a new run; one for both where no update will follow.
  struct Snapshots
  {
    Snapshots(const Request& request, const UpdatePlan& plan);

    std::shared_ptr<const Snapshot> Current; ///< The attributes for the output are taken from it.
    std::shared_ptr<const Snapshot> Origin; ///< The session has views of its arrays.
  };

  /// Where a warm start begins; empty for other runs.
  struct Start
  {
    GeometryKind Geometry = GeometryKind::Auto;
    std::vector<std::int64_t> Triangles; ///< Vertex ids, three per slot.
    std::vector<std::int64_t> FixedEdges; ///< Pairs of vertex ids.
    std::int64_t Constraints = 0; ///< How many edges of the first mesh were constraints.
    std::int64_t UnmatchedConstraints = 0;
    std::int64_t InsertedConstraints = 0;
    std::int64_t ConstraintFlips = 0;
  };

  FlipRun(const Request& request, Snapshots input, Start start);

  static UpdatePlan MakePlan(const Request& request, bool isWarm);
  static Stamps StampEdges(const Request& request);
  static Stamps StampPoints(vtkPolyData* mesh);
  static void WarmStart(std::unique_ptr<FlipRun>& run, const Request& request);
  static TriangleMesh GetMesh(const Snapshots& input, const Start& start);
  bool Fits(const Request& request) const;
  bool IsWarm() const { return !this->Begin.Triangles.empty(); }
  FlipOptions GetStartOptions() const;
  FlipSession MakeSession() const;
  Start GetEnd(const ProgressObserver& progress) const;
  void AddUnmatchedConstraints(FlipReport& report) const;

  PolyDataBridge::Settings Settings;
  FlipOptions Options;
  Extras Wanted;
  UpdatePlan Plan;
  Snapshots Input;
  Start Begin; ///< The session has views of its arrays, too.
  FlipSession Session;
  bool Stopped;
};

}

#endif
