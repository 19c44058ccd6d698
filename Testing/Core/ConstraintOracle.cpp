// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ConstraintOracle.h"

#include "CgalReference.h"
#include "ExactReference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace delaunayflip
{

namespace
{

Point3 GetPoint(const TriangleMesh& mesh, std::int64_t id)
{
  return { mesh.Points.Get(id, 0), mesh.Points.Get(id, 1), 0.0 };
}

bool CrossPoints(const Point3& a, const Point3& b, const Point3& c, const Point3& d)
{
  return RationalTurn(a, b, c) * RationalTurn(a, b, d) < 0 &&
    RationalTurn(c, d, a) * RationalTurn(c, d, b) < 0;
}

/// Coordinates up to some 10,000, so that determinants fit 64 bits.
using WholePoint = std::array<std::int64_t, 2>;

std::int64_t TurnWhole(const WholePoint& a, const WholePoint& b, const WholePoint& c)
{
  return (a[0] - c[0]) * (b[1] - c[1]) - (a[1] - c[1]) * (b[0] - c[0]);
}

bool AreApart(std::int64_t a, std::int64_t b) { return (a < 0 && b > 0) || (a > 0 && b < 0); }

bool CrossWhole(const WholePoint& a, const WholePoint& b, const WholePoint& c, const WholePoint& d)
{
  return AreApart(TurnWhole(a, b, c), TurnWhole(a, b, d)) &&
    AreApart(TurnWhole(c, d, a), TurnWhole(c, d, b));
}

/// Of a triangle that turns left.
bool IsInCircle(const WholePoint& a, const WholePoint& b, const WholePoint& c, const WholePoint& d)
{
  const auto lift = [&](const WholePoint& p)
  { return (p[0] - d[0]) * (p[0] - d[0]) + (p[1] - d[1]) * (p[1] - d[1]); };
  return lift(a) * TurnWhole(b, c, d) + lift(b) * TurnWhole(c, a, d) +
    lift(c) * TurnWhole(a, b, d) >
    0;
}

std::set<VertexPair> CollectEdges(const TriangleArray& triangles)
{
  std::set<VertexPair> edges;
  for (std::int64_t t = 0; t < triangles.Count; ++t)
  {
    for (int slot = 0; slot < 3; ++slot)
    {
      edges.insert(std::minmax({ triangles.Get(t, slot), triangles.Get(t, (slot + 1) % 3) }));
    }
  }
  return edges;
}

bool CrossAny(
  const TriangleMesh& mesh, const std::vector<VertexPair>& some, const std::vector<VertexPair>& all)
{
  return std::any_of(some.begin(), some.end(),
    [&](const VertexPair& a)
    {
      return std::any_of(
        all.begin(), all.end(), [&](const VertexPair& b) { return Cross(mesh, a, b); });
    });
}

/// Distinct points with whole coordinates from 0 to `size`, among them the corners.
std::vector<std::array<double, 2>> DrawLattice(
  std::size_t count, std::int32_t size, std::mt19937& random)
{
  const double last = size;
  std::set<std::array<double, 2>> points = { { 0, 0 }, { last, 0 }, { 0, last }, { last, last } };
  while (points.size() < count)
  {
    const double x = DrawIndex(random, size + 1);
    const double y = DrawIndex(random, size + 1);
    points.insert({ x, y });
  }
  std::vector<std::array<double, 2>> drawn(points.begin(), points.end());
  std::shuffle(drawn.begin(), drawn.end(), random);
  return drawn;
}
}

void ConstrainedMesh::Add(std::int64_t from, std::int64_t to, bool insert)
{
  this->Ends.insert(this->Ends.end(), { from, to });
  this->ToInsert.push_back(insert ? 1 : 0);
}

TriangleMesh ConstrainedMesh::View() const
{
  TriangleMesh mesh = this->Mesh.View();
  mesh.ConstraintEdges = this->Ends.data();
  mesh.NumberOfConstraintEdges = static_cast<std::int64_t>(this->ToInsert.size());
  mesh.ConstraintsToInsert = this->ToInsert.data();
  return mesh;
}

ConstrainedMesh DrawCase(std::size_t points, std::int32_t size, int constraints, std::uint32_t seed)
{
  std::mt19937 random(seed);
  ConstrainedMesh drawn;
  drawn.Mesh = MakeSweptMesh(DrawLattice(points, size, random));
  for (int i = 0; i < constraints; ++i)
  {
    const std::int64_t from = DrawIndex(random, drawn.Mesh.NumberOfPoints());
    drawn.Add(from, DrawIndex(random, drawn.Mesh.NumberOfPoints()));
  }
  return drawn;
}

ConstrainedMesh DropCrossing(const ConstrainedMesh& mesh)
{
  ConstrainedMesh kept;
  kept.Mesh = mesh.Mesh;
  std::vector<VertexPair> pieces;
  for (std::size_t i = 0; i < mesh.ToInsert.size(); ++i)
  {
    const std::int64_t* ends = mesh.Ends.data() + 2 * i;
    const std::vector<VertexPair> own = SplitAtVertices(mesh.View(), ends[0], ends[1]);
    if (ends[0] != ends[1] && !CrossAny(mesh.View(), own, pieces))
    {
      kept.Add(ends[0], ends[1], mesh.ToInsert[i] != 0);
      pieces.insert(pieces.end(), own.begin(), own.end());
    }
  }
  return kept;
}

std::vector<VertexPair> SplitAtVertices(
  const TriangleMesh& mesh, std::int64_t from, std::int64_t to)
{
  const Point3 a = GetPoint(mesh, from);
  const Point3 b = GetPoint(mesh, to);
  std::vector<std::int64_t> on;
  for (std::int64_t id = 0; id < mesh.Points.Count; ++id)
  {
    const Point3 p = GetPoint(mesh, id);
    if (RationalTurn(a, b, p) == 0 && std::min(a, b) <= p && p <= std::max(a, b))
    {
      on.push_back(id);
    }
  }
  std::sort(on.begin(), on.end(),
    [&](std::int64_t i, std::int64_t j) { return GetPoint(mesh, i) < GetPoint(mesh, j); });
  std::vector<VertexPair> pieces;
  for (std::size_t i = 1; i < on.size(); ++i)
  {
    pieces.emplace_back(on[i - 1], on[i]);
  }
  return pieces;
}

bool Cross(const TriangleMesh& mesh, const VertexPair& a, const VertexPair& b)
{
  return CrossPoints(GetPoint(mesh, a.first), GetPoint(mesh, a.second), GetPoint(mesh, b.first),
    GetPoint(mesh, b.second));
}

ExpectedInsertion PredictInsertion(const TriangleMesh& mesh)
{
  ExpectedInsertion expected;
  const std::set<VertexPair> edges = CollectEdges(mesh.Triangles);
  std::vector<VertexPair> missing;
  for (std::int64_t i = 0; i < mesh.NumberOfConstraintEdges; ++i)
  {
    const VertexPair ends =
      std::minmax({ mesh.ConstraintEdges[2 * i], mesh.ConstraintEdges[2 * i + 1] });
    const bool isKnown = std::find(missing.begin(), missing.end(), ends) != missing.end();
    if (edges.count(ends) > 0)
    {
      expected.Pieces.push_back(ends);
    }
    else if (!isKnown && ends.first != ends.second)
    {
      missing.push_back(ends);
    }
  }
  for (const VertexPair& ends : missing)
  {
    const std::vector<VertexPair> pieces = SplitAtVertices(mesh, ends.first, ends.second);
    const bool isRefused = CrossAny(mesh, pieces, expected.Pieces);
    ++(isRefused ? expected.Refused : expected.Inserted);
    if (!isRefused)
    {
      expected.Pieces.insert(expected.Pieces.end(), pieces.begin(), pieces.end());
    }
  }
  return expected;
}

void ExpectEdges(const std::vector<std::int32_t>& triangles, const std::vector<VertexPair>& edges)
{
  const std::set<VertexPair> all = CollectEdges(ViewTriangles(triangles));
  for (const VertexPair& edge : edges)
  {
    EXPECT_EQ(1u, all.count(std::minmax({ edge.first, edge.second })))
      << edge.first << "-" << edge.second;
  }
}

void ExpectConstrainedDelaunay(const TriangleMesh& mesh, const std::vector<VertexPair>& pieces)
{
  // Three times as large, so that the middle of a triangle has whole coordinates.
  const auto getThrice = [&](std::int64_t id) -> WholePoint
  {
    return { 3 * static_cast<std::int64_t>(mesh.Points.Get(id, 0)),
      3 * static_cast<std::int64_t>(mesh.Points.Get(id, 1)) };
  };
  for (std::int64_t t = 0; t < mesh.Triangles.Count; ++t)
  {
    const WholePoint a = getThrice(mesh.Triangles.Get(t, 0));
    const WholePoint b = getThrice(mesh.Triangles.Get(t, 1));
    const WholePoint c = getThrice(mesh.Triangles.Get(t, 2));
    const WholePoint middle = { (a[0] + b[0] + c[0]) / 3, (a[1] + b[1] + c[1]) / 3 };
    for (std::int64_t id = 0; id < mesh.Points.Count; ++id)
    {
      const WholePoint point = getThrice(id);
      const auto hides = [&](const VertexPair& piece)
      { return CrossWhole(middle, point, getThrice(piece.first), getThrice(piece.second)); };
      EXPECT_TRUE(!IsInCircle(a, b, c, point) || std::any_of(pieces.begin(), pieces.end(), hides))
        << "triangle " << t << " and point " << id;
    }
  }
}

double SumAreas(const TriangleMesh& mesh)
{
  double sum = 0.0;
  for (std::int64_t t = 0; t < mesh.Triangles.Count; ++t)
  {
    const Point3 a = GetPoint(mesh, mesh.Triangles.Get(t, 0));
    const Point3 b = GetPoint(mesh, mesh.Triangles.Get(t, 1));
    const Point3 c = GetPoint(mesh, mesh.Triangles.Get(t, 2));
    sum += (a[0] - c[0]) * (b[1] - c[1]) - (a[1] - c[1]) * (b[0] - c[0]);
  }
  return sum;
}

}
