// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SurfaceChange.h"

#include "CornerMesh.h"
#include "DelaunayFlip.h"
#include "PaperTests.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_set>

namespace delaunayflip
{

namespace
{

using Kernel = CGAL::Simple_cartesian<double>;
using Faces = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Faces::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;
using EdgeSet = std::unordered_set<std::uint64_t>;

constexpr double Pi = 3.14159265358979323846;

std::uint64_t MakeKey(std::int64_t p, std::int64_t q)
{
  const auto [low, high] = std::minmax(p, q);
  return std::uint64_t(low) << 32 | std::uint64_t(high);
}

Kernel::Point_3 GetPoint(const OwnedMesh<double>& mesh, std::int64_t i)
{
  return { mesh.Points[3 * i], mesh.Points[3 * i + 1], mesh.Points[3 * i + 2] };
}

Faces MakeFaces(const OwnedMesh<double>& mesh, const std::vector<std::int32_t>& ids)
{
  Faces faces;
  for (std::size_t t = 0; t < ids.size(); t += 3)
  {
    const Kernel::Triangle_3 face(
      GetPoint(mesh, ids[t]), GetPoint(mesh, ids[t + 1]), GetPoint(mesh, ids[t + 2]));
    if (!face.is_degenerate())
    {
      faces.push_back(face);
    }
  }
  return faces;
}

EdgeSet ListEdges(const std::vector<std::int32_t>& ids)
{
  EdgeSet edges;
  for (std::size_t t = 0; t < ids.size(); t += 3)
  {
    for (std::size_t slot = 0; slot < 3; ++slot)
    {
      edges.insert(MakeKey(ids[t + slot], ids[t + (slot + 1) % 3]));
    }
  }
  return edges;
}

/// The largest squared distance from the middle of an edge of `edges` that is not in `others`.
double FindSquaredDistance(const OwnedMesh<double>& mesh, const EdgeSet& edges,
  const EdgeSet& others, const std::vector<std::int32_t>& surface)
{
  const Faces faces = MakeFaces(mesh, surface);
  const Tree tree(faces.begin(), faces.end());
  double largest = 0.0;
  for (const std::uint64_t edge : edges)
  {
    if (others.count(edge) == 0)
    {
      const auto p = GetPoint(mesh, static_cast<std::int64_t>(edge >> 32));
      const auto q = GetPoint(mesh, static_cast<std::int64_t>(edge & 0xffffffffu));
      // Both surfaces contain p, so the nearest point is at most that far away.
      largest = std::max(largest, tree.squared_distance(CGAL::midpoint(p, q), p));
    }
  }
  return largest;
}

double FindVolume(const OwnedMesh<double>& mesh, const std::vector<std::int32_t>& ids)
{
  double sum = 0.0;
  for (std::size_t t = 0; t < ids.size(); t += 3)
  {
    sum += CGAL::volume(CGAL::ORIGIN + Kernel::Vector_3(0, 0, 0), GetPoint(mesh, ids[t]),
      GetPoint(mesh, ids[t + 1]), GetPoint(mesh, ids[t + 2]));
  }
  return sum;
}

double FindDiagonal(const OwnedMesh<double>& mesh)
{
  double squared = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::size_t i = axis; i < mesh.Points.size(); i += 3)
    {
      low = std::min(low, mesh.Points[i]);
      high = std::max(high, mesh.Points[i]);
    }
    squared += (high - low) * (high - low);
  }
  return std::sqrt(squared);
}

}

SurfaceChange MeasureChange(const OwnedMesh<double>& before, const std::vector<std::int32_t>& after)
{
  const EdgeSet old = ListEdges(before.Triangles);
  const EdgeSet current = ListEdges(after);
  const double there = FindSquaredDistance(before, current, old, before.Triangles);
  const double back = FindSquaredDistance(before, old, current, after);
  const double volume = FindVolume(before, before.Triangles);
  return { std::sqrt(std::max(there, back)) / FindDiagonal(before),
    (FindVolume(before, after) - volume) / volume };
}

ViolationReasons FindReasons(const OwnedMesh<double>& before,
  const std::vector<std::int32_t>& after, const FlipOptions& options, double tolerance)
{
  const std::vector<std::int64_t> fixedIds = FindFixedEdges(before.View(), options);
  EdgeSet fixed;
  for (std::size_t i = 0; i < fixedIds.size(); i += 2)
  {
    fixed.insert(MakeKey(fixedIds[i], fixedIds[i + 1]));
  }
  const EdgeSet edges = ListEdges(after);
  const CornerMesh mesh(after);
  const OppositeAngleTest<double> test{ Pi + tolerance };
  const auto at = [&](std::int32_t corner)
  {
    const double* x = &before.Points[3 * std::size_t(after[corner])];
    return PaperPoint3<double>{ x[0], x[1], x[2], 0.0 };
  };
  ViolationReasons reasons;
  for (std::int32_t corner = 0; corner < mesh.CountCorners(); ++corner)
  {
    const std::int32_t twin = mesh.Twins[corner];
    const std::int32_t next = CornerMesh::Next(corner), previous = CornerMesh::Previous(corner);
    if (!mesh.IsInterior(corner) || !test.IsBad(at(next), at(previous), at(corner), at(twin)))
    {
      continue;
    }
    const auto a = at(corner), b = at(twin), p = at(next), q = at(previous);
    const auto quad = Cross(q - p, a - b);
    const bool folds =
      !(Dot(Cross(p - a, b - a), quad) > 0.0) || !(Dot(Cross(q - b, a - b), quad) > 0.0);
    const bool isFixed = fixed.count(MakeKey(after[next], after[previous])) != 0;
    const bool isDuplicate = edges.count(MakeKey(after[corner], after[twin])) != 0;
    ++(isFixed        ? reasons.Fixed
        : isDuplicate ? reasons.Duplicate
        : folds       ? reasons.Fold
                      : reasons.Other);
  }
  return reasons;
}

}
