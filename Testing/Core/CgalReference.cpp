// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CgalReference.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <map>
#include <utility>

namespace delaunayflip
{

namespace
{

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Vertex = CGAL::Triangulation_vertex_base_with_info_2<std::int32_t, Kernel>;
using Structure = CGAL::Triangulation_data_structure_2<Vertex>;
using Plain = CGAL::Triangulation_2<Kernel, Structure>;
using Delaunay = CGAL::Delaunay_triangulation_2<Kernel, Structure>;
using ConstrainedStructure =
  CGAL::Triangulation_data_structure_2<Vertex, CGAL::Constrained_triangulation_face_base_2<Kernel>>;
using ConstrainedDelaunay =
  CGAL::Constrained_Delaunay_triangulation_2<Kernel, ConstrainedStructure>;
using IndexedPoint = std::pair<Kernel::Point_2, std::int32_t>;

Kernel::Point_2 GetPoint(const PointArray& points, std::int64_t id)
{
  return { points.Get(id, 0), points.Get(id, 1) };
}

std::vector<IndexedPoint> IndexPoints(const PointArray& points)
{
  std::vector<IndexedPoint> indexed;
  for (std::int64_t i = 0; i < points.Count; ++i)
  {
    indexed.emplace_back(GetPoint(points, i), static_cast<std::int32_t>(i));
  }
  return indexed;
}

template <typename Triangulation>
std::vector<std::int32_t> GetTriangles(const Triangulation& triangulation)
{
  std::vector<std::int32_t> triangles;
  for (auto face : triangulation.finite_face_handles())
  {
    for (int i = 0; i < 3; ++i)
    {
      triangles.push_back(face->vertex(i)->info());
    }
  }
  return triangles;
}

}

TriangleSet MakeCgalDelaunay(const PointArray& points)
{
  const std::vector<IndexedPoint> indexed = IndexPoints(points);
  return ToTriangleSet(GetTriangles(Delaunay(indexed.begin(), indexed.end())));
}

TriangleSet MakeCgalConstrainedDelaunay(const TriangleMesh& mesh)
{
  ConstrainedDelaunay triangulation;
  std::vector<ConstrainedDelaunay::Vertex_handle> handles;
  for (const IndexedPoint& point : IndexPoints(mesh.Points))
  {
    handles.push_back(triangulation.insert(point.first));
    handles.back()->info() = point.second;
  }
  for (std::int64_t i = 0; i < mesh.NumberOfConstraintEdges; ++i)
  {
    triangulation.insert_constraint(
      handles[mesh.ConstraintEdges[2 * i]], handles[mesh.ConstraintEdges[2 * i + 1]]);
  }
  return ToTriangleSet(GetTriangles(triangulation));
}

std::int64_t CountCgalViolations(const TriangleMesh& mesh)
{
  std::map<std::pair<std::int64_t, std::int64_t>, std::int64_t> opposites;
  for (std::int64_t t = 0; t < mesh.Triangles.Count; ++t)
  {
    for (int slot = 0; slot < 3; ++slot)
    {
      opposites[{ mesh.Triangles.Get(t, slot), mesh.Triangles.Get(t, (slot + 1) % 3) }] =
        mesh.Triangles.Get(t, (slot + 2) % 3);
    }
  }
  const auto sideOfCircle = Kernel().side_of_oriented_circle_2_object();
  std::int64_t violated = 0;
  for (const auto& [edge, opposite] : opposites)
  {
    const auto twin = opposites.find({ edge.second, edge.first });
    if (edge.first < edge.second && twin != opposites.end())
    {
      violated += sideOfCircle(GetPoint(mesh.Points, edge.first),
                    GetPoint(mesh.Points, edge.second), GetPoint(mesh.Points, opposite),
                    GetPoint(mesh.Points, twin->second)) == CGAL::ON_POSITIVE_SIDE;
    }
  }
  return violated;
}

OwnedMesh<double> MakeSweptMesh(const std::vector<std::array<double, 2>>& points)
{
  std::vector<std::int32_t> order(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    order[i] = static_cast<std::int32_t>(i);
  }
  std::sort(order.begin(), order.end(),
    [&](std::int32_t a, std::int32_t b) { return points[a] < points[b]; });
  Plain triangulation;
  Plain::Face_handle hint;
  for (std::int32_t i : order)
  {
    const auto vertex = triangulation.insert({ points[i][0], points[i][1] }, hint);
    vertex->info() = i;
    hint = vertex->face();
  }
  OwnedMesh<double> mesh;
  for (const std::array<double, 2>& point : points)
  {
    mesh.Points.insert(mesh.Points.end(), { point[0], point[1], 0.0 });
  }
  mesh.Triangles = GetTriangles(triangulation);
  return mesh;
}

}
