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
#include <vector>

namespace delaunayflip
{

/// What an update asks for.
struct FlipRequest
{
  vtkPolyData* Input;
  vtkPolyData* Constraints; ///< Or null.
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
  virtual ~UpdateRun() = default;

  virtual FlipSession& GetSession() = 0;

  /// Whether the observer of this update stopped the run before its first iteration.
  virtual bool IsStopped() const = 0;

  /// What to tell of the session's progress to.
  virtual ProgressObserver GetProgress() const = 0;

  /// What has happened so far. Its defects name cells of the input.
  virtual FlipReport GetReport() const = 0;

  /// Writes the mesh as it is now.
  /// @returns false when the observer stopped it; then there are no angles.
  virtual bool Store(vtkPolyData* output) const = 0;

  /// What the last warning said.
  std::string Warning;
};

/// A shallow copy, but with points of its own.
vtkSmartPointer<vtkPolyData> CopyPoints(vtkPolyData* input);

/// The run of a vtkDelaunayFlip.
class FlipRun : public UpdateRun
{
public:
  FlipRun(const FlipRun&) = delete;
  FlipRun& operator=(const FlipRun&) = delete;

  /// Makes `run` the run for this request. It stays itself if the request is the same, apart from
  /// attributes. If only points have been moved since, it becomes a warm start: a run that begins
  /// with the triangles of the last one and the edges that were fixed in it. Otherwise, or if it is
  /// null, it becomes a new run, which begins at the triangles of the input.
  /// @returns whether it stayed itself.
  /// @throws as PolyDataBridge's and FlipSession's constructors. After RunAborted, `run` is what it
  /// was, or null.
  /// @param run null, or a FlipRun.
  static bool ContinueOrStart(std::unique_ptr<UpdateRun>& run, const FlipRequest& request);

  FlipSession& GetSession() override { return this->Session; }
  bool IsStopped() const override { return this->Stopped; }
  ProgressObserver GetProgress() const override { return this->Plan.For(UpdatePlan::Session); }
  FlipReport GetReport() const override;
  bool Store(vtkPolyData* output) const override;

private:
  /// Modification times, of which no two objects ever have the same one, and sizes of arrays.
  using Stamps = std::vector<vtkMTimeType>;

  /// The mesh that the session reads, and the attributes for the output.
  struct Source
  {
    Source(const FlipRequest& request, const UpdatePlan& plan);

    Stamps Edges; ///< Of all, points aside, that decides which edges exist and which are fixed.
    Stamps Points;
    vtkMTimeType Time;
    vtkSmartPointer<vtkPolyData> Current; ///< The input as it was at the last update.
    vtkSmartPointer<vtkPolyData> Constraints; ///< Or null.
    vtkSmartPointer<vtkPolyData> Origin; ///< With points that no later update moves.
    PolyDataBridge Bridge; ///< To the origin.
  };

  /// Where a warm start begins; empty for other runs.
  struct Start
  {
    GeometryKind Geometry = GeometryKind::Auto;
    std::vector<std::int64_t> Triangles; ///< Vertex ids, three per slot.
    std::vector<std::int64_t> FixedEdges; ///< Pairs of vertex ids.
    FlipReport Report; ///< Of the last run.
  };

  FlipRun(const FlipRequest& request, UpdatePlan plan, std::unique_ptr<Source> input, Start start);

  static Stamps StampEdges(const FlipRequest& request);
  static TriangleMesh GetMesh(const Source& input, const Start& start);
  bool IsWarm() const { return !this->Begin.Triangles.empty(); }
  FlipSession MakeSession() const;
  Start GetEnd(const ProgressObserver& progress) const;

  FlipRequest Asked; ///< Its meshes may be gone.
  UpdatePlan Plan;
  std::unique_ptr<Source> Input; ///< The session has views of its arrays.
  Start Begin; ///< The session has views of its arrays, too.
  FlipSession Session;
  bool Stopped;
  vtkSmartPointer<vtkCellArray> Room; ///< For the only output, unless the run is live.
};

}

#endif
