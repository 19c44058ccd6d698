// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_POINTMESH_H
#define DELAUNAYFLIP_POINTMESH_H

#include "Array.h"
#include "DivideAndConquer.h"
#include "EdgeMesh.h"
#include "EdgeMeshBuilder.h"
#include "Hull.h"
#include "MeshSurveyBuilder.h"
#include "Mountains.h"
#include "Strips.h"

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <utility>
#include <vector>

/// @file
/// From points to an edge mesh that flips can make Delaunay.

namespace delaunayflip
{

/// A triangulation of points. Vertices are the places of Points, in its order; all triangles turn
/// to the left and have an area.
template <typename Real>
struct PointMesh
{
  StripPoints<Real> Points; ///< One per place.
  EdgeMesh Edges;
  std::int64_t HullEdges = 0; ///< Edges with one triangle.
};

/// A triangulation of n places with h of them on the hull's boundary has 2 n - 2 - h triangles.
inline void RequireComplete(const EdgeMesh& edges, std::int64_t places, std::int64_t hullEdges)
{
  if (edges.NumberOfTriangles != 2 * places - 2 - hullEdges)
  {
    throw std::logic_error("a triangulation of points is incomplete; please report the points");
  }
}

/// Numbers the edges, as BuildEdgeMesh does, of triangles whose HalfEdges hold the other corner of
/// each edge. Edges with one triangle are fixed.
template <typename Backend>
void NumberJoinedEdges(EdgeMesh& edges, const Backend& backend)
{
  TriangleRecord* triangles = edges.Triangles.Data();
  EdgeMeshResult result;
  result.Edges = std::move(edges);
  const typename Backend::Numbering numbering = backend.Count(result.Edges.NumberOfTriangles,
    [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t t)
    {
      TriangleRecord& triangle = triangles[t];
      triangle.InputTriangle = static_cast<TriangleId>(t);
      triangle.Flips = 0;
      for (int slot = 0; slot < 3; ++slot)
      {
        const CornerId other = GetAt(triangle.HalfEdges, slot);
        const CornerRole role = other == NoCorner                ? CornerRole::Alone
          : MakeCorner(static_cast<TriangleId>(t), slot) < other ? CornerRole::Leader
                                                                 : CornerRole::Follower;
        triangle.Flips |= static_cast<std::uint32_t>(role) << (2 * slot);
      }
      return CountLeaders(triangle);
    });
  NumberEdges(result, numbering, backend);
  edges = std::move(result.Edges);
}

/// What a rule needs to know about these places.
template <typename Real, typename Backend>
MeshSurvey SurveyPlaces(StripPoints<Real>& points, const Backend& backend)
{
  const CoordinatePair<Real>* places = points.Places();
  const PointSurvey found = backend.template Sum<PointSurvey>(points.Count,
    [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i, PointSurvey & sum)
    {
      const double xy[2] = { places[i].U, places[i].V };
      for (int axis = 0; axis < 2; ++axis)
      {
        sum.Include(axis, xy[axis], xy[axis]);
        sum.IncludeMagnitude(std::fabs(xy[axis]));
      }
    });
  MeshSurvey survey;
  survey.Geometry = GeometryKind::PlanarXY;
  survey.UsedPoints = points.Count;
  if (points.Count > 0)
  {
    std::copy_n(found.Lower, 2, survey.Box.Lower);
    std::copy_n(found.Upper, 2, survey.Box.Upper);
    survey.SmallestMagnitude = found.Smallest;
  }
  ResolveRange(survey);
  return survey;
}

/// The steps of BuildPointMesh, and the arrays that they share.
template <typename Real, typename Backend>
struct PointMeshBuilder
{
  PointMesh<Real>& Mesh;
  const Backend& Device;
  Array<Gap> Gaps;
  std::vector<Gap> HostGaps;
  std::vector<std::uint32_t> HostStarts;
  Array<CornerId> SidesOfEdge, SidesOfDiagonal;
  Array<std::int32_t> Failed;

  ChainView<Real> View()
  {
    StripPoints<Real>& points = this->Mesh.Points;
    return { points.Places(), points.Starts.Data(), points.Strips, this->Gaps.Data(),
      this->Mesh.Edges.Triangles.Data(), this->SidesOfEdge.Data(), this->SidesOfDiagonal.Data(),
      this->Failed.Data() };
  }

