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

namespace
{
/// Pairs of vertex ids of the fixed edges with two triangles, and perhaps of those with more, of
/// which each triangle lists them.
std::vector<std::int64_t> ListFixedEdges(const TriangleMesh& mesh, const FlipOptions& options,
  const BuildProgress& progress, bool withNonManifold)
{
  const ThreadBackend backend(options.NumberOfThreads);
  const MeshInput input{ mesh, mesh };
  const MeshSurvey survey = BuildMeshSurvey(input, options.Geometry, backend);
  progress.Reach(survey.Geometry, BuildStep::Surveyed);
  const SpatialOrder order = OrderMesh(input, survey, backend);
  progress.Reach(survey.Geometry, BuildStep::Ordered);
  const EdgeMeshInput edges{ input, survey, order, options.FeatureAngle };
  EdgeMeshResult built = BuildEdgeMesh(edges, LoadTriangles(edges, backend), backend, progress);
  progress.Reach(survey.Geometry, BuildStep::Fixed);
  const EdgeMeshView view = built.Edges.View();
  std::vector<std::int64_t> pairs;
  for (std::int64_t e = 0; e < built.Edges.NumberOfEdges; ++e)
  {
    const CornerPair corners = view.GetCorners(static_cast<EdgeId>(e));
    const TriangleRecord& triangle = view.Triangles[TriangleOf(corners.A)];
    const int slot = SlotOf(corners.A);
    const bool isListed = corners.B != NoCorner ||
      (withNonManifold && GetRole(triangle, slot) == CornerRole::OneOfMany);
    if (view.States[e] == EdgeState::Fixed && isListed && !IsLoop(triangle, slot))
    {
      pairs.insert(pairs.end(),
        { order.View().GetVertex(triangle.Vertices[NextSlot(slot)]),
          order.View().GetVertex(triangle.Vertices[PreviousSlot(slot)]) });
    }
  }
  return pairs;
}
}

std::vector<std::int64_t> FindFixedEdges(
  const TriangleMesh& mesh, const FlipOptions& options, const ProgressObserver& progress)
{
  CheckOptions(options);
  CheckMeshSize(mesh.Triangles.Count, mesh.Points.Count);
  const ConstraintInsertion insertion(mesh, options, {});
  return ListFixedEdges(
    insertion.GetMesh(mesh), insertion.GetOptions(options), BuildProgress(progress), false);
}

std::vector<std::int64_t> ListInnerFixedEdges(
  const TriangleMesh& mesh, const FlipOptions& options, const EdgeCounts& counts)
{
  return counts.Fixed > counts.Boundary ? ListFixedEdges(mesh, options, {}, true)
                                        : std::vector<std::int64_t>();
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
