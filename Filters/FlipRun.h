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

/// A mesh on its way from an input to an output: the whole way at once or, in a live update, some
/// iterations at a time, with an output after each.
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
    bool IsLive; ///< Other updates will follow: points may be moved in place between them.
    ProgressObserver Progress; ///< Of the update; must not refer to what is gone after it.
  };

  /// Begins at the triangles of the input.
  /// @throws as PolyDataBridge's and FlipSession's constructors; SplitAborted.
  explicit FlipRun(const Request& request);
  FlipRun(const FlipRun&) = delete;
  FlipRun& operator=(const FlipRun&) = delete;

  /// The run to go on with. `last` itself (or null) when it was asked for the same, attributes
  /// aside. When only points have been moved since, a warm start: a run that begins at the
  /// triangles of `last`, with the fixed edges that it had. Else a run that begins anew.
  static std::unique_ptr<FlipRun> GoOn(std::unique_ptr<FlipRun> last, const Request& request);

  FlipSession& GetSession() { return this->Session; }

  /// Whether this update's observer has stopped the run before its first iteration.
  bool IsStopped() const { return this->Stopped; }

  /// For what the session tells of an update: the share of the update.
  ProgressObserver ScaleProgress(const ProgressObserver& progress) const;

  /// What has happened so far, with defects that name the input's cells.
  FlipReport GetReport() const;

  /// Cell arrays on request.
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
  /// Modification times: no two objects ever have the same.
  using Stamps = std::vector<vtkMTimeType>;

  /// An input as it was, and the bridge to it.
  struct Snapshot
  {
    Snapshot(const Request& request, bool copyPoints, const ProgressObserver& progress = {});

    vtkSmartPointer<vtkPolyData> Mesh;
    Stamps Edges; ///< Of all but points that decides which edges there are and which are fixed.
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
    std::int64_t Constraints = 0; ///< How many edges of the first mesh they held.
    std::int64_t UnmatchedConstraints = 0;
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
  Snapshots Current; ///< What passes to the output is its.
  Snapshots Origin; ///< The session views its arrays, and those of Begin.
  Start Begin;
  FlipSession Session;
  bool Stopped;
};

}

#endif
