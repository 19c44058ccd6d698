// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CgalDelaunay.h"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <chrono>
#include <utility>

namespace delaunayflip
{

namespace
{

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

Kernel::Point_2 GetPoint(const OwnedMesh<float>& mesh, std::int64_t i)
{
  return { mesh.Points[3 * i], mesh.Points[3 * i + 1] };
}

}

CgalTime TimeCgalDelaunay(const OwnedMesh<float>& mesh)
{
  std::vector<Kernel::Point_2> points;
  points.reserve(static_cast<std::size_t>(mesh.NumberOfPoints()));
  for (std::int64_t i = 0; i < mesh.NumberOfPoints(); ++i)
  {
    points.push_back(GetPoint(mesh, i));
  }
  CGAL::Delaunay_triangulation_2<Kernel> triangulation;
  const auto start = std::chrono::steady_clock::now();
  triangulation.insert(points.begin(), points.end());
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  return { elapsed.count(), static_cast<std::int64_t>(triangulation.number_of_faces()) };
}

std::vector<std::int32_t> MakeCgalTriangles(const OwnedMesh<float>& mesh)
{
  using Vertex = CGAL::Triangulation_vertex_base_with_info_2<std::int32_t, Kernel>;
  using Structure = CGAL::Triangulation_data_structure_2<Vertex>;
  std::vector<std::pair<Kernel::Point_2, std::int32_t>> points;
  for (std::int64_t i = 0; i < mesh.NumberOfPoints(); ++i)
  {
    points.emplace_back(GetPoint(mesh, i), static_cast<std::int32_t>(i));
  }
  const CGAL::Delaunay_triangulation_2<Kernel, Structure> delaunay(points.begin(), points.end());
  std::vector<std::int32_t> triangles;
  for (const auto face : delaunay.finite_face_handles())
  {
    for (int slot = 0; slot < 3; ++slot)
    {
      triangles.push_back(face->vertex(slot)->info());
    }
  }
  return triangles;
}

}
