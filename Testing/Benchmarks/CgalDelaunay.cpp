// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CgalDelaunay.h"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <chrono>

namespace delaunayflip
{

CgalTime TimeCgalDelaunay(const OwnedMesh<float>& mesh)
{
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  std::vector<Kernel::Point_2> points;
  points.reserve(static_cast<std::size_t>(mesh.NumberOfPoints()));
  for (std::int64_t i = 0; i < mesh.NumberOfPoints(); ++i)
  {
    points.emplace_back(mesh.Points[3 * i], mesh.Points[3 * i + 1]);
  }
  CGAL::Delaunay_triangulation_2<Kernel> triangulation;
  const auto start = std::chrono::steady_clock::now();
  triangulation.insert(points.begin(), points.end());
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  return { elapsed.count(), static_cast<std::int64_t>(triangulation.number_of_faces()) };
}

}
