// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LawsonOracle.h"

#include "CgalReference.h"
#include "MeshAudit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace delaunayflip
{
namespace
{

using Edge = LawsonOracle::Edge;

/// Random distinct points of a small lattice, with many ties, and some triangulation of them.
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

/// If ties are kept, the result depends on the order of flips, but nothing is left for the oracle.
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
