// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Outline.h"

#include "SurfaceAngles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

namespace delaunayflip
{

namespace
{
class Remover
{
public:
  Remover(const PointMeshView& mesh, const std::vector<SegmentEdge>& segments)
    : Mesh(mesh),
      Segments(segments),
      IsRemoved(mesh.NumberOfTriangles, 0)
  {
  }

  /// By how many rings each triangle is enclosed: a flood from the hull inwards.
  void RemoveOutside(OutlineKind outline)
  {
    // What is added on the way from side 1 of an edge to side 0.
    std::vector<std::int32_t> steps(this->Mesh.NumberOfEdges, 0);
    for (const SegmentEdge& segment : this->Segments)
    {
      const bool isUp = segment.IsOnLeft == (segment.Side % 2 == 0);
      steps[EdgeOf(segment.Side)] += segment.Ring < 0 ? 0 : (isUp ? 1 : -1);
    }
    constexpr std::int32_t Unknown = INT32_MIN;
    std::vector<std::int32_t> depths(this->Mesh.NumberOfTriangles, Unknown);
    std::vector<TriangleId> stack;
    const auto reach = [&](HalfEdgeId side, std::int32_t from)
    {
      const CornerId corner = this->Mesh.Edges.CornerOfHalfEdge[side];
      if (corner != NoCorner && depths[TriangleOf(corner)] == Unknown)
      {
        const std::int32_t step = steps[EdgeOf(side)];
        depths[TriangleOf(corner)] = from + (side % 2 == 0 ? step : -step);
        stack.push_back(TriangleOf(corner));
      }
    };
    for (HalfEdgeId side = 0; side < 2 * this->Mesh.NumberOfEdges; ++side)
    {
      if (this->Mesh.Edges.CornerOfHalfEdge[side ^ 1u] == NoCorner)
      {
        reach(side, 0);
      }
    }
    while (!stack.empty())
    {
      const TriangleId triangle = stack.back();
      stack.pop_back();
      for (const HalfEdgeId side : this->Mesh.Edges.Triangles[triangle].HalfEdges)
      {
        reach(side ^ 1u, depths[triangle]);
      }
    }
    const bool hasLeftRings = this->HasLeftRings();
    for (std::size_t t = 0; t < depths.size(); ++t)
    {
      const bool isInside = outline == OutlineKind::EvenOdd
        ? depths[t] % 2 != 0
        : depths[t] > 0 || (!hasLeftRings && depths[t] == 0);
      this->IsRemoved[t] = isInside ? 0 : 1;
    }
  }

  /// Removes what can be reached from the seeds without crossing a segment. @returns how many seeds
  /// are in no triangle.
  std::int64_t RemoveHoles(const double* seeds, std::int64_t count)
  {
    std::vector<TriangleId> stack = this->FindTriangles(seeds, count);
    const std::int64_t outside = std::count(stack.begin(), stack.end(), NoTriangle);
    stack.erase(std::remove(stack.begin(), stack.end(), NoTriangle), stack.end());
    while (!stack.empty())
    {
      const TriangleId triangle = stack.back();
      stack.pop_back();
      this->IsRemoved[triangle] = 1;
      for (const HalfEdgeId side : this->Mesh.Edges.Triangles[triangle].HalfEdges)
      {
        const CornerId across = this->Mesh.Edges.CornerOfHalfEdge[side ^ 1u];
        if (!this->Mesh.IsFixed(side) && this->IsRemoved[TriangleOf(across)] == 0)
        {
          stack.push_back(TriangleOf(across));
        }
      }
    }
    return outside;
  }

  /// Removes large triangles without segments.
  void RemoveLarge(double alpha, double longestEdge)
  {
    std::vector<unsigned char> isSegment(this->Mesh.NumberOfEdges, 0);
    for (const SegmentEdge& segment : this->Segments)
    {
      isSegment[EdgeOf(segment.Side)] = 1;
    }
    for (std::int64_t t = 0; t < this->Mesh.NumberOfTriangles; ++t)
    {
      const TriangleRecord& triangle = this->Mesh.Edges.Triangles[t];
      const bool stays = std::any_of(std::begin(triangle.HalfEdges), std::end(triangle.HalfEdges),
        [&](HalfEdgeId side) { return isSegment[EdgeOf(side)] != 0; });
      if (!stays && this->IsLarge(triangle, alpha, longestEdge))
      {
        this->IsRemoved[t] = 1;
      }
    }
  }

  std::int64_t CountRemoved() const
  {
    return std::count(this->IsRemoved.begin(), this->IsRemoved.end(), 1);
  }

