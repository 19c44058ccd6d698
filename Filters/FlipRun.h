// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef FlipRun_h
#define FlipRun_h

#include "DelaunayFlip.h"
#include "PolyDataBridge.h"

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
  /// What an update asks for.
  struct Request
  {
    vtkPolyData* Input;
    vtkPolyData* Constraints; ///< Or null.
    PolyDataBridge::Settings Settings;
    FlipOptions Options;
    bool IsLive; ///< More updates will follow, and points may be moved in place between them.
    ProgressObserver Progress; ///< Used during this update only.
  };

  /// Begins at the triangles of the input.
  /// @throws as PolyDataBridge's and FlipSession's constructors; SplitAborted.
  explicit FlipRun(const Request& request);
  FlipRun(const FlipRun&) = delete;
  FlipRun& operator=(const FlipRun&) = delete;

  /// The run for this request. It is `last` itself if the request is the same, apart from
  /// attributes. If only points have been moved since, it is a warm start: a run that begins with
  /// the triangles of `last` and the edges that were fixed in it. Otherwise, or if `last` is null,
  /// it is a new run.
  static std::unique_ptr<FlipRun> GoOn(std::unique_ptr<FlipRun> last, const Request& request);

  FlipSession& GetSession() { return this->Session; }

  /// Whether the observer of this update stopped the run before its first iteration.
  bool IsStopped() const { return this->Stopped; }

  /// Converts the session's progress to that of the whole update.
  ProgressObserver ScaleProgress(const ProgressObserver& progress) const;

  /// What has happened so far. Its defects name cells of the input.
  FlipReport GetReport() const;

  /// Optional cell arrays.
  struct Extras
  {
    bool FlipCounts;
    bool Angles;
  };

  /// Writes the mesh as it is now.
  void Store(vtkPolyData* output, const Extras& extras) const;

  /// What the last warning said.
  std::string Warning;

private:
  /// Modification times, of which no two objects ever have the same one, and places of arrays.
  using Stamps = std::vector<vtkMTimeType>;

  /// An input as it was at some update, and the bridge to it.
  struct Snapshot
  {
    Snapshot(const Request& request, bool copyPoints, const ProgressObserver& progress = {});

    Request Repeat(const Request& request) const;

    vtkSmartPointer<vtkPolyData> Mesh;
    vtkSmartPointer<vtkPolyData> Constraints; ///< Or null.
    Stamps Edges; ///< Of all, points aside, that decides which edges exist and which are fixed.
    Stamps Points;
    vtkMTimeType Time;
    PolyDataBridge Bridge;
  };
  using Snapshots = std::shared_ptr<const Snapshot>;

  /// Where a warm start begins; empty for other runs.
  struct Start
  {
    std::vector<std::int64_t> Triangles; ///< Vertex ids, three per slot.
    std::vector<std::int64_t> FixedEdges; ///< Pairs of vertex ids.
    std::int64_t Constraints = 0; ///< How many edges of the first mesh were constraints.
    std::int64_t UnmatchedConstraints = 0;
    std::int64_t InsertedConstraints = 0;
    std::int64_t ConstraintFlips = 0;
  };

  FlipRun(const Request& request, Start start);

  static Stamps StampEdges(const Request& request);
  static Stamps StampPoints(vtkPolyData* mesh);
  static std::unique_ptr<FlipRun> StartWarmly(
    std::unique_ptr<FlipRun> last, const Request& request);
  bool Fits(const Request& request) const;
  bool GoesBy(GeometryKind geometry) const;
  bool IsWarm() const { return !this->Begin.Triangles.empty(); }
  TriangleMesh GetStartMesh() const;
  FlipOptions GetStartOptions() const;
  FlipSession MakeSession(const ProgressObserver& progress) const;
  Start GetEnd() const;
  void AddUnmatchedConstraints(FlipReport& report) const;

  PolyDataBridge::Settings Settings;
  FlipOptions Options;
  Snapshots Current; ///< The attributes for the output are taken from it.
  Snapshots Origin; ///< The session has views of its arrays, and of those of Begin.
  Start Begin;
  FlipSession Session;
  bool Stopped;
};

}

#endif
