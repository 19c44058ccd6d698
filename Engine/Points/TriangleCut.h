// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_TRIANGLECUT_H
#define DELAUNAYFLIP_TRIANGLECUT_H

#include "Array.h"
#include "Atomics.h"
#include "Outline.h"
#include "PlaneMesh.h"
#include "PortableMath.h"
#include "SmallestAngle.h"
#include "SurfaceAngles.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

/// @file
/// Cuts triangles off a triangulation of points: passes over its triangles and edges. The host
/// judges components, which are triangles that are connected across edges that are not fixed.

namespace delaunayflip
{

/// Unites the components of triangles. Each triangle names one before it in its component, or
/// itself if it is the first one. So the first one is found, whatever the order of the work.
struct ComponentUnion
{
  std::uint32_t* Before;

  /// Returns the first triangle that is known to be in the component of this one.
  DELAUNAYFLIP_HOST_DEVICE std::uint32_t FindFirst(std::uint32_t triangle) const
  {
    for (;;)
    {
      const std::uint32_t before = AtomicLoad(&this->Before[triangle]);
      const std::uint32_t next = AtomicLoad(&this->Before[before]);
      if (next == before)
      {
        return before;
      }
      AtomicStore(&this->Before[triangle], next); // makes later ways shorter
      triangle = next;
    }
  }

  DELAUNAYFLIP_HOST_DEVICE void Unite(std::uint32_t a, std::uint32_t b) const
  {
    a = this->FindFirst(a);
    b = this->FindFirst(b);
    while (a != b)
    {
      const std::uint32_t later = a > b ? a : b, earlier = a > b ? b : a;
      const std::uint32_t seen = AtomicCompareExchange(&this->Before[later], later, earlier);
      if (seen == later)
      {
        return;
      }
      a = this->FindFirst(seen); // another thread has united it
      b = this->FindFirst(earlier);
    }
  }
};

/// How many of the triangles of an edge are kept.
struct KeptSides
{
  const CornerId* CornerOfHalfEdge;
  const std::uint8_t* IsRemoved;

  DELAUNAYFLIP_HOST_DEVICE int operator()(std::int64_t edge) const
  {
    int count = 0;
    for (int side = 0; side < 2; ++side)
    {
      const CornerId corner = this->CornerOfHalfEdge[2 * edge + side];
      count += int(corner != NoCorner && this->IsRemoved[TriangleOf(corner)] == 0);
    }
    return count;
  }
};

/// What Sum adds up about edges: how many are left, and how many of these have one triangle.
struct EdgeSums
{
  std::int64_t Edges = 0, Boundary = 0;

  DELAUNAYFLIP_HOST_DEVICE EdgeSums& operator+=(const EdgeSums& other)
  {
    this->Edges += other.Edges;
    this->Boundary += other.Boundary;
    return *this;
  }
};

/// What Sum adds up about places: how many are left, and how many of these have points that were
/// given.
struct PlaceSums
{
  std::int64_t Used = 0, Given = 0;

  DELAUNAYFLIP_HOST_DEVICE PlaceSums& operator+=(const PlaceSums& other)
  {
    this->Used += other.Used;
    this->Given += other.Given;
    return *this;
  }
};

/// Whether a triangle is too large to be kept.
struct SizeTest
{
  PlaneMesh Mesh;
  double Alpha, LongestEdge; ///< See PointOptions.

