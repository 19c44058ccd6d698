// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_SPHEREASKER_H
#define DELAUNAYFLIP_SPHEREASKER_H

#include "PlaceQuery.h"
#include "RunQuery.h"
#include "SphereFrame.h"
#include "SphereGrid.h"
#include "SphereQuery.h"
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
      this->Caps.push_back(this->FindCap(first));
    }
  }

  SphereBoundaryView View() const
  {
    return { this->Directions, this->Edges.data(), SizeOf(this->Edges), this->Caps.data() };
  }

private:
  static constexpr std::size_t GroupSize = SphereBoundaryView::GroupSize;

  BoundaryCap FindCap(std::size_t first) const
  {
    const std::size_t end = std::min(this->Edges.size(), first + GroupSize);
    Vector3 sum{ 0.0, 0.0, 0.0 };
    for (std::size_t i = first; i < end; ++i)
    {
      sum = sum + this->Directions[this->Edges[i].From] + this->Directions[this->Edges[i].To];
    }
    constexpr double Rounding = 1e-9, Diameter = 2.0;
    BoundaryCap cap{ FindDirection(sum), 0.0 };
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

  const Vector3* const Directions;
  std::vector<BoundaryEdge> Edges;
  std::vector<BoundaryCap> Caps;
};

/// Answers queries about a triangulation on a sphere, on the host. A device gets a copy of what is
/// asked (SphereDeviceAsker.h).
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

  AskedSphere View() const
  {
    return { this->Grid.GetMesh(), this->Seen, this->Grid.GetNumbers(), this->Grid.GetCells(),
      this->Grid.HasPlaces(), this->Boundary.View(), nullptr };
  }

  /// @param query its arrays are in the host's memory.
  /// @param observer is told the share of the places that is done.
  template <typename Backend>
  AskResult Answer(
    const PlaceQuery& query, const Backend& backend, const ProgressObserver& observer) const
  {
    constexpr std::int64_t MostAtATime = 1 << 16; // a thread needs about a tenth of a second
    const std::int64_t count = query.CountPlaces();
    for (std::int64_t first = 0; first < count; first += MostAtATime)
    {
      if (observer && !observer(static_cast<double>(first) / static_cast<double>(count)))
      {
        return AskResult::Stopped;
      }
      const std::int64_t size = std::min(MostAtATime, count - first);
      backend.ForRange(size, CutAnswer(this->View(), query, first, size));
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

  SphereGrid Grid;
  std::vector<Vector3> Directions; ///< By point.
  SphereBoundary Boundary;
  DirectedMesh Seen; ///< By frames: across a segment there is no triangle.
  std::vector<std::int32_t> Neighbors; ///< Those of Seen, if there are segments.
};

}

#endif