  /// @returns the number of triangles in all mountains.
  std::int64_t MeasureGaps()
  {
    const std::int64_t strips = this->Mesh.Points.Strips;
    this->HostStarts.resize(strips + 1);
    this->Device.Download(this->Mesh.Points.Starts.Data(), strips + 1, this->HostStarts.data());
    this->Gaps = this->Device.template MakeArray<Gap>(strips - 1);
    Gap* gaps = this->Gaps.Data();
    const ChainView<Real> chains = this->View();
    this->Device.ForEach(strips - 1,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t gap) { gaps[gap] = MeasureGap(chains, gap); });
    this->HostGaps.resize(strips - 1);
    this->Device.Download(gaps, strips - 1, this->HostGaps.data());
    std::int64_t triangles = 0;
    for (std::int64_t gap = 0; gap + 1 < strips; ++gap)
    {
      this->HostGaps[gap].FirstTriangle = triangles;
      triangles += std::int64_t(this->HostStarts[gap + 2]) - this->HostStarts[gap] -
        this->HostGaps[gap].LeftRun - this->HostGaps[gap].RightRun;
    }
    this->Device.Upload(this->HostGaps.data(), strips - 1, gaps);
    return triangles;
  }

  /// The coordinates of the boundary's places.
  std::vector<CoordinatePair<double>> FetchPlaces(const Boundary& boundary)
  {
    const auto size = static_cast<std::int64_t>(boundary.Places.size());
    Array<std::uint32_t> listed = this->Device.template MakeArray<std::uint32_t>(size);
    this->Device.Upload(boundary.Places.data(), size, listed.Data());
    Array<CoordinatePair<double>> gathered =
      this->Device.template MakeArray<CoordinatePair<double>>(size);
    const std::uint32_t* list = listed.Data();
    CoordinatePair<double>* to = gathered.Data();
    const CoordinatePair<Real>* places = this->Mesh.Points.Places();
    this->Device.ForEach(size,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i) {
        to[i] = { places[list[i]].U, places[list[i]].V };
      });
    std::vector<CoordinatePair<double>> coordinates(size);
    this->Device.Download(to, size, coordinates.data());
    return coordinates;
  }

  void MakeArrays(std::int64_t mostTriangles)
  {
    this->Mesh.Edges.Triangles = this->Device.template MakeArray<TriangleRecord>(mostTriangles);
    const std::int64_t places = this->Mesh.Points.Count;
    const std::int64_t slots = this->View().Chains > 1 ? this->CountSlots() : 0;
    this->SidesOfEdge = this->Device.template MakeArray<CornerId>(2 * places);
    this->SidesOfDiagonal = this->Device.template MakeArray<CornerId>(2 * slots + 2);
    CornerId* ofEdge = this->SidesOfEdge.Data();
    CornerId* ofDiagonal = this->SidesOfDiagonal.Data();
    this->Device.ForEach(
      2 * places, [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i) { ofEdge[i] = NoCorner; });
    this->Device.ForEach(
      2 * slots + 2, [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i) { ofDiagonal[i] = NoCorner; });
  }

  std::int64_t CountSlots() const
  {
    const auto& starts = this->HostStarts;
    return std::int64_t(starts[starts.size() - 2]) + starts.back() - starts[1];
  }

  void StoreHull(const HullTriangles& hull, std::int64_t firstTriangle)
  {
    this->Mesh.HullEdges = hull.HullEdges;
    this->Mesh.Edges.NumberOfTriangles =
      firstTriangle + static_cast<std::int64_t>(hull.Triangles.size());
    this->Device.Upload(hull.Triangles.data(), static_cast<std::int64_t>(hull.Triangles.size()),
      this->Mesh.Edges.Triangles.Data() + firstTriangle);
    const auto size = static_cast<std::int64_t>(hull.Sides.size());
    Array<SideWord> words = this->Device.template MakeArray<SideWord>(size);
    Array<CornerId> corners = this->Device.template MakeArray<CornerId>(size);
    this->Device.Upload(hull.Sides.data(), size, words.Data());
    this->Device.Upload(hull.Corners.data(), size, corners.Data());
    const ChainView<Real> chains = this->View();
    const SideWord* word = words.Data();
    const CornerId* corner = corners.Data();
    this->Device.ForEach(size,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i)
      {
        CornerId& side =
          word[i] < 0 ? chains.SidesOfDiagonal[~word[i]] : chains.SidesOfEdge[word[i]];
        side = corner[i];
      });
  }

  void CutAllMountains()
  {
    const ChainView<Real> chains = this->View();
    const std::int64_t slots = this->CountSlots();
    constexpr std::int64_t Grain = Backend::IsOnHost ? 4096 : 8;
    const auto cut = [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t task)
    {
      const std::int64_t end = (task + 1) * Grain;
      CutMountains(chains, task * Grain, end < slots ? end : slots);
    };
    if constexpr (Backend::IsOnHost)
    {
      this->Device.ForTasks((slots + Grain - 1) / Grain, cut);
    }
    else
    {
      this->Device.ForEach((slots + Grain - 1) / Grain, cut);
    }
  }

  /// Joins the triangles on both sides of all edges of chains and of all diagonals.
  void JoinSides()
  {
    const ChainView<Real> chains = this->View();
    this->Device.ForEach(this->Mesh.Points.Count,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i)
      { chains.Join(chains.SidesOfEdge[2 * i], chains.SidesOfEdge[2 * i + 1]); });
    const std::int64_t slots = this->View().Chains > 1 ? this->CountSlots() : 0;
    this->Device.ForEach(slots + 1,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i)
      { chains.Join(chains.SidesOfDiagonal[2 * i], chains.SidesOfDiagonal[2 * i + 1]); });
    this->SidesOfEdge = Array<CornerId>();
    this->SidesOfDiagonal = Array<CornerId>();
  }
};

