// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ConstraintInsertion.h"
#include "DelaunayFlip.h"
#include "MeshOnBackend.h"
#include "Strips.h"
#include "ThreadBackend.h"
#include "ThreadFlipLoop.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace delaunayflip
{

/// Puts the points into their strips, and then sorts every strip, which fits a cache.
template <typename Real>
struct StripSorter<Real, ThreadBackend>
{
  struct Item
  {
    Real X, Y;
    VertexId Id;

    bool operator<(const Item& other) const
    {
      if (this->X != other.X)
      {
        return this->X < other.X;
      }
      if (this->Y != other.Y)
      {
        return this->Y < other.Y;
      }
      return this->Id < other.Id;
    }
  };

  static StripPoints<Real> Sort(
    const PlaneArray& points, const StripBounds& bounds, const ThreadBackend& backend)
  {
    StripPoints<Real> sorted;
    sorted.Strips = bounds.CountStrips();
    const StripFinder findStrip = bounds.View();
    const auto unused = static_cast<std::uint32_t>(sorted.Strips); // not finite
    Array<std::uint32_t> stripOf = backend.MakeArray<std::uint32_t>(points.Count);
    backend.ForEach(points.Count,
      [&](std::int64_t i)
      { stripOf[i] = IsFinitePoint(points, i) ? findStrip(points.Get(i, 1)) : unused; });
    Array<Item> items = backend.MakeArray<Item>(points.Count);
    // The points of a range go to places all over the array. It is touched before, or the first
    // ranges would wait for all of its memory, and an observer would wait for them.
    backend.TouchPages(items.Data(), points.Count * static_cast<std::int64_t>(sizeof(Item)));
    const std::vector<std::uint32_t> starts = backend.PlaceByDigit(
      points.Count, unused + 1, [&](std::int64_t i) { return stripOf[i]; },
      [&](std::int64_t i, std::uint32_t place)
      {
        items[place] = { static_cast<Real>(points.Get(i, 0)), static_cast<Real>(points.Get(i, 1)),
          static_cast<VertexId>(i) };
      });
    sorted.Count = starts[unused];
    sorted.Starts = backend.MakeArray<std::uint32_t>(sorted.Strips + 1);
    std::copy_n(starts.begin(), sorted.Strips + 1, sorted.Starts.Data());
    sorted.Coordinates = backend.MakeArray<Real>(2 * sorted.Count);
    CoordinatePair<Real>* sortedPlaces = sorted.Places();
    sorted.Ids = backend.MakeArray<VertexId>(sorted.Count);
    const auto store = [&](const Item* first, const Item* last)
    {
      for (const Item* item = first; item < last; ++item)
      {
        sortedPlaces[item - items.Data()] = { item->X, item->Y };
        sorted.Ids[item - items.Data()] = item->Id;
      }
    };
    const std::int64_t stripGrain =
      std::max<std::int64_t>(1, 4096 * sorted.Strips / (sorted.Count + 1));
    backend.ForRange(
      sorted.Strips,
      [&](std::int64_t begin, std::int64_t end)
      {
        for (std::int64_t strip = begin; strip < end; ++strip)
        {
          SortStrip(items.Data() + sorted.Starts[strip], items.Data() + sorted.Starts[strip + 1],
            store, backend);
        }
      },
      stripGrain);
    return sorted;
  }

  /// Calls store(first, last) with sorted items. One strip may have most of the points, as where
  /// these lie along a line.
  template <typename Store>
  static void SortStrip(Item* first, Item* last, const Store& store, const ThreadBackend& backend)
  {
    constexpr std::int64_t Most = 1 << 16;
    if (last - first <= Most)
    {
      std::sort(first, last);
      store(first, last);
      return;
    }
    Item* const middle = first + (last - first) / 2;
    // This is a task, so that an observer is asked after it.
    backend.ForTasks(1, [&](std::int64_t) { std::nth_element(first, middle, last); });
    Item* const bounds[3] = { first, middle, last };
    backend.ForTasks(
      2, [&](std::int64_t half) { SortStrip(bounds[half], bounds[half + 1], store, backend); });
  }
};

//------------------------------------------------------------------------------
std::unique_ptr<LoadedMesh> LoadOnThreads(
  const TriangleMesh& mesh, const FlipOptions& options, const BuildProgress& progress)
{
  ThreadBackend backend(options.NumberOfThreads);
  ThreadBackend::LocalMesh local = backend.Localize(mesh);
  return std::unique_ptr<LoadedMesh>(new MeshOnBackend<ThreadBackend>(
    mesh, std::move(local), options, std::move(backend), progress));
}

std::unique_ptr<LoadedMesh> LoadOnThreads(
  const PlaneArray& points, const FlipOptions& options, const BuildProgress& progress)
{
  return std::unique_ptr<LoadedMesh>(new MeshOnBackend<ThreadBackend>(
    points, true, options, ThreadBackend(options.NumberOfThreads), progress));
}

namespace
{
/// The edges of a mesh on the host, before any flip.
struct HostEdges
{
  HostEdges(const TriangleMesh& mesh, const FlipOptions& options, const BuildProgress& progress)
    : Backend(options.NumberOfThreads)
  {
    const ThreadBackend& backend = this->Backend;
    const MeshInput input{ mesh, mesh };
    const MeshSurvey survey = BuildMeshSurvey(input, options.Geometry, backend);
    progress.Reach(survey.Geometry, BuildStep::Surveyed);
    this->Order = OrderMesh(input, survey, backend);
    progress.Reach(survey.Geometry, BuildStep::Ordered);
    const EdgeMeshInput edges{ input, survey, this->Order, options.FeatureAngle };
    this->Edges =
      std::move(BuildEdgeMesh(edges, LoadTriangles(edges, backend), backend, progress).Edges);
    progress.Reach(survey.Geometry, BuildStep::Fixed);
  }

  ThreadBackend Backend; ///< It has the memory of the others.
  SpatialOrder Order;
  EdgeMesh Edges;
};

/// Pairs of vertex ids of the fixed edges with two triangles and, if asked for, of those with more,
/// once for each of their triangles.
std::vector<std::int64_t> ListFixedEdges(const TriangleMesh& mesh, const FlipOptions& options,
  const BuildProgress& progress, bool withNonManifold)
{
  HostEdges built(mesh, options, progress);
  const SpatialOrder& order = built.Order;
  const EdgeMeshView view = built.Edges.View();
  std::vector<std::int64_t> pairs;
  for (std::int64_t e = 0; e < built.Edges.NumberOfEdges; ++e)
  {
    const CornerPair corners = view.GetCorners(static_cast<EdgeId>(e));
    const TriangleRecord& triangle = view.Triangles[TriangleOf(corners.A)];
    const int slot = SlotOf(corners.A);
    const bool isListed = corners.B != NoCorner ||
      (withNonManifold && GetRole(triangle, slot) == CornerRole::OneOfMany);
    if (view.States[e] == EdgeState::Fixed && isListed && HasEdges(triangle))
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
  if (counts.Fixed <= counts.Boundary)
  {
    return {};
  }
  return ListFixedEdges(mesh, options, {}, true);
}

std::vector<std::int32_t> FindSeededRegions(
  const TriangleMesh& mesh, const FlipOptions& options, UnusedSeeds& unused)
{
  HostEdges built(mesh, options, {});
  const SpatialOrderView order = built.Order.View();
  std::vector<double> places;
  for (std::int64_t vertex = 0; vertex < mesh.Points.Count; ++vertex)
  {
    const std::int64_t point = order.GetVertex(static_cast<VertexId>(vertex));
    places.push_back(mesh.Points.Get(point, 0));
    places.push_back(mesh.Points.Get(point, 1));
  }
  PointMeshView view;
  view.Edges = built.Edges.View();
  view.Places = PlaneArray(places.data(), mesh.Points.Count, 2);
  view.NumberOfTriangles = built.Edges.NumberOfTriangles;
  std::vector<std::int32_t> orientations;
  std::int64_t sum = 0;
  for (std::int64_t t = 0; t < view.NumberOfTriangles; ++t)
  {
    const TriangleRecord& triangle = view.Edges.Triangles[t];
    const VertexId* v = triangle.Vertices;
    const bool isSound =
      HasEdges(triangle) && view.IsFinite(v[0]) && view.IsFinite(v[1]) && view.IsFinite(v[2]);
    orientations.push_back(isSound ? view.FindOrientation(v[0], v[1], v[2]) : 0);
    sum += orientations.back();
  }
  const int side = sum < 0 ? -1 : 1;
  std::vector<std::int32_t> regions = std::move(orientations);
  for (std::int32_t& region : regions)
  {
    region = region == side ? 0 : -1;
  }
  unused = SpreadSeeds(view, mesh.RegionSeeds, mesh.NumberOfRegionSeeds, side, regions);
  std::vector<std::int32_t> bySlot(regions.size());
  for (std::size_t t = 0; t < regions.size(); ++t)
  {
    bySlot[view.Edges.Triangles[t].InputTriangle] = std::max(regions[t], 0);
  }
  return bySlot;
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
