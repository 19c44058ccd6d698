// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_POINTMESH_H
#define DELAUNAYFLIP_POINTMESH_H

#include "Array.h"
#include "BuildProgress.h"
#include "DivideAndConquer.h"
#include "EdgeMesh.h"
#include "EdgeMeshBuilder.h"
#include "Hull.h"
#include "MeshSurveyBuilder.h"
#include "Mountains.h"
#include "Strips.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
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

/// The coordinates of the first `size` places, or of those that are listed.
template <typename Real, typename Backend>
std::vector<CoordinatePair<double>> FetchPlaces(const CoordinatePair<Real>* places,
  const std::uint32_t* listOnHost, std::int64_t size, const Backend& backend)
{
  Array<std::uint32_t> listed = backend.template MakeArray<std::uint32_t>(listOnHost ? size : 0);
  backend.Upload(listOnHost, listOnHost ? size : 0, listed.Data());
  Array<CoordinatePair<double>> gathered = backend.template MakeArray<CoordinatePair<double>>(size);
  const std::uint32_t* list = listOnHost ? listed.Data() : nullptr;
  CoordinatePair<double>* to = gathered.Data();
  backend.ForEach(size,
    [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i)
    {
      const CoordinatePair<Real> place = places[list ? list[i] : i];
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

  /// Calls work(i) for i = 0 .. count - 1, each of which may be long.
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

  /// Whether runs are long, by a sample of neighbours in a chain: how many have no place of another
  /// chain between them. Half of them where points are spread at random or along the strips, two of
  /// three on a lattice 10 times as wide as high, three of four and more on contours, spirals, scan
  /// lines and rows across the strips, from which flips make no fewer flips for a long time.
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
        sum += isSame && countBefore(place) == countBefore(place + 1) ? 1 : 0;
      });
    return 100 * alone > 71 * samples;
  }

  /// Whether flips from the strips would take longer than divide and conquer. This depends on the
  /// points alone, so that every backend chooses the same way.
  /// @param onBoundary how many points are on the boundary of the strips.
  /// @param filtersApply whether most of their geometry is decided without exact arithmetic, which
  /// takes so long that only the number of decisions counts.
  bool IsLongForFlips(std::int64_t onBoundary, bool filtersApply)
  {
    constexpr std::int64_t Fewest = 256; // below, both take microseconds
    constexpr std::int64_t Most = 1 << 15; // of points for which flips on a GPU save little
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

  /// Fills the pieces of the outer boundary, each alone.
  /// @param firstTriangle the number of the first triangle to make; then of the next.
  /// @returns what is left of them.
  std::vector<LabelledVertex> FillPieces(
    std::vector<BoundaryPiece> pieces, std::int64_t& firstTriangle)
  {
    const auto count = static_cast<std::int64_t>(pieces.size());
    const std::int64_t inner =
      count > 0 ? std::int64_t(pieces.back().Begin) + pieces.back().Size - 2 : 0;
    Array<BoundaryPiece> local = this->Device.template MakeArray<BoundaryPiece>(count);
    // Mountains are cut later, so there is room where their triangles will be, as a rule.
    const std::int64_t needed = inner + (inner + 3) / 4;
    Array<TriangleRecord> own =
      this->Device.template MakeArray<TriangleRecord>(needed > firstTriangle ? needed : 0);
    ChainView<Real> alone = this->View();
    alone.Triangles = needed > firstTriangle ? own.Data() : alone.Triangles;
    static_assert(sizeof(TriangleRecord) == 4 * sizeof(LabelledVertex), "in the last fourth");
    auto* const path = reinterpret_cast<LabelledVertex*>(alone.Triangles + inner);
    this->Device.Upload(pieces.data(), count, local.Data());
    BoundaryPiece* piece = local.Data();
    alone.Sides = nullptr;
    this->ForTasks(
      count, [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i) { CutPiece(alone, piece[i], path); });
    const auto countMade = [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i)
    { return static_cast<int>(piece[i].Made); };
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
        MovePiece(chains, piece[i], path, alone.Triangles + piece[i].Begin, base + firstOf[i],
          leftOf + (piece[i].Begin - firstOf[i] + i));
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
        CutMountains(chains, task * Grain, end < slots ? end : slots);
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
EdgeMesh DividePlaces(const CoordinatePair<Real>* places, std::int64_t count,
  const Backend& backend, const BuildProgress& progress, std::int64_t& hullEdges)
{
  const std::vector<CoordinatePair<double>> fetched =
    FetchPlaces(places, nullptr, Backend::IsOnHost ? 0 : count, backend);
  const auto run = [&](std::int64_t tasks, const std::function<void(std::int64_t)>& work)
  { backend.ForTasks(tasks, work); };
  const auto getPlace = [&](std::int64_t i) {
    return Backend::IsOnHost ? CoordinatePair<double>{ places[i].U, places[i].V } : fetched[i];
  };
  const auto tell = [&](double share)
  { progress.Reach(BuildStep::Loaded, BuildStep::Fixed, share); };
  DividedPoints divided = DivideAndConquer(count, { run, getPlace, tell, backend.GetHostMemory() });
  hullEdges = divided.HullEdges;
  EdgeMesh edges;
  edges.NumberOfTriangles = static_cast<std::int64_t>(divided.Triangles.Size());
  edges.Triangles = std::move(divided.Triangles);
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

/// Triangulates the places of points by strips; or by divide and conquer where flips from there
/// would be a long chain. Of many points these are those that are nearly all on the boundary of the
/// strips, as where they lie along one curve, and those of which few are and runs are long. Of few
/// points these are those with long runs or with one strip.
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
  const std::vector<BoundaryPart> parts = ListBoundary(builder.HostStarts, builder.HostGaps);
  const std::int64_t onBoundary = std::accumulate(parts.begin(), parts.end(), std::int64_t(0),
    [](std::int64_t sum, const BoundaryPart& part) { return sum + part.Last - part.First + 2; });
  if (builder.IsLongForFlips(onBoundary, filtersApply))
  {
    mesh.Edges =
      DividePlaces(mesh.Points.Places(), mesh.Points.Count, backend, progress, mesh.HullEdges);
    return mesh;
  }
  builder.MakeArrays(triangles + onBoundary);
  const Boundary boundary = JoinPieces(parts, builder.FillPieces(CutIntoPieces(parts), triangles));
  const std::vector<CoordinatePair<double>> places = FetchPlaces(mesh.Points.Places(),
    boundary.Places.data(), static_cast<std::int64_t>(boundary.Places.size()), backend);
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