  DELAUNAYFLIP_HOST_DEVICE bool IsTooLarge(const TriangleRecord& triangle) const
  {
    const PlanePoint a = this->Mesh.GetPoint(triangle.Vertices[0]);
    const PlanePoint b = this->Mesh.GetPoint(triangle.Vertices[1]);
    const PlanePoint c = this->Mesh.GetPoint(triangle.Vertices[2]);
    const double ab = PlaneLength(b.U - a.U, b.V - a.V);
    const double bc = PlaneLength(c.U - b.U, c.V - b.V);
    const double ca = PlaneLength(a.U - c.U, a.V - c.V);
    const double longest = std::max(std::max(ab, bc), ca);
    if (this->LongestEdge > 0.0 && longest > this->LongestEdge)
    {
      return true;
    }
    // The circumradius is half of a side over the sine of the opposite angle.
    const double sine =
      ((b.U - a.U) / ab) * ((c.V - a.V) / ca) - ((b.V - a.V) / ab) * ((c.U - a.U) / ca);
    return this->Alpha > 0.0 && !(0.5 * bc <= this->Alpha * sine);
  }
};

/// The triangles that are kept, in the memory of a backend. Empty arrays: all are.
struct KeptArrays
{
  Array<std::int32_t> Numbers; ///< By triangle, its number among those that are kept, or -1.
  Array<TriangleId> Triangles; ///< By this number, the triangle.
};

/// Cuts triangles off a triangulation of points, in which triangle i is in slot i.
template <typename Backend>
class TriangleCut
{
public:
  /// @param mesh is in the backend's memory, with the states of its edges.
  TriangleCut(const PointMeshView& mesh, const Backend& backend)
    : Mesh(mesh),
      Device(backend),
      IsRemoved(backend.template MakeArray<std::uint8_t>(mesh.NumberOfTriangles))
  {
    backend.Fill(this->IsRemoved.Data(), 0, mesh.NumberOfTriangles);
  }

  /// Does what LoadedMesh::CutOff does. @param viewOnHost calls a function with a copy of the mesh.
  template <typename ViewOnHost>
  KeptTriangles CutOff(const PointInput& input, const PointOptions& options,
    std::vector<SegmentEdge>& segments, const ViewOnHost& viewOnHost)
  {
    KeptTriangles kept;
    if (input.Rings || input.NumberOfHoleSeeds > 0)
    {
      const ComponentMap map = this->FindComponents();
      ComponentJudge judge(map, segments, input);
      judge.RemoveOutside(options.RingRule, kept);
      const bool hasHolesAlone = judge.HasHolesAlone();
      std::vector<TriangleId> seeds;
      if (hasHolesAlone || input.NumberOfHoleSeeds > 0)
      {
        viewOnHost(
          [&](const PointMeshView& view)
          {
            if (hasHolesAlone)
            {
              kept.HolePointsOutside = CountHolePointsOutside(view, input, segments);
            }
            seeds = FindHoleSeeds(view, input);
          });
      }
      kept.SeedsOutside = judge.RemoveHoles(this->FetchComponents(seeds));
      this->RemoveComponents(judge.GetRemoved());
      kept.Outside = this->CountRemoved();
    }
    if (options.Alpha > 0.0 || options.LongestEdge > 0.0)
    {
      this->RemoveLarge(segments, options.Alpha, options.LongestEdge);
      kept.Large = this->CountRemoved() - kept.Outside;
    }
    this->Measure(input.FirstAdded, segments, kept);
    return kept;
  }

  /// Does what LoadedMesh::NumberKept does.
  void NumberKept(const std::vector<std::int32_t>& regions, std::int64_t firstAdded,
    std::vector<SegmentEdge>& segments, KeptTriangles& kept)
  {
    std::vector<std::uint8_t> isRemoved(regions.size());
    for (std::size_t t = 0; t < regions.size(); ++t)
    {
      isRemoved[t] = regions[t] < 0 ? 1 : 0;
    }
    this->Device.Upload(isRemoved.data(), SizeOf(isRemoved), this->IsRemoved.Data());
    this->Measure(firstAdded, segments, kept);
  }

  /// The triangles that are kept; to be called once, at the end.
  KeptArrays TakeKept() { return std::move(this->Kept); }

  // The functions below are public because device lambdas require it.

