// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ConstraintInsertion.h"
#include "DelaunayFlip.h"
#include "MeshOnBackend.h"
#include "StripSorting.h"
#include "ThreadBackend.h"
#include "ThreadFlipLoop.h"

#include <vector>

namespace delaunayflip
{

std::unique_ptr<LoadedMesh> LoadOnThreads(
  const TriangleMesh& mesh, const FlipOptions& options, const BuildProgress& progress)
{
  ThreadBackend backend(options.NumberOfThreads);
  const ThreadBackend::LocalMesh local = backend.Localize(mesh);
  return std::unique_ptr<LoadedMesh>(
    new MeshOnBackend<ThreadBackend>(mesh, local, options, std::move(backend), progress));
}

std::unique_ptr<LoadedMesh> LoadOnThreads(
  const PlaneArray& points, const FlipOptions& options, const BuildProgress& progress)
{
  return std::unique_ptr<LoadedMesh>(new MeshOnBackend<ThreadBackend>(
    points, true, options, ThreadBackend(options.NumberOfThreads), progress));
}

std::vector<std::int64_t> FindFixedEdges(
  const TriangleMesh& caller, const FlipOptions& options, const ProgressObserver& observer)
{
  CheckOptions(options);
  CheckMeshSize(caller.Triangles.Count, caller.Points.Count);
  const ConstraintInsertion insertion(caller, options, {});
  const TriangleMesh mesh = insertion.GetMesh(caller);
  const ThreadBackend backend(options.NumberOfThreads);
  const BuildProgress progress(observer);
  const MeshInput input{ mesh, mesh };
  const MeshSurvey survey = BuildMeshSurvey(input, insertion.GetOptions(options).Geometry, backend);
  progress.Reach(survey.Geometry, BuildStep::Surveyed);
  const SpatialOrder order = OrderMesh(input, survey, backend);
  progress.Reach(survey.Geometry, BuildStep::Ordered);
  const EdgeMeshInput edges{ input, survey, order, options.FeatureAngle };
  EdgeMeshResult built = BuildEdgeMesh(edges, LoadTriangles(edges, backend), backend, progress);
  progress.Reach(survey.Geometry, BuildStep::Fixed);
  const EdgeMeshView view = built.Edges.View();
  std::vector<std::int64_t> pairs; // of the fixed edges with two triangles
  for (std::int64_t e = 0; e < built.Edges.NumberOfEdges; ++e)
  {
    const CornerPair corners = view.GetCorners(static_cast<EdgeId>(e));
    if (view.States[e] == EdgeState::Fixed && corners.A != NoCorner && corners.B != NoCorner &&
      !IsLoop(view.Triangles[TriangleOf(corners.A)], SlotOf(corners.A)))
    {
      const Quad quad = view.GetQuad(corners);
      pairs.insert(pairs.end(), { order.View().GetVertex(quad.P), order.View().GetVertex(quad.Q) });
    }
  }
  return pairs;
}

GeometryKind FindGeometry(const TriangleMesh& mesh, const FlipOptions& options)
{
  CheckOptions(options);
  CheckMeshSize(mesh.Triangles.Count, mesh.Points.Count);
  if (options.Geometry != GeometryKind::Auto)
  {
    return options.Geometry;
  }
  const ThreadBackend backend(options.NumberOfThreads);
  return BuildMeshSurvey(MeshInput{ mesh, mesh }, options.Geometry, backend).Geometry;
}

}
