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
#include "RunProgress.h"
#include "Strips.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <utility>
#include <vector>

/// @file
/// From points to an edge mesh that flips can make Delaunay.

namespace delaunayflip
{

/// A triangulation of points. Vertices are the places of Points, in its order. All triangles are
/// counter-clockwise and have an area.
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

/// Numbers the edges of triangles as BuildEdgeMesh does. Their HalfEdges hold the other corner of
/// each edge, or a label that says where it is. Edges with one triangle are fixed.
/// @param sidesOfEdges ChainView::Sides; freed.
template <typename Backend>
void NumberJoinedEdges(EdgeMesh& edges, Array<CornerPair> sidesOfEdges, const Backend& backend)
{
  TriangleRecord* triangles = edges.Triangles.Data();
  const CornerPair* sides = sidesOfEdges.Data();
  EdgeMeshResult result;
  result.Edges = std::move(edges);
  const typename Backend::Numbering numbering = backend.Count(result.Edges.NumberOfTriangles,
    [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t t)
    {
      TriangleRecord triangle = triangles[t];
      triangle.InputTriangle = static_cast<TriangleId>(t);
      triangle.Flips = 0;
      for (int slot = 0; slot < 3; ++slot)
      {
        const CornerId other = triangle.HalfEdges[slot];
        if (other != NoCorner && IsOpen(other))
        {
          const CornerPair pair = sides[other >> 2];
          triangle.HalfEdges[slot] =
            pair.A == MakeCorner(static_cast<TriangleId>(t), slot) ? pair.B : pair.A;
        }
      }
      const int leaders = SetRoles(triangle, t);
      triangles[t] = triangle;
      return leaders;
    });
  sidesOfEdges = Array<CornerPair>(); // frees its memory
  NumberEdges(result, numbering, backend, !Backend::MemoryIsScarce);
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
      sum.Note(0, places[i].U);
      sum.Note(1, places[i].V);
      sum.Note(2, 0.0);
    });
  MeshSurvey survey;
  survey.Geometry = GeometryKind::PlanarXY;
  survey.UsedPoints = points.Count;
  if (points.Count > 0)
  {
    survey.Box = found;
    survey.SmallestMagnitude = found.Smallest;
  }
  ResolveRange(survey);
  return survey;
}

