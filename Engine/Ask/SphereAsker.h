// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_SPHEREASKER_H
#define DELAUNAYFLIP_SPHEREASKER_H

#include "PlaceQuery.h"
#include "PointTriangulation.h"
#include "RunQuery.h"
#include "SphereFrame.h"
#include "SphereGrid.h"
#include "SphereSegments.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace delaunayflip
{

/// The boundary of the triangles on a sphere that a run has kept, for places outside. Consecutive
/// edges are mostly near each other, as they are in the plane.
class SphereBoundary
{
public:
  /// @param directions of the points.
  SphereBoundary(const SphereGrid& grid, const Vector3* directions)
    : Directions(directions)
  {
    const SphereMesh& mesh = grid.GetMesh();
    for (std::int64_t t = 0; t < mesh.NumberOfTriangles; ++t)
    {
      const auto triangle = static_cast<TriangleId>(t);
      if (grid.GetNumber(triangle) < 0 || !mesh.FacesOutside(triangle))
      {
        continue;
      }
      for (int slot = 0; slot < 3; ++slot)
      {
        const CornerId corner = MakeCorner(triangle, slot);
        if (grid.IsOnBoundary(corner))
        {
          this->Edges.push_back({ mesh.GetVertex(SphereMesh::Next(corner)),
            mesh.GetVertex(SphereMesh::Previous(corner)) });
        }
      }
    }
    for (std::size_t first = 0; first < this->Edges.size(); first += GroupSize)
    {
      this->Groups.push_back(this->FindGroup(first));
    }
  }

  bool IsEmpty() const { return this->Edges.empty(); }

  NearestOnBoundary FindNearest(const Vector3& place) const
  {
    NearestOnBoundary nearest{ this->Edges.front(), 0.0 };
    double least = INFINITY;
    for (std::size_t group = 0; group < this->Groups.size(); ++group)
    {
      const Cap& cap = this->Groups[group];
      const double distance = Length(cap.Center - place) - cap.Radius;
      if (distance > 0.0 && distance * distance >= least)
      {
        continue;
      }
      const std::size_t end = std::min(this->Edges.size(), (group + 1) * GroupSize);
      for (std::size_t i = group * GroupSize; i < end; ++i)
      {
        this->Offer(place, this->Edges[i], least, nearest);
      }
    }
    return nearest;
  }

private:
  static constexpr std::size_t GroupSize = 32;

  /// A cap of the sphere. It has all places on the edges of a group.
  struct Cap
  {
    Vector3 Center;
    double Radius; ///< A distance in space.
  };

  Cap FindGroup(std::size_t first) const
  {
    const std::size_t end = std::min(this->Edges.size(), first + GroupSize);
    Vector3 sum{ 0.0, 0.0, 0.0 };
    for (std::size_t i = first; i < end; ++i)
    {
      sum = sum + this->Directions[this->Edges[i].From] + this->Directions[this->Edges[i].To];
    }
    constexpr double Rounding = 1e-9, Diameter = 2.0;
    Cap cap{ FindDirection(sum), 0.0 };
    for (std::size_t i = first; i < end; ++i)
    {
      for (const VertexId vertex : { this->Edges[i].From, this->Edges[i].To })
      {
        const Vector3& direction = this->Directions[vertex];
        // In a half of the sphere, no place on an edge is farther away than both of its ends.
        const bool isNear = Dot(direction, cap.Center) > 0.0;
        const double distance = isNear ? Length(direction - cap.Center) : Diameter;
        cap.Radius = std::max(cap.Radius, distance + Rounding);
      }
    }
    return cap;
  }

  /// Takes an edge if it is nearer than the nearest one so far.
  void Offer(
    const Vector3& place, const BoundaryEdge& edge, double& least, NearestOnBoundary& nearest) const
  {
    const Vector3& from = this->Directions[edge.From];
    const Vector3& to = this->Directions[edge.To];
    const auto offer = [&](const Vector3& near, double share)
    {
      const Vector3 offset = near - place;
      const double square = Dot(offset, offset);
      if (square < least)
      {
        least = square;
        nearest = { edge, share };
      }
    };
    offer(from, 0.0);
    offer(to, 1.0);
    const Vector3 normal = Cross(from, to - from);
    const double ofFrom = Dot(Cross(place, to), normal);
    const double ofTo = Dot(Cross(from, place), normal);
    if (ofFrom > 0.0 && ofTo > 0.0)
    {
      const double share = ofTo / (ofFrom + ofTo);
      offer(FindDirection(Vector3{ (1.0 - share) * from.X + share * to.X,
              (1.0 - share) * from.Y + share * to.Y, (1.0 - share) * from.Z + share * to.Z }),
        share);
    }
  }

  const Vector3* const Directions;
  std::vector<BoundaryEdge> Edges;
  std::vector<Cap> Groups;
};

/// Answers queries about a triangulation on a sphere.
class SphereAsker
{
public:
  /// @param mesh its arrays, and numbers, must live as long. @param points their number.
  /// @param numbers as for SphereGrid. @param segments edges of the triangles that are kept.
  SphereAsker(const SphereMesh& mesh, std::int64_t points, const std::vector<std::int32_t>& numbers,
    const std::vector<SphereEdge>& segments)
    : Grid(mesh, numbers),
      Directions(FindDirections(mesh, points)),
      Boundary(Grid, Directions.data()),
      Seen{ Grid.GetMesh(), Directions.data() }
  {
    if (!segments.empty())
    {
      this->CutAtSegments(segments);
    }
  }
  SphereAsker(const SphereAsker&) = delete;
  SphereAsker& operator=(const SphereAsker&) = delete;

  /// @param query its arrays are in the host's memory.
  /// @param observer is told the share of the places that is done.
  template <typename Backend>
  AskResult Answer(
    const PlaceQuery& query, const Backend& backend, const ProgressObserver& observer) const
  {
    constexpr std::int64_t MostAtATime = 1 << 16; // a thread needs about a tenth of a second
    const std::int64_t count = query.CountPlaces();
    const AskedValues values{ query.Values, nullptr, query.Components,
      query.Method == InterpolationKind::Natural, PlaceBoundaryView() };
    for (std::int64_t first = 0; first < count; first += MostAtATime)
    {
      if (observer && !observer(static_cast<double>(first) / static_cast<double>(count)))
      {
        return AskResult::Stopped;
      }
      backend.ForRange(std::min(MostAtATime, count - first),
        [&](std::int64_t begin, std::int64_t end)
        { this->AnswerRange(query, values, first + begin, first + end); });
    }
    return AskResult::Complete;
  }

private:
  static std::vector<Vector3> FindDirections(const SphereMesh& mesh, std::int64_t points)
  {
    std::vector<Vector3> directions(points);
    std::transform(mesh.Points, mesh.Points + points, directions.begin(),
      [](const PlanePoint& point) { return FindDirection(point); });
    return directions;
  }

  /// Copies the neighbours that frames see, without those behind segments.
  void CutAtSegments(const std::vector<SphereEdge>& segments)
  {
    SphereMesh& mesh = this->Seen.Mesh;
    std::vector<std::array<VertexId, 2>> sides;
    std::vector<char> areEnds(this->Directions.size());
    for (const SphereEdge& edge : segments)
    {
      const auto from = static_cast<VertexId>(edge.From), to = static_cast<VertexId>(edge.To);
      sides.push_back({ from, to });
      sides.push_back({ to, from });
      areEnds[from] = areEnds[to] = 1;
    }
    std::sort(sides.begin(), sides.end());
    this->Neighbors.assign(mesh.Neighbors, mesh.Neighbors + 3 * mesh.NumberOfTriangles);
    for (std::int64_t i = 0; i < SizeOf(this->Neighbors); ++i)
    {
      const CornerId corner = MakeCorner(static_cast<TriangleId>(i / 3), static_cast<int>(i % 3));
      const VertexId from = mesh.GetVertex(SphereMesh::Next(corner));
      const VertexId to = mesh.GetVertex(SphereMesh::Previous(corner));
      const bool mayBeSegment = areEnds[from] != 0 && areEnds[to] != 0;
      if (mayBeSegment && std::binary_search(sides.begin(), sides.end(), std::array{ from, to }))
      {
        this->Neighbors[i] = -1;
      }
    }
    mesh.Neighbors = this->Neighbors.data();
  }

  static PlanePoint GetPlace(const PlaceQuery& query, std::int64_t i)
  {
    const bool isRaster = query.Raster.CountCells() > 0;
    if (!isRaster && !query.Degrees)
    {
      return { query.Places.Get(i, 0), query.Places.Get(i, 1), query.Places.Get(i, 2) };
    }
    double xyz[3];
    if (isRaster)
    {
      PlaceOnSphere(query.Raster.Get(i, 0), query.Raster.Get(i, 1), xyz);
    }
    else
    {
      PlaceOnSphere(query.Places.Get(i, 0), query.Places.Get(i, 1), xyz);
    }
    return { xyz[0], xyz[1], xyz[2] };
  }

  void AnswerRange(
    const PlaceQuery& query, const AskedValues& values, std::int64_t begin, std::int64_t end) const
  {
    LastPlace last;
    for (std::int64_t i = begin; i < end; ++i)
    {
      const PlanePoint place = GetPlace(query, i);
      const Vector3 direction = FindDirection(place);
      const FoundPlace found = this->Grid.Find(place, direction, last);
      if (query.Triangles)
      {
        query.Triangles[i] = found.IsOutside() ? -1 : this->Grid.GetNumber(found.Triangle);
      }
      if (query.Values)
      {
        double* const result = query.Results + i * query.Components;
        this->Interpolate(values, query.Outside, direction, found, result);
      }
    }
  }

  void Interpolate(const AskedValues& values, OutsideKind outside, const Vector3& direction,
    const FoundPlace& found, double* result) const
  {
    if (found.IsOutside())
    {
      this->FillOutside(values, outside, direction, result);
      return;
    }
    const auto makeFrame = [&](TangentKind tangent)
    { return SphereFrame(this->Seen, direction, found.Triangle, tangent); };
    // At vertices, on the boundary and on segments there are no natural weights.
    double linearShare = 1.0;
    if (values.IsNatural && found.FindVertexSlot() < 0)
    {
      linearShare =
        values.TakeNatural(makeFrame(TangentKind::Stereographic), found.Triangle, result);
    }
    if (linearShare > 0.0)
    {
      values.AddLinear(makeFrame(TangentKind::Orthographic), found, linearShare, result);
    }
  }

  void FillOutside(
    const AskedValues& values, OutsideKind outside, const Vector3& direction, double* result) const
  {
    if (outside == OutsideKind::NotANumber || this->Boundary.IsEmpty() ||
      !IsFinite(Dot(direction, direction)))
    {
      values.Fill(result, NAN);
      return;
    }
    const NearestOnBoundary nearest = this->Boundary.FindNearest(direction);
    values.TakeAlong(nearest.Edge, nearest.ShareOfTo, result);
  }

  SphereGrid Grid;
  std::vector<Vector3> Directions; ///< By point.
  SphereBoundary Boundary;
  DirectedMesh Seen; ///< By frames: across a segment there is no triangle.
  std::vector<std::int32_t> Neighbors; ///< Those of Seen, if there are segments.
};

}

#endif
