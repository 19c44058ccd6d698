// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PolygonSplit.h"

#include "EarClipper.h"
#include "Predicates.h"
#include "SurfaceAngles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>

namespace delaunayflip
{
namespace
{

using SpaceVector = std::array<double, 3>;

/// Twice the area of the polygon's projection along each axis (Newell), up to a positive factor.
/// @param offsets the vertices relative to the first one.
template <typename Offsets>
SpaceVector AreaVector(const Offsets& offsets)
{
  SpaceVector area = { 0.0, 0.0, 0.0 };
  for (std::size_t i = 1; i + 1 < offsets.size(); ++i)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      const int u = (axis + 1) % 3;
      const int v = (axis + 2) % 3;
      area[axis] += offsets[i][u] * offsets[i + 1][v] - offsets[i][v] * offsets[i + 1][u];
    }
  }
  return area;
}

int DominantAxis(const SpaceVector& vector)
{
  const auto isSmaller = [](double a, double b) { return std::abs(a) < std::abs(b); };
  return static_cast<int>(
    std::max_element(vector.begin(), vector.end(), isSmaller) - vector.begin());
}

/// The polygon seen along the dominant axis of its area vector, from the side from which it runs
/// counter-clockwise.
std::vector<PlaneVector> Project(
  const PointArray& points, const std::int64_t* ids, std::int64_t count)
{
  std::vector<SpaceVector> offsets(static_cast<std::size_t>(count));
  LoadScaledOffsets(points, ids, count, 3, offsets);
  const SpaceVector area = AreaVector(offsets);
  const int axis = DominantAxis(area);
  int u = (axis + 1) % 3;
  int v = (axis + 2) % 3;
  if (area[axis] < 0.0)
  {
    std::swap(u, v);
  }
  std::vector<PlaneVector> projected(static_cast<std::size_t>(count));
  for (std::int64_t i = 0; i < count; ++i)
  {
    projected[i] = { points.Get(ids[i], u), points.Get(ids[i], v) };
  }
  return projected;
}

/// The sign of the dot product of the normals of two triangles of a quad, those on the diagonal
/// from vertex `first`. They fold if it is not positive. 0 if one has almost no area or a
/// coordinate is not finite, so that the sign would mean nothing.
int CompareNormals(const std::array<SpaceVector, 4>& quad, int first)
{
  const auto normal = [&](int second, int third)
  {
    std::array<SpaceVector, 3> offsets = { quad[first], quad[second % 4], quad[third % 4] };
    for (int axis = 0; axis < 3; ++axis)
    {
      offsets[1][axis] -= offsets[0][axis];
      offsets[2][axis] -= offsets[0][axis];
    }
    return AreaVector(offsets);
  };
  const SpaceVector a = normal(first + 1, first + 2), b = normal(first + 2, first + 3);
  constexpr double Rounding = 1e-14; // of areas, where the longest offset has length 1 to 4
  const double smaller = std::min(std::abs(a[DominantAxis(a)]), std::abs(b[DominantAxis(b)]));
  const double dot = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  if (!std::isfinite(dot) || smaller < Rounding)
  {
    return 0;
  }
  return dot > 0.0 ? 1 : -1;
}

int Orient(const std::vector<PlaneVector>& polygon, std::int64_t a, std::int64_t b, std::int64_t c)
{
  return Orientation(polygon[a].data(), polygon[b].data(), polygon[c].data());
}

/// Whether to divide a quad along 1-3: if that is inside and 0-2 is not, or if only 0-2 folds.
bool PrefersSecondDiagonal(
  const PointArray& points, const std::int64_t* ids, const std::vector<PlaneVector>& quad)
{
  std::array<SpaceVector, 4> offsets;
  LoadScaledOffsets(points, ids, 4, 3, offsets);
  const bool firstIsInside = Orient(quad, 0, 1, 2) > 0 && Orient(quad, 0, 2, 3) > 0;
  const bool secondIsInside = Orient(quad, 1, 2, 3) > 0 && Orient(quad, 1, 3, 0) > 0;
  return (CompareNormals(offsets, 0) < 0 && CompareNormals(offsets, 1) > 0) ||
    (secondIsInside && !firstIsInside);
}

