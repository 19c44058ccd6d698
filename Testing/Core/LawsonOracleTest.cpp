// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CgalReference.h"
#include "ExactReference.h"
#include "MeshAudit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace delaunayflip
{
namespace
{

using Edge = std::pair<std::int32_t, std::int32_t>;

/// Lawson's algorithm in rational arithmetic, one flip at a time, until none is left: the obvious
/// way to the mesh that the engine must reach.
class LawsonOracle
{
public:
  LawsonOracle(const OwnedMesh<double>& mesh, std::set<Edge> constraints, TieRuleKind rule)
    : Mesh(mesh),
      Constraints(std::move(constraints)),
      Rule(rule)
  {
    for (std::size_t t = 0; t < mesh.Triangles.size(); t += 3)
    {
      this->Add(mesh.Triangles[t], mesh.Triangles[t + 1], mesh.Triangles[t + 2]);
    }
  }

  std::int64_t Run()
  {
    std::int64_t flips = 0;
    while (this->FlipOne())
    {
      ++flips;
    }
    return flips;
  }

  TriangleSet GetTriangles() const
  {
    std::vector<std::int32_t> triangles;
    for (const auto& [edge, opposite] : this->Opposites)
    {
      // Each triangle once, at the edge that leaves its smallest vertex.
      if (edge.first < edge.second && edge.first < opposite)
      {
        triangles.insert(triangles.end(), { edge.first, edge.second, opposite });
      }
    }
    return ToTriangleSet(triangles);
  }

private:
  void Add(std::int32_t a, std::int32_t b, std::int32_t c)
  {
    this->Opposites[{ a, b }] = c;
    this->Opposites[{ b, c }] = a;
    this->Opposites[{ c, a }] = b;
  }

  Point3 Get(std::int32_t id) const
  {
    return { this->Mesh.Points[3 * id], this->Mesh.Points[3 * id + 1], 0.0 };
  }

  bool FlipOne()
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

  /// Triangles (a, p, q) and (b, q, p), both counter-clockwise.
  bool IsBad(std::int32_t a, std::int32_t p, std::int32_t q, std::int32_t b) const
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

  const OwnedMesh<double>& Mesh;
  std::set<Edge> Constraints;
  TieRuleKind Rule;
  std::map<Edge, std::int32_t> Opposites;
};

/// Random distinct points of a small lattice with all its ties, triangulated anyhow.
OwnedMesh<double> DrawMesh(std::mt19937& random)
{
  const int size = 3 + DrawIndex(random, 6);
  std::set<std::array<double, 2>> points;
  const int count = 3 + DrawIndex(random, size * size);
  for (int i = 0; i < count; ++i)
  {
    points.insert({ double(DrawIndex(random, size)), double(DrawIndex(random, size)) });
  }
  return MakeSweptMesh({ points.begin(), points.end() });
}

/// About one in eight interior edges.
std::set<Edge> DrawConstraints(const OwnedMesh<double>& mesh, std::mt19937& random)
{
  std::set<Edge> constraints;
  for (std::size_t corner = 0; corner < mesh.Triangles.size(); ++corner)
  {
    const std::int32_t from = mesh.Triangles[corner];
    const std::int32_t to = mesh.Triangles[corner % 3 == 2 ? corner - 2 : corner + 1];
    if (DrawIndex(random, 8) == 0)
    {
      constraints.insert(std::minmax({ from, to }));
    }
  }
  return constraints;
}

FlipResult FlipConstrained(
  const OwnedMesh<double>& mesh, const std::set<Edge>& constraints, TieRuleKind rule)
{
  std::vector<std::int64_t> ids;
  for (const Edge& edge : constraints)
  {
    ids.insert(ids.end(), { edge.first, edge.second });
  }
  TriangleMesh view = mesh.View();
  view.ConstraintEdges = ids.data();
  view.NumberOfConstraintEdges = static_cast<std::int64_t>(constraints.size());
  FlipOptions options;
  options.TieRule = rule;
  FlipResult result = Flip(view, options);
  EXPECT_EQ(0, CountNonDelaunayEdges(WithTriangles(view, result.Triangles), options));
  return result;
}

TEST(LawsonOracle, CanonicalMeshesAreTheSameTriangleForTriangle)
{
  std::mt19937 random(91);
  for (int i = 0; i < 400 / Reduction; ++i)
  {
    const OwnedMesh<double> mesh = DrawMesh(random);
    const std::set<Edge> constraints = i % 2 ? DrawConstraints(mesh, random) : std::set<Edge>();
    LawsonOracle oracle(mesh, constraints, TieRuleKind::Canonical);
    oracle.Run();
    const FlipResult result = FlipConstrained(mesh, constraints, TieRuleKind::Canonical);
    ASSERT_EQ(oracle.GetTriangles(), ToTriangleSet(result.Triangles)) << "mesh " << i;
  }
}

/// With ties kept the end depends on the order of flips, but nothing is left for the oracle to do.
TEST(LawsonOracle, FindsNothingLeftToFlip)
{
  std::mt19937 random(92);
  for (int i = 0; i < 400 / Reduction; ++i)
  {
    OwnedMesh<double> mesh = DrawMesh(random);
    const std::set<Edge> constraints = i % 2 ? DrawConstraints(mesh, random) : std::set<Edge>();
    LawsonOracle before(mesh, constraints, TieRuleKind::Keep);
    const FlipResult result = FlipConstrained(mesh, constraints, TieRuleKind::Keep);
    EXPECT_EQ(before.Run() > 0, result.Report.TotalFlips > 0) << "mesh " << i;
    mesh.Triangles = result.Triangles;
    LawsonOracle after(mesh, constraints, TieRuleKind::Keep);
    ASSERT_EQ(0, after.Run()) << "mesh " << i;
  }
}

}
}
