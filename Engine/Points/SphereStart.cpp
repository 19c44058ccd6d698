// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SphereStart.h"

#include "ExactPredicates.h"
#include "SmallestAngle.h"
#include "Strips.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <tuple>

namespace delaunayflip
{

namespace
{
Vector3 ToVector(const PlanePoint& p) { return { p.U, p.V, p.W }; }

/// Whether the rounded center of a simplex is inside of it.
bool HoldsCenter(const Simplex& simplex)
{
  const PlanePoint center = FindCenter(simplex);
  for (int i = 0; i < 4; ++i)
  {
    PlanePoint corners[4];
    std::transform(simplex.begin(), simplex.end(), corners,
      [](const NumberedPoint& corner) { return corner.Place; });
    corners[i] = center;
    if (FindOrientation3D(corners[0], corners[1], corners[2], corners[3]) <= 0)
    {
      return false;
    }
  }
  return true;
}

void SortOnce(std::vector<std::int32_t>& ids)
{
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
}
}

StereographicProjection::StereographicProjection(const PlanePoint& pole)
  : Pole(FindDirection(pole)),
    Across(Pole)
{
}

std::vector<std::int32_t> FindNeighbors(
  const std::vector<std::int32_t>& triangles, std::int64_t points)
{
  struct Side
  {
    std::int32_t Larger; ///< The larger id of the two ends.
    std::int32_t Corner; ///< 3 * triangle + slot.
  };
  const std::int64_t corners = SizeOf(triangles);
  const auto getEnds = [&](std::int64_t corner)
  {
    const std::int64_t first = corner - corner % 3;
    const std::int32_t a = triangles[first + (corner + 1) % 3];
    const std::int32_t b = triangles[first + (corner + 2) % 3];
    return std::minmax({ a, b });
  };
  // Sides are listed by the smaller id of their ends.
  std::vector<std::int64_t> starts(points + 1);
  for (std::int64_t corner = 0; corner < corners; ++corner)
  {
    ++starts[getEnds(corner).first + 1];
  }
  for (std::int64_t i = 0; i < points; ++i)
  {
    starts[i + 1] += starts[i];
  }
  std::vector<Side> sides(corners);
  std::vector<std::int64_t> ends(starts.begin(), starts.end() - 1);
  for (std::int64_t corner = 0; corner < corners; ++corner)
  {
    const auto [smaller, larger] = getEnds(corner);
    sides[ends[smaller]++] = { larger, static_cast<std::int32_t>(corner) };
  }
  std::vector<std::int32_t> neighbors(corners, -1);
  for (std::int64_t i = 0; i < points; ++i)
  {
    Side* const begin = sides.data() + starts[i];
    Side* const end = sides.data() + starts[i + 1];
    std::sort(begin, end, [](const Side& a, const Side& b) { return a.Larger < b.Larger; });
    for (Side* side = begin; side + 1 < end; ++side)
    {
      if (side[0].Larger == side[1].Larger)
      {
        neighbors[side[0].Corner] = side[1].Corner / 3;
        neighbors[side[1].Corner] = side[0].Corner / 3;
      }
    }
  }
  return neighbors;
}

PoleStar MakePoleStar(const std::vector<BoundarySide>& sides, std::int64_t first, std::int32_t pole)
{
  std::map<std::int32_t, std::int32_t> fromPoint, toPoint; // triangles by ends of their sides
  for (const BoundarySide& side : sides)
  {
    fromPoint[side.From] = toPoint[side.To] = static_cast<std::int32_t>(first++);
  }
  PoleStar star;
  for (const BoundarySide& side : sides)
  {
    star.Triangles.insert(star.Triangles.end(), { side.To, side.From, pole });
    star.Neighbors.insert(
      star.Neighbors.end(), { toPoint[side.From], fromPoint[side.To], side.Corner / 3 });
  }
  return star;
}

Simplex OrientSimplex(Simplex corners)
{
  const int side =
    FindOrientation3D(corners[0].Place, corners[1].Place, corners[2].Place, corners[3].Place);
  if (side < 0)
  {
    std::swap(corners[1], corners[2]);
  }
  return side != 0 && HoldsCenter(corners) ? corners : Simplex();
}

PlanePoint FindCenter(const Simplex& simplex)
{
  PlanePoint center{ 0.0, 0.0, 0.0 };
  for (const NumberedPoint& corner : simplex)
  {
    center.U += 0.25 * corner.Place.U;
    center.V += 0.25 * corner.Place.V;
    center.W += 0.25 * corner.Place.W;
  }
  return center;
}

bool FacesOutside(const SpacePoints& points, const std::int32_t* triangle, const PlanePoint& center)
{
  return FindOrientation3D(points[triangle[0]], points[triangle[1]], points[triangle[2]], center) >
    0;
}

std::vector<std::int32_t> FindStrays(
  const SpacePoints& points, const std::vector<std::int32_t>& triangles, const PlanePoint& center)
{
  std::vector<std::int32_t> strays;
  for (std::size_t first = 0; first < triangles.size(); first += 3)
  {
    const std::int32_t* ids = triangles.data() + first;
    if (FacesOutside(points, ids, center))
    {
      continue;
    }
    double shortest = INFINITY;
    std::int32_t stray = ids[0];
    for (int slot = 0; slot < 3; ++slot)
    {
      const std::int32_t a = ids[slot], b = ids[(slot + 1) % 3];
      const double length = Length(ToVector(points[a]) - ToVector(points[b]));
      if (length < shortest)
      {
        shortest = length;
        stray = IsFartherNorth(points[a], points[b]) ? a : b;
      }
    }
    strays.push_back(stray);
  }
  SortOnce(strays);
  return strays;
}

std::vector<std::int32_t> FindHidden(const SpacePoints& points,
  const std::vector<std::int32_t>& triangles, const std::vector<std::int32_t>& neighbors,
  const PlanePoint& center)
{
  std::vector<std::int32_t> hidden;
  for (std::size_t corner = 0; corner < triangles.size(); ++corner)
  {
    const std::size_t t = corner / 3, slot = corner % 3;
    const std::int32_t across = neighbors[corner];
    if (across < 0)
    {
      continue;
    }
    const std::int32_t a = triangles[corner];
    const std::int32_t p = triangles[3 * t + (slot + 1) % 3];
    const std::int32_t q = triangles[3 * t + (slot + 2) % 3];
    const std::int32_t* other = triangles.data() + std::size_t(3) * across;
    const std::int32_t b = other[0] + other[1] + other[2] - p - q;
    if (FindOrientation3D(points[a], points[p], points[q], points[b]) >= 0)
    {
      continue;
    }
    const std::int32_t without[3] = { b, q, a }; // the new triangle without p
    const bool isHidden = FindOrientation3D(points[a], points[p], points[b], center) <= 0 &&
      FindOrientation3D(points[b], points[q], points[a], points[p]) > 0;
    if (isHidden && FacesOutside(points, without, center))
    {
      hidden.push_back(p);
    }
  }
  SortOnce(hidden);
  return hidden;
}

std::vector<std::int32_t> FindBetween(
  const SpacePoints& points, const std::vector<std::int32_t>& triangles)
{
  std::vector<std::int32_t> between;
  for (std::size_t first = 0; first < triangles.size(); first += 3)
  {
    std::int32_t ids[] = { triangles[first], triangles[first + 1], triangles[first + 2] };
    if (AreOnLine(points[ids[0]], points[ids[1]], points[ids[2]]))
    {
      std::sort(ids, ids + 3,
        [&](std::int32_t a, std::int32_t b) { return IsFartherNorth(points[a], points[b]); });
      between.push_back(ids[1]);
    }
  }
  SortOnce(between);
  return between;
}

namespace
{
/// Calls visit(a, p, q, b) for every edge p-q of a closed mesh, once.
template <typename Visit>
void ForEachQuad(const std::vector<std::int32_t>& triangles,
  const std::vector<std::int32_t>& neighbors, const Visit& visit)
{
  for (std::size_t corner = 0; corner < triangles.size(); ++corner)
  {
    const std::size_t first = corner - corner % 3;
    const std::int32_t across = neighbors[corner];
    if (std::size_t(across) > corner / 3)
    {
      const std::int32_t p = triangles[first + (corner + 1) % 3];
      const std::int32_t q = triangles[first + (corner + 2) % 3];
      const std::int32_t* other = triangles.data() + std::size_t(3) * across;
      visit(triangles[corner], p, q, other[0] + other[1] + other[2] - p - q);
    }
  }
}
}

std::vector<std::int32_t> FindFlat(const SpacePoints& points,
  const std::vector<std::int32_t>& triangles, const std::vector<std::int32_t>& neighbors)
{
  constexpr int Enough = 3;
  // Floating-point arithmetic nearly always finds enough convex edges at every point.
  std::vector<std::int32_t> sharp(points.size());
  const auto count = [&](std::int32_t p, std::int32_t q, int sign)
  {
    sharp[p] += int(sign > 0);
    sharp[q] += int(sign > 0);
  };
  const auto areUsual = std::all_of(points.begin(), points.end(), IsInFilterRange3D);
  ForEachQuad(triangles, neighbors,
    [&](std::int32_t a, std::int32_t p, std::int32_t q, std::int32_t b)
    {
      const int sign = FilteredOrientation3D(points[a], points[p], points[q], points[b]);
      count(p, q, areUsual && sign == 1 ? 1 : 0);
    });
  const auto isShort = [&](std::int32_t id) { return sharp[id] < Enough; };
  std::vector<std::int32_t> flat;
  std::copy_if(triangles.begin(), triangles.end(), std::back_inserter(flat), isShort);
  if (flat.empty())
  {
    return flat;
  }
  std::fill(sharp.begin(), sharp.end(), 0);
  ForEachQuad(triangles, neighbors,
    [&](std::int32_t a, std::int32_t p, std::int32_t q, std::int32_t b)
    { count(p, q, FindOrientation3D(points[a], points[p], points[q], points[b])); });
  flat.erase(
    std::remove_if(flat.begin(), flat.end(), [&](std::int32_t id) { return !isShort(id); }),
    flat.end());
  SortOnce(flat);
  return flat;
}

}
