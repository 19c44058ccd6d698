// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LawsonOracle.h"

#include <algorithm>

namespace delaunayflip
{

LawsonOracle::LawsonOracle(
  const OwnedMesh<double>& mesh, std::set<Edge> constraints, TieRuleKind rule)
  : Mesh(mesh),
    Constraints(std::move(constraints)),
    Rule(rule)
{
  for (std::size_t t = 0; t < mesh.Triangles.size(); t += 3)
  {
    this->Add(mesh.Triangles[t], mesh.Triangles[t + 1], mesh.Triangles[t + 2]);
  }
}

std::int64_t LawsonOracle::Run()
{
  std::int64_t flips = 0;
  while (this->FlipOne())
  {
    ++flips;
  }
  return flips;
}

TriangleSet LawsonOracle::GetTriangles() const
{
  std::vector<std::int32_t> triangles;
  for (const auto& [edge, opposite] : this->Opposites)
  {
    // Each triangle once: at the edge that starts at its smallest vertex.
    if (edge.first < edge.second && edge.first < opposite)
    {
      triangles.insert(triangles.end(), { edge.first, edge.second, opposite });
    }
  }
  return ToTriangleSet(triangles);
}

void LawsonOracle::Add(std::int32_t a, std::int32_t b, std::int32_t c)
{
  this->Opposites[{ a, b }] = c;
  this->Opposites[{ b, c }] = a;
  this->Opposites[{ c, a }] = b;
}

Point3 LawsonOracle::Get(std::int32_t id) const
{
  return { this->Mesh.Points[3 * id], this->Mesh.Points[3 * id + 1], 0.0 };
}

bool LawsonOracle::FlipOne()
{
  for (const auto& [edge, opposite] : this->Opposites)
  {
    const std::int32_t a = opposite;
    const std::int32_t p = edge.first;
    const std::int32_t q = edge.second;
    const auto twin = this->Opposites.find({ q, p });
    if (p > q || twin == this->Opposites.end() || this->Constraints.count(edge) != 0)
    {
      continue;
    }
    const std::int32_t b = twin->second;
    if (this->IsBad(a, p, q, b))
    {
      this->Opposites.erase(twin);
      this->Opposites.erase({ p, q });
      this->Add(a, p, b);
      this->Add(b, q, a);
      return true;
    }
  }
  return false;
}

bool LawsonOracle::IsBad(std::int32_t a, std::int32_t p, std::int32_t q, std::int32_t b) const
{
  const Point3 points[4] = { this->Get(a), this->Get(p), this->Get(q), this->Get(b) };
  const int sign = RationalInCircle(points[0], points[1], points[2], points[3]);
  if (sign != 0 || this->Rule == TieRuleKind::Keep)
  {
    return sign > 0;
  }
  // Of two tied diagonals, the one away from the lexicographically largest point stays.
  const Point3* largest = std::max_element(points, points + 4);
  return largest == &points[1] || largest == &points[2];
}

}
