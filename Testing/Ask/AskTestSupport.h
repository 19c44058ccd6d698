// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_ASKTESTSUPPORT_H
#define DELAUNAYFLIP_ASKTESTSUPPORT_H

#include "PointTestSupport.h"
#include "Predicates.h"
#include "QueryTestSupport.h"
#include "RandomInputs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <utility>
#include <vector>

/// @file
/// Triangulations of points that tests ask, and places to ask for.

namespace delaunayflip
{

/// A session, what it makes, and answers to queries.
class Asked
{
public:
  explicit Asked(const Drawing& drawing, const PointOptions& options = {})
    : Points(drawing.Points),
      Session(FlipPoints(drawing.View(), options)),
      Triangles(3 * Session.GetReport().Triangles)
  {
    this->Session.StoreTriangles(
      MutableTriangleArray(this->Triangles.data(), this->Session.GetReport().Triangles));
    for (const AddedPoint& point : this->Session.GetAddedPoints())
    {
      this->Points.push_back({ point.X, point.Y });
    }
  }

  std::vector<std::int32_t> Locate(const Places& places) const
  {
    PlaceQuery query;
    query.Places = View(places);
    return delaunayflip::Locate(this->Session, query);
  }

  std::vector<double> Interpolate(const std::vector<double>& values, const Places& places,
    InterpolationKind method, OutsideKind outside = OutsideKind::NotANumber) const
  {
    PlaceQuery query;
    query.Places = View(places);
    query.Method = method;
    query.Outside = outside;
    return delaunayflip::Interpolate(this->Session, query, values, this->Points.size());
  }

  /// By exact orientation, of all triangles the first that has the place.
  std::int32_t FindByHand(const Place& place) const
  {
    for (std::size_t t = 0; t < this->Triangles.size() / 3; ++t)
    {
      bool isInside = true;
      for (int i = 0; i < 3 && isInside; ++i)
      {
        const Place& a = this->Points[this->Triangles[3 * t + i]];
        const Place& b = this->Points[this->Triangles[3 * t + (i + 1) % 3]];
        isInside = Orientation(a.data(), b.data(), place.data()) >= 0;
      }
      if (isInside)
      {
        return static_cast<std::int32_t>(t);
      }
    }
    return -1;
  }

  /// From the edges that one triangle has.
  double FindDistance(const Place& place) const
  {
    std::map<std::pair<std::int32_t, std::int32_t>, int> triangles;
    for (std::size_t i = 0; i < this->Triangles.size(); ++i)
    {
      const std::size_t next = i % 3 == 2 ? i - 2 : i + 1;
      ++triangles[std::minmax(this->Triangles[i], this->Triangles[next])];
    }
    double distance = INFINITY;
    for (const auto& [edge, count] : triangles)
    {
      if (count == 1)
      {
        distance = std::min(
          distance, this->FindDistance(place, this->Points[edge.first], this->Points[edge.second]));
      }
    }
    return distance;
  }

  static double FindDistance(const Place& place, const Place& a, const Place& b)
  {
    const double u = b[0] - a[0], v = b[1] - a[1];
    const double along = ((place[0] - a[0]) * u + (place[1] - a[1]) * v) / (u * u + v * v);
    const double share = std::clamp(along, 0.0, 1.0);
    return std::hypot(a[0] + share * u - place[0], a[1] + share * v - place[1]);
  }

  Places Points;
  FlipSession Session;
  std::vector<std::int32_t> Triangles;
};

/// Places of every kind: in triangles, on edges, on vertices, in removed triangles, outside.
inline Places DrawPlaces(const Asked& asked, std::mt19937& random, int count)
{
  const auto draw = [&] { return DrawIndex(random, 1025) / 1024.0; };
  const auto pick = [&] { return asked.Points[DrawIndex(random, asked.Points.size())]; };
  Places places;
  for (int i = 0; i < count; ++i)
  {
    const Place a = pick(), b = pick();
    switch (i % 5)
    {
      case 0:
        places.push_back(a);
        break;
      case 1: // often on an edge, or exactly between two points of a lattice
        places.push_back({ 0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]) });
        break;
      case 2:
        places.push_back({ a[0], b[1] });
        break;
      case 3:
        places.push_back({ a[0] + 0.01 * (draw() - 0.5), a[1] + 0.01 * (draw() - 0.5) });
        break;
      default:
        places.push_back({ 1.2 * draw() - 0.1, 1.2 * draw() - 0.1 });
    }
  }
  return places;
}

/// Random points, some on a lattice, with an outline, a hole and a breakline.
inline Drawing DrawSurvey(std::mt19937& random, int count)
{
  Drawing drawing;
  for (int i = 0; i < count; ++i)
  {
    const double x = DrawIndex(random, 1025) / 1024.0, y = DrawIndex(random, 1025) / 1024.0;
    const bool isOnLattice = i % 3 == 0;
    drawing.Points.push_back(
      isOnLattice ? Place{ std::floor(8 * x) / 8, std::floor(8 * y) / 8 } : Place{ x, y });
  }
  drawing.AddRing({ { 0.0625, 0.0625 }, { 1.0, 0.125 }, { 0.9375, 0.9375 }, { 0.125, 1.0 } });
  drawing.FirstHole = 1;
  drawing.AddRing({ { 0.375, 0.375 }, { 0.625, 0.375 }, { 0.5, 0.625 } });
  const auto first = static_cast<std::int64_t>(drawing.Points.size());
  drawing.Points.push_back({ 0.25, 0.25 });
  drawing.Points.push_back({ 0.25, 0.875 });
  drawing.Segments.push_back({ first, first + 1 });
  drawing.Rings.push_back(-1);
  return drawing;
}

}

#endif