/// Triangulates at least three places by divide and conquer, on the host. No edge is bad then.
/// @param hullEdges receives their number.
template <typename Real, typename Backend>
EdgeMesh DividePlaces(const CoordinatePair<Real>* places, std::int64_t count,
  const Backend& backend, std::int64_t& hullEdges)
{
  std::vector<CoordinatePair<Real>> onHost(count);
  backend.Download(places, count, onHost.data());
  std::vector<CoordinatePair<double>> exact;
  exact.reserve(count);
  for (const CoordinatePair<Real>& place : onHost)
  {
    exact.push_back({ place.U, place.V });
  }
  const DividedPoints divided = DivideAndConquer(exact,
    [&](std::int64_t tasks, const std::function<void(std::int64_t)>& work)
    { backend.ForTasks(tasks, work); });
  hullEdges = divided.HullEdges;
  EdgeMesh edges;
  edges.NumberOfTriangles = static_cast<std::int64_t>(divided.Triangles.size());
  edges.Triangles = backend.template MakeArray<TriangleRecord>(edges.NumberOfTriangles);
  backend.Upload(divided.Triangles.data(), edges.NumberOfTriangles, edges.Triangles.Data());
  RequireComplete(edges, count, hullEdges);
  NumberJoinedEdges(edges, backend);
  return edges;
}

/// Triangulates the places of points by strips; or by divide and conquer if nearly all points are
/// on the boundary of the strips, as where they lie along one curve. From there flips would be a
/// long chain.
/// @param strips as above.
template <typename Real, typename Backend>
PointMesh<Real> BuildPointMesh(StripPoints<Real> strips, const Backend& backend)
{
  PointMesh<Real> mesh;
  mesh.Points = std::move(strips);
  PointMeshBuilder<Real, Backend> builder{ mesh, backend, {}, {}, {}, {}, {}, {} };
  builder.Failed = backend.template MakeArray<std::int32_t>(1);
  std::int32_t failed = 0;
  backend.Upload(&failed, 1, builder.Failed.Data());
  const std::int64_t inMountains = builder.MeasureGaps();
  const Boundary boundary = ListBoundary(builder.HostStarts, builder.HostGaps);
  constexpr std::int64_t SmallestCurve = 10000; // below, flips take milliseconds
  const auto boundaryPoints = static_cast<std::int64_t>(boundary.Places.size());
  if (mesh.Points.Count >= SmallestCurve && boundaryPoints >= mesh.Points.Count / 10 * 9)
  {
    mesh.Edges = DividePlaces(mesh.Points.Places(), mesh.Points.Count, backend, mesh.HullEdges);
    return mesh;
  }
  const std::vector<CoordinatePair<double>> places = builder.FetchPlaces(boundary);
  builder.MakeArrays(inMountains + boundaryPoints);
  if (mesh.Points.Strips > 1)
  {
    builder.CutAllMountains();
  }
  // A device still cuts mountains meanwhile.
  builder.StoreHull(FillHull(boundary, places, inMountains), inMountains);
  backend.Download(builder.Failed.Data(), 1, &failed);
  if (failed != 0)
  {
    throw BeyondDevice();
  }
  builder.JoinSides();
  RequireComplete(mesh.Edges, mesh.Points.Count, mesh.HullEdges);
  NumberJoinedEdges(mesh.Edges, backend);
  return mesh;
}

}

#endif