/// Whether no corner is clockwise and no triangle of the fan is empty.
bool IsConvex(const std::vector<PlaneVector>& polygon)
{
  const auto count = static_cast<std::int64_t>(polygon.size());
  for (std::int64_t i = 0; i < count; ++i)
  {
    const std::int64_t next = (i + 1) % count;
    if (Orient(polygon, i, next, (i + 2) % count) < 0 ||
      (i > 0 && next > 0 && Orient(polygon, 0, i, next) <= 0))
    {
      return false;
    }
  }
  return true;
}

/// Whether the triangle's projection along some axis has an area; exact.
/// @param first the axis to try first, which usually decides without exact arithmetic.
bool HasArea(const PointArray& points, const std::int64_t ids[3], int first)
{
  for (int axis = first; axis < first + 3; ++axis)
  {
    double corners[3][2];
    for (int i = 0; i < 3; ++i)
    {
      corners[i][0] = points.Get(ids[i], (axis + 1) % 3);
      corners[i][1] = points.Get(ids[i], (axis + 2) % 3);
    }
    if (Orientation(corners[0], corners[1], corners[2]) != 0)
    {
      return true;
    }
  }
  return false;
}

}

namespace
{

/// Whether a vertex is the same as the next one. The first one is next to the last.
bool HasRepeats(const std::int64_t* ids, std::int64_t count)
{
  return ids[count - 1] == ids[0] || std::adjacent_find(ids, ids + count) != ids + count;
}

/// Whether there are fewer than three different vertices.
bool IsTooSmall(const std::int64_t* ids, std::int64_t count)
{
  const std::int64_t* const second =
    std::find_if(ids, ids + count, [ids](std::int64_t id) { return id != ids[0]; });
  return std::all_of(
    second, ids + count, [=](std::int64_t id) { return id == ids[0] || id == *second; });
}

/// The vertices that differ from the one before them.
std::vector<std::int64_t> DropRepeats(const std::int64_t* ids, std::int64_t count)
{
  std::vector<std::int64_t> different;
  std::unique_copy(ids, ids + count, std::back_inserter(different));
  while (different.size() > 1 && different.back() == different.front())
  {
    different.pop_back();
  }
  return different;
}

/// Does what SplitPolygon does, for vertices without repetitions.
bool Split(const PointArray& points, const std::int64_t* ids, std::int64_t count,
  std::vector<std::int64_t>& triangles, const ProgressObserver& progress)
{
  const std::vector<PlaneVector> polygon = Project(points, ids, count);
  Triples cut;
  if (count == 4 && PrefersSecondDiagonal(points, ids, polygon))
  {
    cut = { { 0, 1, 3 }, { 1, 2, 3 } };
  }
  else if (count <= 4 || IsConvex(polygon))
  {
    for (std::int64_t i = 1; i + 1 < count; ++i)
    {
      cut.push_back({ 0, i, i + 1 });
    }
  }
  else
  {
    cut = ClipEars(polygon, progress);
  }
  for (const std::array<std::int64_t, 3>& triangle : cut)
  {
    for (std::int64_t position : triangle)
    {
      triangles.push_back(ids[position]);
    }
  }
  return !cut.empty();
}

}

bool SplitPolygon(const PointArray& points, const std::int64_t* ids, std::int64_t count,
  std::vector<std::int64_t>& triangles, const ProgressObserver& progress)
{
  if (count > 3 && IsTooSmall(ids, count))
  {
    return true;
  }
  if (count == 3 || !HasRepeats(ids, count))
  {
    return Split(points, ids, count, triangles, progress);
  }
  const std::vector<std::int64_t> different = DropRepeats(ids, count);
  return Split(
    points, different.data(), static_cast<std::int64_t>(different.size()), triangles, progress);
}

void TriangleNormal(const PointArray& points, const std::int64_t ids[3], double normal[3])
{
  std::array<SpaceVector, 3> offsets;
  LoadScaledOffsets(points, ids, 3, 3, offsets);
  SpaceVector area = AreaVector(offsets);
  const int axis = DominantAxis(area);
  const auto divideBy = [&](double length)
  {
    for (double& component : area)
    {
      component = length > 0.0 ? component / length : 0.0;
    }
  };
  divideBy(std::abs(area[axis])); // the area of a needle may be so small that its length is inexact
  divideBy(std::sqrt(area[0] * area[0] + area[1] * area[1] + area[2] * area[2]));
  const bool isValid = std::isfinite(area[0] + area[1] + area[2]) && HasArea(points, ids, axis);
  for (int i = 0; i < 3; ++i)
  {
    normal[i] = isValid ? area[i] : 0.0;
  }
}

}