  /// Numbers what is left in the order of the slots, and measures it.
  void Number(KeptTriangles& kept) const
  {
    const std::int64_t triangles = this->Mesh.NumberOfTriangles;
    kept.Numbers.assign(triangles, 0);
    kept.SquaredCotangent = -INFINITY;
    std::vector<unsigned char> isUsed(this->Mesh.NumberOfPlaces, 0);
    for (std::int64_t t = 0; t < triangles; ++t)
    {
      const TriangleRecord& triangle = this->Mesh.Edges.Triangles[t];
      kept.Numbers[triangle.InputTriangle] = this->IsRemoved[t];
      if (this->IsRemoved[t] == 0)
      {
        const std::array<Vector3, 3> corners = this->GetCorners(triangle);
        kept.SquaredCotangent = std::max(
          kept.SquaredCotangent, LargestSquaredCotangent(corners[0], corners[1], corners[2]));
        for (const VertexId vertex : triangle.Vertices)
        {
          isUsed[vertex] = 1;
        }
      }
    }
    for (std::int32_t& number : kept.Numbers)
    {
      number = number != 0 ? -1 : static_cast<std::int32_t>(kept.Count++);
    }
    for (std::int64_t e = 0; e < this->Mesh.NumberOfEdges; ++e)
    {
      const CornerId* corners = this->Mesh.Edges.CornerOfHalfEdge + 2 * e;
      int sides = 0;
      for (int side = 0; side < 2; ++side)
      {
        sides +=
          corners[side] != NoCorner && this->IsRemoved[TriangleOf(corners[side])] == 0 ? 1 : 0;
      }
      kept.Edges += sides > 0 ? 1 : 0;
      kept.Boundary += sides == 1 ? 1 : 0;
    }
    kept.EulerCharacteristic =
      std::count(isUsed.begin(), isUsed.end(), 1) - kept.Edges + kept.Count;
  }

private:
  /// Whether a ring turns counter-clockwise, by its area.
  bool HasLeftRings() const
  {
    std::map<std::int32_t, double> areas;
    const PlanePoint origin = this->Mesh.GetPoint(0);
    for (const SegmentEdge& segment : this->Segments)
    {
      const PlanePoint start = this->Mesh.GetPoint(this->Mesh.GetStart(segment.Side));
      const PlanePoint end = this->Mesh.GetPoint(this->Mesh.GetEnd(segment.Side));
      const double area =
        (start.U - origin.U) * (end.V - origin.V) - (start.V - origin.V) * (end.U - origin.U);
      areas[segment.Ring] += segment.IsOnLeft ? area : -area;
    }
    return std::any_of(areas.begin(), areas.end(),
      [](const auto& ring) { return ring.first >= 0 && ring.second > 0.0; });
  }

  std::array<Vector3, 3> GetCorners(const TriangleRecord& triangle) const
  {
    std::array<Vector3, 3> corners;
    for (int slot = 0; slot < 3; ++slot)
    {
      const PlanePoint place = this->Mesh.GetPoint(triangle.Vertices[slot]);
      corners[slot] = { place.U, place.V, 0.0 };
    }
    return corners;
  }

  bool IsLarge(const TriangleRecord& triangle, double alpha, double longestEdge) const
  {
    const auto [a, b, c] = this->GetCorners(triangle);
    const double ab = std::hypot(b.X - a.X, b.Y - a.Y);
    const double bc = std::hypot(c.X - b.X, c.Y - b.Y);
    const double ca = std::hypot(a.X - c.X, a.Y - c.Y);
    if (longestEdge > 0.0 && std::max({ ab, bc, ca }) > longestEdge)
    {
      return true;
    }
    // The circumradius is half of a side over the sine of the opposite angle.
    const double sine =
      ((b.X - a.X) / ab) * ((c.Y - a.Y) / ca) - ((b.Y - a.Y) / ab) * ((c.X - a.X) / ca);
    return alpha > 0.0 && !(0.5 * bc <= alpha * sine);
  }

  /// Of each seed the triangle that it is in, of several the first; NoTriangle if it is in none.
  std::vector<TriangleId> FindTriangles(const double* seeds, std::int64_t count) const
  {
    std::vector<std::int64_t> order(count); // by x
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(),
      [&](std::int64_t a, std::int64_t b) { return seeds[2 * a] < seeds[2 * b]; });
    std::vector<TriangleId> found(count, NoTriangle);
    for (std::int64_t t = 0; t < this->Mesh.NumberOfTriangles; ++t)
    {
      PlanePoint corners[3];
      for (int slot = 0; slot < 3; ++slot)
      {
        corners[slot] = this->Mesh.GetPoint(this->Mesh.Edges.Triangles[t].Vertices[slot]);
      }
      const auto [left, right] = std::minmax({ corners[0].U, corners[1].U, corners[2].U });
      auto next = std::lower_bound(order.begin(), order.end(), left,
        [&](std::int64_t seed, double x) { return seeds[2 * seed] < x; });
      for (; next != order.end() && seeds[2 * *next] <= right; ++next)
      {
        const PlanePoint seed = { seeds[2 * *next], seeds[2 * *next + 1], 0.0 };
        bool isInside = found[*next] == NoTriangle;
        for (int slot = 0; slot < 3 && isInside; ++slot)
        {
          isInside = FindOrientation(corners[slot], corners[NextSlot(slot)], seed) >= 0;
        }
        found[*next] = isInside ? static_cast<TriangleId>(t) : found[*next];
      }
    }
    return found;
  }

  const PointMeshView& Mesh;
  const std::vector<SegmentEdge>& Segments;
  std::vector<unsigned char> IsRemoved;
};
}

bool MayRemove(const PointInput& input, const PointOptions& options)
{
  return input.Rings || input.NumberOfHoleSeeds > 0 || options.Alpha > 0.0 ||
    options.LongestEdge > 0.0;
}

KeptTriangles KeepTriangles(const PointMeshView& mesh, const std::vector<SegmentEdge>& segments,
  const PointInput& input, const PointOptions& options)
{
  KeptTriangles kept;
  Remover remover(mesh, segments);
  if (std::any_of(segments.begin(), segments.end(),
        [](const SegmentEdge& segment) { return segment.Ring >= 0; }))
  {
    remover.RemoveOutside(options.Outline);
  }
  if (input.NumberOfHoleSeeds > 0)
  {
    kept.SeedsOutside = remover.RemoveHoles(input.HoleSeeds, input.NumberOfHoleSeeds);
  }
  kept.Outside = remover.CountRemoved();
  if (options.Alpha > 0.0 || options.LongestEdge > 0.0)
  {
    remover.RemoveLarge(options.Alpha, options.LongestEdge);
  }
  kept.Large = remover.CountRemoved() - kept.Outside;
  remover.Number(kept);
  return kept;
}

}
