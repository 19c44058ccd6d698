// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_SPHEREASKER_H
#define DELAUNAYFLIP_SPHEREASKER_H

#include "PlaceQuery.h"
#include "PointTriangulation.h"
#include "RunQuery.h"
#include "SphereFrame.h"
#include "SphereGrid.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace delaunayflip
{

/// The boundary of triangles on a sphere, for places outside.
class SphereBoundary
{
public:
  explicit SphereBoundary(const SphereMesh& mesh)
    : Points(mesh.Points)
  {
    for (std::int64_t i = 0; i < 3 * mesh.NumberOfTriangles; ++i)
    {
      const auto triangle = static_cast<TriangleId>(i / 3);
      if (mesh.Neighbors[i] < 0 && mesh.FacesOutside(triangle))
      {
        const CornerId corner = MakeCorner(triangle, static_cast<int>(i % 3));
        this->Edges.push_back({ mesh.GetVertex(SphereMesh::Next(corner)),
          mesh.GetVertex(SphereMesh::Previous(corner)) });
      }
    }
  }

  bool IsEmpty() const { return this->Edges.empty(); }

  NearestOnBoundary FindNearest(const Vector3& place) const
  {
    NearestOnBoundary nearest{ this->Edges.front(), 0.0 };
    double least = INFINITY;
    for (const BoundaryEdge& edge : this->Edges)
    {
      const Vector3 from = FindDirection(this->Points[edge.From]);
      const Vector3 to = FindDirection(this->Points[edge.To]);
      const auto offer = [&](double share)
      {
        const Vector3 near = FindDirection(Vector3{ (1.0 - share) * from.X + share * to.X,
          (1.0 - share) * from.Y + share * to.Y, (1.0 - share) * from.Z + share * to.Z });
        const Vector3 offset = near - place;
        const double square = Dot(offset, offset);
        if (square < least)
        {
          least = square;
          nearest = { edge, share };
        }
      };
      offer(0.0);
      offer(1.0);
      const Vector3 normal = Cross(from, to - from);
      const double ofFrom = Dot(Cross(place, to), normal);
      const double ofTo = Dot(Cross(from, place), normal);
      if (ofFrom > 0.0 && ofTo > 0.0)
      {
        offer(ofTo / (ofFrom + ofTo));
      }
    }
    return nearest;
  }

private:
  const PlanePoint* const Points;
  std::vector<BoundaryEdge> Edges;
};

/// Answers queries about a triangulation on a sphere.
class SphereAsker
{
public:
  explicit SphereAsker(const SphereMesh& mesh)
    : Grid(mesh),
      Boundary(Grid.GetMesh())
  {
  }

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
        query.Triangles[i] = found.IsOutside() ? -1 : static_cast<std::int32_t>(found.Triangle);
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
    { return SphereFrame(this->Grid.GetMesh(), direction, found.Triangle, tangent); };
    // At vertices and on the boundary there are no natural weights.
    const bool isDone = values.IsNatural && found.FindVertexSlot() < 0 &&
      values.TakeNatural(makeFrame(TangentKind::Stereographic), found.Triangle, result);
    if (!isDone)
    {
      values.AddLinear(makeFrame(TangentKind::Orthographic), found, result);
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
  SphereBoundary Boundary;
};

}

#endif
