// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_POINTTESTSUPPORT_H
#define DELAUNAYFLIP_POINTTESTSUPPORT_H

#include "FlipTestSupport.h"
#include "References.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <set>
#include <vector>

/// @file
/// Triangulations of points for tests, and their judgement by rational numbers.

namespace delaunayflip
{

using Pairs = std::vector<std::array<std::int64_t, 2>>;

inline PlaneArray View(const Places& points)
{
  return PlaneArray(
    points.empty() ? nullptr : points.front().data(), static_cast<std::int64_t>(points.size()), 2);
}

/// Points and segments that belong to a test.
struct Drawing
{
  Places Points;
  Pairs Segments;
  std::vector<std::int32_t> Rings;
  std::int32_t FirstHole = INT32_MAX;
  std::vector<double> Seeds;

  PointInput View() const
  {
    PointInput input;
    input.Points = delaunayflip::View(this->Points);
    input.Segments = this->Segments.empty() ? nullptr : this->Segments.front().data();
    input.NumberOfSegments = static_cast<std::int64_t>(this->Segments.size());
    input.Rings = this->Rings.empty() ? nullptr : this->Rings.data();
    input.FirstHole = this->FirstHole;
    input.HoleSeeds = this->Seeds.data();
    input.NumberOfHoleSeeds = static_cast<std::int64_t>(this->Seeds.size()) / 2;
    return input;
  }

  /// Adds a closed ring of new points.
  void AddRing(const Places& corners)
  {
    const std::int32_t ring = this->Rings.empty() ? 0 : this->Rings.back() + 1;
    const auto first = static_cast<std::int64_t>(this->Points.size());
    const auto count = static_cast<std::int64_t>(corners.size());
    for (std::int64_t i = 0; i < count; ++i)
    {
      this->Points.push_back(corners[i]);
      this->Segments.push_back({ first + i, first + (i + 1) % count });
      this->Rings.push_back(ring);
    }
  }
};

struct Triangulation
{
  std::vector<std::int32_t> Triangles, Neighbors;
  std::vector<std::int64_t> UsedPoints;
  Pairs Edges; ///< That segments became.
  std::vector<AddedPoint> Added;
  FlipReport Report;
};

inline Triangulation Triangulate(const PointInput& input, const PointOptions& options = {})
{
  const FlipSession session = FlipPoints(input, options);
  Triangulation result;
  result.Report = session.GetReport();
  result.Triangles = StoreTriangles(session);
  result.Neighbors.resize(result.Triangles.size());
  session.StoreNeighbors(result.Neighbors.data());
  result.UsedPoints.resize(input.Points.Count);
  session.StoreUsedPoints(result.UsedPoints.data());
  const std::vector<std::int64_t> edges = session.ListSegmentEdges();
  for (std::size_t i = 0; i < edges.size(); i += 2)
  {
    result.Edges.push_back({ edges[i], edges[i + 1] });
  }
  result.Added = session.GetAddedPoints();
  return result;
}

inline Triangulation Triangulate(const Drawing& drawing, const PointOptions& options = {})
{
  return Triangulate(drawing.View(), options);
}

inline Triangulation Triangulate(const Places& points, const FlipOptions& options = {})
{
  return Triangulate(PointInput{ View(points) }, PointOptions{ options });
}

inline Point3 ToPoint(const std::array<double, 2>& place) { return { place[0], place[1], 0.0 }; }

inline int Turn(const Places& points, std::int64_t a, std::int64_t b, std::int64_t c)
{
  return RationalTurn(ToPoint(points[a]), ToPoint(points[b]), ToPoint(points[c]));
}

inline Places DrawOnGrid(std::mt19937& random, std::size_t count, int columns, int rows)
{
  Places points(count);
  for (auto& point : points)
  {
    point = { static_cast<double>(DrawIndex(random, columns)),
      static_cast<double>(DrawIndex(random, rows)) };
  }
  return points;
}

/// How many edges have one triangle.
inline std::int64_t CountBorder(const Triangulation& result)
{
  return std::count(result.Neighbors.begin(), result.Neighbors.end(), -1);
}

/// The triangles by the places of their corners, so that they can be compared across orders.
inline std::set<std::set<Place>> ByPlaces(
  const std::vector<std::int32_t>& triangles, const Places& points)
{
  std::set<std::set<Place>> result;
  for (std::size_t i = 0; i < triangles.size(); i += 3)
  {
    result.insert({ points[triangles[i]], points[triangles[i + 1]], points[triangles[i + 2]] });
  }
  return result;
}

/// Expects as many triangles as the places and their hull ask for, none if all are on one line.
inline void ExpectRightNumber(const std::set<Place>& places, const Triangulation& result)
{
  const auto triangles = static_cast<std::int64_t>(result.Triangles.size()) / 3;
  EXPECT_EQ(triangles, result.Report.Triangles);
  EXPECT_EQ(StopReasonKind::Converged, result.Report.StopReason);
  const bool isLine = std::all_of(places.begin(), places.end(),
    [&](const Place& place) {
      return RationalTurn(ToPoint(*places.begin()), ToPoint(*places.rbegin()), ToPoint(place)) == 0;
    });
  const auto count = static_cast<std::int64_t>(places.size());
  EXPECT_EQ(isLine ? 0 : 2 * count - 2 - CountBorder(result), triangles);
}

/// Neighbor k of a triangle must be the other one at its edge across corner k.
inline void ExpectNeighbors(const Triangulation& result)
{
  const TriangleArray triangles = ViewTriangles(result.Triangles);
  ASSERT_EQ(result.Triangles.size(), FindOpposites(triangles).size()); // each half-edge once
  const EdgeMap edges = CollectEdges(triangles);
  for (std::int64_t i = 0; i < 3 * triangles.Count; ++i)
  {
    const std::int64_t t = i / 3;
    const auto& incident =
      edges.at(Sorted(triangles.Get(t, (i + 1) % 3), triangles.Get(t, (i + 2) % 3)));
    ASSERT_EQ(incident.size() == 2 ? incident[0] + incident[1] - t : -1, result.Neighbors[i]);
  }
}

/// All triangles turn left, neighbours are those of the edges, the segments' edges are there, and
/// every other edge is locally Delaunay: so the whole is constrained Delaunay.
inline void ExpectConstrainedDelaunay(const Places& points, const Triangulation& result)
{
  ExpectNeighbors(result);
  const EdgeMap edges = CollectEdges(ViewTriangles(result.Triangles));
  std::set<VertexPair> segments;
  for (const auto& edge : result.Edges)
  {
    segments.insert(Sorted(edge[0], edge[1]));
    ASSERT_EQ(1u, edges.count(Sorted(edge[0], edge[1])));
  }
  for (std::size_t i = 0; i < result.Triangles.size(); ++i)
  {
    const std::size_t first = i - i % 3;
    const std::int32_t a = result.Triangles[i];
    const std::int32_t b = result.Triangles[first + (i + 1) % 3];
    const std::int32_t c = result.Triangles[first + (i + 2) % 3];
    ASSERT_EQ(1, Turn(points, a, b, c));
    const std::int32_t across = result.Neighbors[i];
    if (across < 0 || segments.count(Sorted(b, c)) > 0)
    {
      continue;
    }
    const std::int32_t* other = &result.Triangles[3 * across];
    const std::int32_t* opposite = std::find_if(
      other, other + 3, [=](std::int32_t vertex) { return vertex != b && vertex != c; });
    ASSERT_GE(0,
      RationalInCircle(
        ToPoint(points[a]), ToPoint(points[b]), ToPoint(points[c]), ToPoint(points[*opposite])));
  }
}

}

#endif