/// The coordinates of some places, which are listed.
template <typename Real, typename Backend>
std::vector<CoordinatePair<double>> FetchPlaces(const CoordinatePair<Real>* places,
  const std::vector<std::uint32_t>& list, const Backend& backend)
{
  const auto size = static_cast<std::int64_t>(list.size());
  Array<std::uint32_t> listed = backend.template MakeArray<std::uint32_t>(size);
  backend.Upload(list.data(), size, listed.Data());
  Array<CoordinatePair<double>> gathered = backend.template MakeArray<CoordinatePair<double>>(size);
  const std::uint32_t* numbers = listed.Data();
  CoordinatePair<double>* to = gathered.Data();
  backend.ForEach(size,
    [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i)
    {
      const CoordinatePair<Real> place = places[numbers[i]];
      to[i] = { place.U, place.V };
    });
  std::vector<CoordinatePair<double>> coordinates(size);
  backend.Download(to, size, coordinates.data());
  return coordinates;
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
  Array<CornerPair> Sides;
  Array<std::int32_t> Failed;

  ChainView<Real> View()
  {
    StripPoints<Real>& points = this->Mesh.Points;
    return { points.Places(), points.Starts.Data(), points.Strips,
      static_cast<std::uint32_t>(points.Count), this->Gaps.Data(),
      this->Mesh.Edges.Triangles.Data(), 0, this->Sides.Data(), this->Failed.Data() };
  }

  /// Calls work(i) for i = 0 .. count - 1. Each call may be long.
  template <typename Work>
  void ForTasks(std::int64_t count, const Work& work) const
  {
    if constexpr (Backend::IsOnHost)
    {
      this->Device.ForTasks(count, work);
    }
    else
    {
      this->Device.ForEach(count, work);
    }
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

  /// Whether runs are long. This takes a sample of neighbours in a chain, and counts the pairs with
  /// no place of another chain between them. These are half of the pairs if points are spread at
  /// random or along the strips, and two of three on a lattice 10 times as wide as high. They are
  /// three of four or more on contours, spirals, scan lines and rows across the strips, where the
  /// number of flips per iteration falls slowly.
  bool HasLongRuns()
  {
    constexpr std::int64_t Fewest = 1 << 6, Most = 1 << 12, PointsPerSample = 16;
    const ChainView<Real> chains = this->View();
    const std::int64_t samples =
      std::clamp<std::int64_t>(chains.Count / PointsPerSample, Fewest, Most);
    const std::int64_t alone = this->Device.template Sum<std::int64_t>(samples,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i, std::int64_t & sum)
      {
        const auto place = static_cast<std::uint32_t>(PickSample(i, chains.Count - 1));
        const std::int64_t end = FindEnd(std::int64_t(1), chains.Chains,
          [&](std::int64_t chain) { return chains.Starts[chain] <= place; });
        const std::int64_t other = end < chains.Chains ? end : end - 2;
        const auto countBefore = [&](std::uint32_t own)
        {
          return FindEnd(chains.Starts[other], chains.Starts[other + 1],
            [&](std::uint32_t next) { return chains.IsBefore(next, own); });
        };
        const bool isSame = place + 1 < chains.Starts[end];
        if (isSame && countBefore(place) == countBefore(place + 1))
        {
          ++sum;
        }
      });
    return 100 * alone > 71 * samples;
  }

  /// Whether flips from the strips would take longer than divide and conquer. This depends on the
  /// points alone, so that every backend chooses the same way.
  /// @param onBoundary how many points are on the boundary of the strips.
  /// @param filtersApply whether most of their geometry is decided without exact arithmetic. Exact
  /// arithmetic takes so long that only the number of decisions counts.
  bool IsLongForFlips(std::int64_t onBoundary, bool filtersApply)
  {
    constexpr std::int64_t Fewest = 256; // below, both take microseconds
    constexpr std::int64_t Most = 1 << 15; // below, flips on a GPU save little
    const std::int64_t points = this->Mesh.Points.Count;
    if (points < Fewest)
    {
      return false;
    }
    if (!filtersApply)
    {
      return true;
    }
    if (points < Most)
    {
      return this->Mesh.Points.Strips == 1 || this->HasLongRuns();
    }
    const std::int64_t tenth = points / 10;
    return onBoundary >= 9 * tenth || (onBoundary < 2 * tenth && this->HasLongRuns());
  }

  std::int64_t CountSlots() const
  {
    const auto& starts = this->HostStarts;
    return std::int64_t(starts[starts.size() - 2]) + starts.back() - starts[1];
  }

  void MakeArrays(std::int64_t mostTriangles)
  {
    this->Mesh.Edges.Triangles = this->Device.template MakeArray<TriangleRecord>(mostTriangles);
    const std::int64_t edges = this->Mesh.Points.Count + this->CountSlots() + 1;
    this->Sides = this->Device.template MakeArray<CornerPair>(edges);
    CornerPair* sides = this->Sides.Data();
    this->Device.ForEach(edges,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i) {
        sides[i] = { NoCorner, NoCorner };
      });
  }

  /// Fills the stretches of the outer boundary, each alone.
  /// @param firstTriangle the number of the first triangle to make; then of the next.
  /// @returns what is left of them.
  std::vector<LabelledVertex> FillStretches(
    std::vector<BoundaryStretch> stretches, std::int64_t& firstTriangle)
  {
    const auto count = static_cast<std::int64_t>(stretches.size());
    std::int64_t inner = 0;
    if (count > 0)
    {
      inner = std::int64_t(stretches.back().Begin) + stretches.back().Size - 2;
    }
    Array<BoundaryStretch> local = this->Device.template MakeArray<BoundaryStretch>(count);
    ChainView<Real> alone = this->View();
    alone.Sides = nullptr;
    // Mountains are cut later, so there is room where their triangles will be, as a rule.
    const std::int64_t needed = inner + (inner + 3) / 4;
    Array<TriangleRecord> own;
    if (needed > firstTriangle)
    {
      own = this->Device.template MakeArray<TriangleRecord>(needed);
      alone.Triangles = own.Data();
    }
    static_assert(sizeof(TriangleRecord) == 4 * sizeof(LabelledVertex), "in the last fourth");
    auto* const path = reinterpret_cast<LabelledVertex*>(alone.Triangles + inner);
    this->Device.Upload(stretches.data(), count, local.Data());
    BoundaryStretch* stretch = local.Data();
    this->ForTasks(
      count, [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i) { CutStretch(alone, stretch[i], path); });
    const auto countMade = [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i)
    { return static_cast<int>(stretch[i].Made); };
    const typename Backend::Numbering numbering = this->Device.Count(count, countMade);
    Array<std::uint32_t> numbers = this->Device.template MakeArray<std::uint32_t>(count);
    std::uint32_t* firstOf = numbers.Data();
    this->Device.ForEachNumbered(numbering, count, countMade,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i, std::int64_t first)
      { firstOf[i] = static_cast<std::uint32_t>(first); });
    const std::int64_t rest = inner - numbering.Total + count;
    Array<LabelledVertex> left = this->Device.template MakeArray<LabelledVertex>(rest);
    LabelledVertex* leftOf = left.Data();
    const ChainView<Real> chains = this->View();
    const auto base = static_cast<TriangleId>(firstTriangle);
    this->ForTasks(count,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i)
      {
        MoveStretch(chains, stretch[i], path, alone.Triangles + stretch[i].Begin, base + firstOf[i],
          leftOf + (stretch[i].Begin - firstOf[i] + i));
      });
    std::vector<LabelledVertex> onHost(rest);
    this->Device.Download(left.Data(), rest, onHost.data());
    firstTriangle += numbering.Total;
    return onHost;
  }

  void CutAllMountains()
  {
    const ChainView<Real> chains = this->View();
    const std::int64_t slots = this->CountSlots();
    constexpr std::int64_t Grain = Backend::IsOnHost ? 4096 : 8;
    this->ForTasks((slots + Grain - 1) / Grain,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t task)
      {
        const std::int64_t end = (task + 1) * Grain;
        CutMountains(chains, task * Grain, std::min(end, slots));
      });
  }

  void StoreHull(const HullTriangles& hull, std::int64_t firstTriangle)
  {
    const auto size = static_cast<std::int64_t>(hull.Triangles.size());
    this->Mesh.HullEdges = hull.HullEdges;
    this->Mesh.Edges.NumberOfTriangles = firstTriangle + size;
    this->Device.Upload(
      hull.Triangles.data(), size, this->Mesh.Edges.Triangles.Data() + firstTriangle);
    const ChainView<Real> chains = this->View();
    this->Device.ForEach(size,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i)
      { chains.AttachTriangle(static_cast<TriangleId>(firstTriangle + i)); });
  }
};

