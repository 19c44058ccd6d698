// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PolygonSplit.h"

#include "Predicates.h"
#include "ScaledOffsets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace delaunayflip
{
namespace
{

using Vector2 = std::array<double, 2>;
using Vector3 = std::array<double, 3>;

/// Twice the area of the polygon's shadow along each axis (Newell), up to a positive factor.
/// @param offsets of the vertices, from the first of them.
template <typename Offsets>
Vector3 AreaVector(const Offsets& offsets)
{
  Vector3 area = { 0.0, 0.0, 0.0 };
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

Vector3 AreaVector(const PointArray& points, const std::int64_t* ids, std::int64_t count)
{
  std::vector<Vector3> offsets(static_cast<std::size_t>(count));
  LoadScaledOffsets(points, ids, count, 3, offsets);
  return AreaVector(offsets);
}

int DominantAxis(const Vector3& vector)
{
  const auto isSmaller = [](double a, double b) { return std::abs(a) < std::abs(b); };
  return static_cast<int>(
    std::max_element(vector.begin(), vector.end(), isSmaller) - vector.begin());
}

/// The polygon seen along the dominant axis of its area vector, from the side from which it runs
/// counter-clockwise.
std::vector<Vector2> Project(const PointArray& points, const std::int64_t* ids, std::int64_t count)
{
  const Vector3 area = AreaVector(points, ids, count);
  const int axis = DominantAxis(area);
  int u = (axis + 1) % 3;
  int v = (axis + 2) % 3;
  if (area[axis] < 0.0)
  {
    std::swap(u, v);
  }
  std::vector<Vector2> projected(static_cast<std::size_t>(count));
  for (std::int64_t i = 0; i < count; ++i)
  {
    projected[i] = { points.Get(ids[i], u), points.Get(ids[i], v) };
  }
  return projected;
}

/// Cuts triangles off a polygon until three vertices are left. All triangles are triples of
/// positions in the polygon.
class PolygonCutter
{
public:
  PolygonCutter(std::vector<Vector2> polygon, const ProgressObserver& progress)
    : Polygon(std::move(polygon)),
      Count(static_cast<std::int64_t>(this->Polygon.size())),
      Progress(progress)
  {
  }

  /// @returns none when the observer stopped it.
  std::vector<std::array<std::int64_t, 3>> Cut()
  {
    if (this->Count == 4)
    {
      this->CutQuad();
    }
    else if (this->Count == 3 || this->IsConvex())
    {
      this->CutFan();
    }
    else
    {
      this->ClipEars();
    }
    return std::move(this->Triangles);
  }

private:
  int Turn(std::int64_t a, std::int64_t b, std::int64_t c) const
  {
    return Orientation(this->Polygon[a].data(), this->Polygon[b].data(), this->Polygon[c].data());
  }

  /// Through its other diagonal only where that one is valid and 0-2 is not.
  void CutQuad()
  {
    const bool firstIsInside = this->Turn(0, 1, 2) > 0 && this->Turn(0, 2, 3) > 0;
    const bool secondIsInside = this->Turn(1, 2, 3) > 0 && this->Turn(1, 3, 0) > 0;
    if (secondIsInside && !firstIsInside)
    {
      this->Triangles = { { 0, 1, 3 }, { 1, 2, 3 } };
      return;
    }
    this->CutFan();
  }

  void CutFan()
  {
    for (std::int64_t i = 1; i + 1 < this->Count; ++i)
    {
      this->Triangles.push_back({ 0, i, i + 1 });
    }
  }

  /// Whether no corner turns right and no triangle of the fan is empty.
  bool IsConvex() const
  {
    for (std::int64_t i = 0; i < this->Count; ++i)
    {
      const std::int64_t next = (i + 1) % this->Count;
      if (this->Turn(i, next, (i + 2) % this->Count) < 0)
      {
        return false;
      }
      if (i > 0 && next > 0 && this->Turn(0, i, next) <= 0)
      {
        return false;
      }
    }
    return true;
  }

  void ClipEars()
  {
    this->LinkVertices();
    std::int64_t left = this->Count;
    std::int64_t vertex = 0;
    std::int64_t refused = 0;
    while (left > 3)
    {
      if (!this->MayGoOn(left))
      {
        this->Triangles.clear();
        return;
      }
      // A full round without an ear: the polygon crosses itself, or has no area. Any cut will do.
      if (refused < left && !this->IsEar(vertex))
      {
        vertex = this->Next[vertex];
        ++refused;
        continue;
      }
      vertex = this->Clip(vertex);
      --left;
      refused = 0;
    }
    this->Triangles.push_back({ this->Previous[vertex], vertex, this->Next[vertex] });
  }

  /// Asks the observer where a look for ears has gone through many vertices since it was last
  /// asked.
  bool MayGoOn(std::int64_t left)
  {
    constexpr std::int64_t VerticesBetweenCalls = std::int64_t(1) << 20; // some 20 ms
    this->Visited += left;
    if (!this->Progress || this->Visited < VerticesBetweenCalls)
    {
      return true;
    }
    this->Visited = 0;
    return this->Progress(1.0 - static_cast<double>(left) / static_cast<double>(this->Count));
  }

  void LinkVertices()
  {
    for (std::int64_t i = 0; i < this->Count; ++i)
    {
      this->Next.push_back((i + 1) % this->Count);
      this->Previous.push_back((i + this->Count - 1) % this->Count);
    }
  }

  /// Cuts the vertex off; the walk goes on beyond its neighbour, for rounder triangles than a
  /// fan's.
  std::int64_t Clip(std::int64_t vertex)
  {
    const std::int64_t previous = this->Previous[vertex];
    const std::int64_t next = this->Next[vertex];
    this->Triangles.push_back({ previous, vertex, next });
    this->Next[previous] = next;
    this->Previous[next] = previous;
    return this->Next[next];
  }

  bool IsEar(std::int64_t vertex) const
  {
    const std::int64_t previous = this->Previous[vertex];
    const std::int64_t next = this->Next[vertex];
    if (this->Turn(previous, vertex, next) <= 0)
    {
      return false;
    }
    for (std::int64_t i = this->Next[next]; i != previous; i = this->Next[i])
    {
      if (this->IsInside(i, { previous, vertex, next }))
      {
        return false;
      }
    }
    return true;
  }

  /// Whether the vertex lies in the closed triangle, other than at a corner of it.
  bool IsInside(std::int64_t vertex, const std::array<std::int64_t, 3>& triangle) const
  {
    for (int i = 0; i < 3; ++i)
    {
      const std::int64_t corner = triangle[i];
      if (this->Polygon[vertex] == this->Polygon[corner] ||
        this->Turn(corner, triangle[(i + 1) % 3], vertex) < 0)
      {
        return false;
      }
    }
    return true;
  }

  std::vector<Vector2> Polygon;
  std::int64_t Count;
  std::vector<std::int64_t> Next;
  std::vector<std::int64_t> Previous;
  std::vector<std::array<std::int64_t, 3>> Triangles;
  const ProgressObserver& Progress;
  std::int64_t Visited = 0; ///< Vertices, since the observer was last asked.
};

/// Exactly: whether the triangle's shadow along some axis has an area.
/// @param first the axis to look along first: where it decides, no other costs exact arithmetic.
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

bool SplitPolygon(const PointArray& points, const std::int64_t* ids, std::int64_t count,
  std::vector<std::int64_t>& triangles, const ProgressObserver& progress)
{
  PolygonCutter cutter(Project(points, ids, count), progress);
  const std::vector<std::array<std::int64_t, 3>> cut = cutter.Cut();
  for (const std::array<std::int64_t, 3>& triangle : cut)
  {
    for (std::int64_t position : triangle)
    {
      triangles.push_back(ids[position]);
    }
  }
  return !cut.empty();
}

void TriangleNormal(const PointArray& points, const std::int64_t ids[3], double normal[3])
{
  std::array<Vector3, 3> offsets;
  LoadScaledOffsets(points, ids, 3, 3, offsets);
  Vector3 area = AreaVector(offsets);
  const int axis = DominantAxis(area);
  // Twice: the first length of a needle's area vector may be so small that it has lost its bits.
  for (int pass = 0; pass < 2; ++pass)
  {
    const double length = pass == 0 ? std::abs(area[axis]) : std::hypot(area[0], area[1], area[2]);
    for (int i = 0; i < 3; ++i)
    {
      area[i] = length > 0.0 ? area[i] / length : 0.0;
    }
  }
  const bool isValid = std::isfinite(area[0] + area[1] + area[2]) && HasArea(points, ids, axis);
  for (int i = 0; i < 3; ++i)
  {
    normal[i] = isValid ? area[i] : 0.0;
  }
}

}