  ComponentMap FindComponents()
  {
    const std::int64_t triangles = this->Mesh.NumberOfTriangles;
    this->ComponentOf = this->Device.template MakeArray<std::uint32_t>(triangles);
    Array<std::uint32_t> before = this->Device.template MakeArray<std::uint32_t>(triangles);
    const ComponentUnion unite{ before.Data() };
    this->Device.ForEach(triangles,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t t)
      { unite.Before[t] = static_cast<std::uint32_t>(t); });
    const EdgeMeshView edges = this->Mesh.Edges;
    this->Device.ForEach(this->Mesh.NumberOfEdges,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t e)
      {
        if (edges.States[e] != EdgeState::Fixed)
        {
          unite.Unite(TriangleOf(edges.CornerOfHalfEdge[2 * e]),
            TriangleOf(edges.CornerOfHalfEdge[2 * e + 1]));
        }
      });
    const auto isFirst = [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t t)
    { return unite.Before[t] == t ? 1 : 0; };
    const typename Backend::Numbering numbering = this->Device.Count(triangles, isFirst);
    std::uint32_t* componentOf = this->ComponentOf.Data();
    this->Device.ForEachNumbered(numbering, triangles, isFirst,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t t, std::int64_t number)
      { componentOf[t] = static_cast<std::uint32_t>(number); });
    this->Device.ForEach(triangles,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t t)
      {
        const std::uint32_t first = unite.FindFirst(static_cast<std::uint32_t>(t));
        if (first != t)
        {
          componentOf[t] = componentOf[first];
        }
      });
    return { numbering.Total, this->ListWalls() };
  }

  /// Lists the edges that are fixed, with the components at their sides.
  std::vector<ComponentWall> ListWalls()
  {
    const EdgeMeshView edges = this->Mesh.Edges;
    const std::uint32_t* componentOf = this->ComponentOf.Data();
    const auto isWall = [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t e)
    { return edges.States[e] == EdgeState::Fixed ? 1 : 0; };
    const typename Backend::Numbering numbering =
      this->Device.Count(this->Mesh.NumberOfEdges, isWall);
    Array<ComponentWall> walls = this->Device.template MakeArray<ComponentWall>(numbering.Total);
    ComponentWall* to = walls.Data();
    this->Device.ForEachNumbered(numbering, this->Mesh.NumberOfEdges, isWall,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t e, std::int64_t number)
      {
        if (isWall(e) == 0)
        {
          return;
        }
        ComponentWall& wall = to[number];
        wall.Edge = static_cast<EdgeId>(e);
        for (int side = 0; side < 2; ++side)
        {
          const CornerId corner = edges.CornerOfHalfEdge[2 * e + side];
          wall.Components[side] = ComponentWall::NoComponent;
          if (corner != NoCorner)
          {
            wall.Components[side] = componentOf[TriangleOf(corner)];
          }
        }
      });
    std::vector<ComponentWall> listed(numbering.Total);
    this->Device.Download(walls.Data(), numbering.Total, listed.data());
    return listed;
  }

  /// Fetches the components of triangles; that of NoTriangle is NoComponent.
  std::vector<std::uint32_t> FetchComponents(const std::vector<TriangleId>& triangles)
  {
    const std::int64_t count = SizeOf(triangles);
    std::vector<std::uint32_t> components(count);
    Array<TriangleId> named = this->Device.template MakeArray<TriangleId>(count);
    Array<std::uint32_t> found = this->Device.template MakeArray<std::uint32_t>(count);
    this->Device.Upload(triangles.data(), count, named.Data());
    const TriangleId* from = named.Data();
    std::uint32_t* to = found.Data();
    const std::uint32_t* componentOf = this->ComponentOf.Data();
    this->Device.ForEach(count,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i)
      {
        to[i] = ComponentWall::NoComponent;
        if (from[i] != NoTriangle)
        {
          to[i] = componentOf[from[i]];
        }
      });
    this->Device.Download(found.Data(), count, components.data());
    return components;
  }

  /// @param isRemoved by component; empty: none is.
  void RemoveComponents(const std::vector<std::uint8_t>& isRemoved)
  {
    if (isRemoved.empty())
    {
      return;
    }
    Array<std::uint8_t> fates = this->Device.template MakeArray<std::uint8_t>(SizeOf(isRemoved));
    this->Device.Upload(isRemoved.data(), SizeOf(isRemoved), fates.Data());
    const std::uint8_t* fateOf = fates.Data();
    const std::uint32_t* componentOf = this->ComponentOf.Data();
    std::uint8_t* to = this->IsRemoved.Data();
    this->Device.ForEach(this->Mesh.NumberOfTriangles,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t t) { to[t] = fateOf[componentOf[t]]; });
  }

  std::int64_t CountRemoved()
  {
    const std::uint8_t* isRemoved = this->IsRemoved.Data();
    return this->Device.template Sum<std::int64_t>(this->Mesh.NumberOfTriangles,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t t, std::int64_t & sum) { sum += isRemoved[t]; });
  }

  Array<HalfEdgeId> UploadSides(const std::vector<SegmentEdge>& segments)
  {
    std::vector<HalfEdgeId> sides;
    sides.reserve(segments.size());
    for (const SegmentEdge& segment : segments)
    {
      sides.push_back(segment.Side);
    }
    Array<HalfEdgeId> here = this->Device.template MakeArray<HalfEdgeId>(SizeOf(sides));
    this->Device.Upload(sides.data(), SizeOf(sides), here.Data());
    return here;
  }

  /// Removes large triangles without segments.
  void RemoveLarge(const std::vector<SegmentEdge>& segments, double alpha, double longestEdge)
  {
    const Array<HalfEdgeId> sides = this->UploadSides(segments);
    Array<std::uint8_t> marks =
      this->Device.template MakeArray<std::uint8_t>(this->Mesh.NumberOfEdges);
    this->Device.Fill(marks.Data(), 0, this->Mesh.NumberOfEdges);
    const HalfEdgeId* sideOf = sides.Data();
    std::uint8_t* isSegment = marks.Data();
    this->Device.ForEach(SizeOf(segments),
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i)
      { AtomicStore(&isSegment[EdgeOf(sideOf[i])], std::uint8_t(1)); });
    const SizeTest test{ this->Mesh, alpha, longestEdge };
    std::uint8_t* isRemoved = this->IsRemoved.Data();
    this->Device.ForEach(this->Mesh.NumberOfTriangles,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t t)
      {
        const TriangleRecord& triangle = test.Mesh.Edges.Triangles[t];
        bool stays = false;
        for (const HalfEdgeId side : triangle.HalfEdges)
        {
          stays = stays || isSegment[EdgeOf(side)] != 0;
        }
        if (!stays && test.IsTooLarge(triangle))
        {
          isRemoved[t] = 1;
        }
      });
  }

  /// Drops the segments that are no edges of what is left, and counts and numbers what is left if
  /// triangles are removed.
  void Measure(std::int64_t firstAdded, std::vector<SegmentEdge>& segments, KeptTriangles& kept)
  {
    this->KeepSegments(segments);
    if (kept.Outside + kept.Large > 0)
    {
      this->Number(kept);
      this->MeasureTriangles(kept);
      this->CountPlaces(firstAdded, kept);
      kept.EulerCharacteristic = kept.Used - kept.Edges + kept.Count;
    }
  }

  void KeepSegments(std::vector<SegmentEdge>& segments)
  {
    const std::int64_t count = SizeOf(segments);
    const Array<HalfEdgeId> sides = this->UploadSides(segments);
    Array<std::uint8_t> found = this->Device.template MakeArray<std::uint8_t>(count);
    const HalfEdgeId* sideOf = sides.Data();
    std::uint8_t* to = found.Data();
    const KeptSides sidesLeft{ this->Mesh.Edges.CornerOfHalfEdge, this->IsRemoved.Data() };
    this->Device.ForEach(count,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i)
      { to[i] = static_cast<std::uint8_t>(sidesLeft(EdgeOf(sideOf[i]))); });
    std::vector<std::uint8_t> left(count);
    this->Device.Download(found.Data(), count, left.data());
    std::size_t next = 0;
    for (std::size_t i = 0; i < segments.size(); ++i)
    {
      segments[next] = segments[i];
      segments[next].IsOnBoundary = left[i] == 1;
      next += left[i] > 0 ? 1 : 0;
    }
    segments.resize(next);
  }

  void Number(KeptTriangles& kept)
  {
    const std::int64_t triangles = this->Mesh.NumberOfTriangles;
    const std::uint8_t* isRemoved = this->IsRemoved.Data();
    const auto isKept = [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t t)
    { return isRemoved[t] == 0 ? 1 : 0; };
    const typename Backend::Numbering numbering = this->Device.Count(triangles, isKept);
    kept.Count = numbering.Total;
    this->Kept.Numbers = this->Device.template MakeArray<std::int32_t>(triangles);
    this->Kept.Triangles = this->Device.template MakeArray<TriangleId>(numbering.Total);
    std::int32_t* numbers = this->Kept.Numbers.Data();
    TriangleId* listed = this->Kept.Triangles.Data();
    this->Device.ForEachNumbered(numbering, triangles, isKept,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t t, std::int64_t number)
      {
        numbers[t] = -1;
        if (isRemoved[t] == 0)
        {
          numbers[t] = static_cast<std::int32_t>(number);
          listed[number] = static_cast<TriangleId>(t);
        }
      });
    kept.Numbers.resize(triangles);
    this->Device.Download(numbers, triangles, kept.Numbers.data());
  }

  void MeasureTriangles(KeptTriangles& kept)
  {
    const PointMeshView mesh = this->Mesh;
    const std::uint8_t* isRemoved = this->IsRemoved.Data();
    kept.Angles = this->Device.template Sum<AngleSums>(mesh.NumberOfTriangles,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t t, AngleSums & sum)
      {
        if (isRemoved[t] == 0)
        {
          Vector3 corners[3];
          for (int slot = 0; slot < 3; ++slot)
          {
            const PlanePoint place = mesh.GetPoint(mesh.Edges.Triangles[t].Vertices[slot]);
            corners[slot] = { place.U, place.V, 0.0 };
          }
          sum.Add(MeasureSquaredCotangent(corners[0], corners[1], corners[2], mesh.Range));
        }
      });
    const KeptSides sidesLeft{ mesh.Edges.CornerOfHalfEdge, isRemoved };
    const EdgeSums sums = this->Device.template Sum<EdgeSums>(mesh.NumberOfEdges,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t e, EdgeSums & sum)
      {
        const int sides = sidesLeft(e);
        sum += { int(sides > 0), int(sides == 1) };
      });
    kept.Edges = sums.Edges;
    kept.Boundary = sums.Boundary;
  }

  void CountPlaces(std::int64_t firstAdded, KeptTriangles& kept)
  {
    const std::int64_t places = this->Mesh.NumberOfPlaces;
    Array<std::uint8_t> marks = this->Device.template MakeArray<std::uint8_t>(places);
    this->Device.Fill(marks.Data(), 0, places);
    std::uint8_t* isUsed = marks.Data();
    const std::uint8_t* isRemoved = this->IsRemoved.Data();
    const TriangleRecord* triangles = this->Mesh.Edges.Triangles;
    this->Device.ForEach(this->Mesh.NumberOfTriangles,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t t)
      {
        for (int slot = 0; slot < 3 && isRemoved[t] == 0; ++slot)
        {
          AtomicStore(&isUsed[triangles[t].Vertices[slot]], std::uint8_t(1));
        }
      });
    const VertexId* ids = this->Mesh.Ids;
    const PlaceSums sums = this->Device.template Sum<PlaceSums>(places,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t place, PlaceSums & sum)
      {
        const bool isGiven = static_cast<std::int64_t>(ids[place]) < firstAdded;
        sum += { isUsed[place], isGiven ? isUsed[place] : 0 };
      });
    kept.Used = sums.Used;
    kept.UsedGiven = sums.Given;
  }

private:
  const PointMeshView Mesh;
  const Backend& Device;
  Array<std::uint8_t> IsRemoved; ///< By triangle.
  Array<std::uint32_t> ComponentOf; ///< By triangle.
  KeptArrays Kept;
};

}

#endif