/// Triangulates at least three places by divide and conquer, on the host. No edge is bad then.
/// @param places as in StripPoints. @param hullEdges receives their number.
template <typename Real, typename Backend>
EdgeMesh TriangulateByDivideAndConquer(const CoordinatePair<Real>* places, std::int64_t count,
  const Backend& backend, const BuildProgress& progress, std::int64_t& hullEdges)
{
  std::vector<CoordinatePair<Real>> fetched;
  const CoordinatePair<Real>* onHost = places;
  if constexpr (!Backend::IsOnHost)
  {
    fetched.resize(count);
    backend.Download(places, count, fetched.data());
    onHost = fetched.data();
  }
  const auto run = [&](std::int64_t tasks, const std::function<void(std::int64_t)>& work)
  { backend.ForTasks(tasks, work); };
  const auto getPlaces = [=](std::int64_t first, std::int64_t end, NumberedPlace* to)
  {
    for (std::int64_t i = first; i < end; ++i, ++to)
    {
      *to = { onHost[i].U, onHost[i].V, static_cast<std::uint32_t>(i) };
    }
  };
  const auto tell = [&](double share)
  { progress.Reach(BuildStep::Loaded, BuildStep::Fixed, share); };
  PointTriangles made = DivideAndConquer(count, { run, getPlaces, tell, backend.GetHostMemory() });
  hullEdges = made.HullEdges;
  EdgeMesh edges;
  edges.NumberOfTriangles = static_cast<std::int64_t>(made.Triangles.Size());
  edges.Triangles = std::move(made.Triangles);
  if constexpr (!Backend::IsOnHost)
  {
    Array<TriangleRecord> onDevice =
      backend.template MakeArray<TriangleRecord>(edges.NumberOfTriangles);
    backend.Upload(edges.Triangles.Data(), edges.NumberOfTriangles, onDevice.Data());
    edges.Triangles = std::move(onDevice);
  }
  RequireComplete(edges, count, hullEdges);
  NumberJoinedEdges(edges, {}, backend);
  return edges;
}

/// Triangulates the places of points by strips, or by divide and conquer if flips from the strips
/// would be a long chain. Many points go to divide and conquer if nearly all of them are on the
/// boundary of the strips, as along one curve, or if few of them are there and runs are long. Few
/// points go to divide and conquer if runs are long or if there is one strip.
/// @param filtersApply as in IsLongForFlips.
template <typename Real, typename Backend>
PointMesh<Real> BuildPointMesh(StripPoints<Real> strips, bool filtersApply, const Backend& backend,
  const BuildProgress& progress)
{
  PointMesh<Real> mesh;
  mesh.Points = std::move(strips);
  PointMeshBuilder<Real, Backend> builder{ mesh, backend, {}, {}, {}, {}, {} };
  builder.Failed = backend.template MakeArray<std::int32_t>(1);
  std::int32_t failed = 0;
  backend.Upload(&failed, 1, builder.Failed.Data());
  std::int64_t triangles = builder.MeasureGaps();
  const std::vector<BoundarySection> sections = ListBoundary(builder.HostStarts, builder.HostGaps);
  std::int64_t onBoundary = 0;
  for (const BoundarySection& section : sections)
  {
    onBoundary += std::int64_t(section.Last) - section.First + 2;
  }
  if (builder.IsLongForFlips(onBoundary, filtersApply))
  {
    mesh.Edges = TriangulateByDivideAndConquer(
      mesh.Points.Places(), mesh.Points.Count, backend, progress, mesh.HullEdges);
    return mesh;
  }
  builder.MakeArrays(triangles + onBoundary);
  const Boundary boundary =
    JoinStretches(sections, builder.FillStretches(CutIntoStretches(sections), triangles));
  const std::vector<CoordinatePair<double>> places =
    FetchPlaces(mesh.Points.Places(), boundary.Places, backend);
  builder.CutAllMountains();
  // A device still cuts mountains meanwhile.
  builder.StoreHull(FillHull(boundary, places, static_cast<TriangleId>(triangles)), triangles);
  backend.Download(builder.Failed.Data(), 1, &failed);
  if (failed != 0)
  {
    throw BeyondDevice();
  }
  RequireComplete(mesh.Edges, mesh.Points.Count, mesh.HullEdges);
  NumberJoinedEdges(mesh.Edges, std::move(builder.Sides), backend);
  return mesh;
}

}

#endif
