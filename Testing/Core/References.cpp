// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "References.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#if __has_include(<gmp.h>)
#include <CGAL/Gmpq.h>
#else
#include <boost/multiprecision/cpp_int.hpp>
#endif

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace delaunayflip
{

OppositeMap FindOpposites(const TriangleArray& triangles)
{
  OppositeMap opposites;
  for (std::int64_t t = 0; t < triangles.Count; ++t)
  {
    for (int slot = 0; slot < 3; ++slot)
    {
      opposites[{ triangles.Get(t, slot), triangles.Get(t, (slot + 1) % 3) }] =
        triangles.Get(t, (slot + 2) % 3);
    }
  }
  return opposites;
}

std::set<VertexPair> ToEdges(const std::vector<std::int64_t>& ids)
{
  std::set<VertexPair> edges;
  for (std::size_t i = 0; i < ids.size(); i += 2)
  {
    edges.insert(Sorted(ids[i], ids[i + 1]));
  }
  return edges;
}

EdgeMap CollectEdges(const TriangleArray& triangles)
{
  EdgeMap edges;
  for (std::int64_t t = 0; t < triangles.Count; ++t)
  {
    const std::set<std::int64_t> corners = { triangles.Get(t, 0), triangles.Get(t, 1),
      triangles.Get(t, 2) };
    for (int slot = 0; slot < 3 && corners.size() == 3; ++slot)
    {
      edges[Sorted(triangles.Get(t, slot), triangles.Get(t, (slot + 1) % 3))].push_back(t);
    }
  }
  return edges;
}

//------------------------------------------------------------------------------
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
  const auto sideOfCircle = Kernel().side_of_oriented_circle_2_object();
  const auto get = [&](std::int64_t id) { return GetPoint(mesh.Points, id); };
  return CountEdges(FindOpposites(mesh.Triangles),
    [&](std::int64_t a, std::int64_t p, std::int64_t q, std::int64_t b)
    { return sideOfCircle(get(p), get(q), get(a), get(b)) == CGAL::ON_POSITIVE_SIDE; });
}

OwnedMesh<double> ToMesh(const Places& points, const std::vector<std::int32_t>& triangles)
{
  OwnedMesh<double> mesh{ {}, triangles };
  for (const std::array<double, 2>& point : points)
  {
    mesh.Points.insert(mesh.Points.end(), { point[0], point[1], 0.0 });
  }
  return mesh;
}

OwnedMesh<double> MakeSweptMesh(const Places& points)
{
  std::vector<std::int32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0);
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
  return ToMesh(points, GetTriangles(triangulation));
}

Places DrawDistinct(std::mt19937& random, int count, int columns, int rows)
{
  std::set<std::array<double, 2>> points;
  for (int i = 0; i < count; ++i)
  {
    const double x = DrawIndex(random, columns);
    points.insert({ x, double(DrawIndex(random, rows)) });
  }
  return { points.begin(), points.end() };
}

//------------------------------------------------------------------------------
namespace
{

#if __has_include(<gmp.h>)
using Rational = CGAL::Gmpq;
#else
/// A number with a denominator that is a power of two, as all sums and products of doubles have; so
/// no common divisor has to be found.
class Rational
{
public:
  Rational(double value)
  {
    const double fraction = std::frexp(value, &this->Exponent);
    this->Mantissa = static_cast<std::int64_t>(std::ldexp(fraction, 53));
    this->Exponent -= 53;
  }

  Rational operator+(const Rational& other) const
  {
    Rational result = *this;
    return result += other;
  }

  Rational operator-(const Rational& other) const { return *this + other * Rational(-1); }

  Rational operator*(const Rational& other) const
  {
    Rational result = *this;
    result.Mantissa *= other.Mantissa;
    result.Exponent += other.Exponent;
    return result;
  }

  Rational& operator+=(const Rational& other)
  {
    const int exponent = std::min(this->Exponent, other.Exponent);
    this->Mantissa <<= this->Exponent - exponent;
    this->Mantissa += Integer(other.Mantissa << (other.Exponent - exponent));
    this->Exponent = exponent;
    return *this;
  }

  bool operator<(const Rational& other) const { return (*this - other).Mantissa < 0; }
  bool operator>(const Rational& other) const { return other < *this; }

private:
  using Integer = boost::multiprecision::number<boost::multiprecision::cpp_int_backend<>,
    boost::multiprecision::et_off>;

  Integer Mantissa;
  int Exponent = 0;
};
#endif
using RationalVector = std::array<Rational, 3>;

RationalVector Subtract(const Point3& p, const Point3& origin)
{
  return { Rational(p[0]) - Rational(origin[0]), Rational(p[1]) - Rational(origin[1]),
    Rational(p[2]) - Rational(origin[2]) };
}

Rational Dot(const RationalVector& a, const RationalVector& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

RationalVector Cross(const RationalVector& a, const RationalVector& b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

Rational Determinant(const RationalVector& a, const RationalVector& b, const RationalVector& c)
{
  return Dot(a, Cross(b, c));
}

int Sign(const Rational& value) { return (value > 0 ? 1 : 0) - (value < 0 ? 1 : 0); }

/// (x, y, lift) of p relative to d. Both lifts are computed first, then subtracted.
RationalVector LiftedDifference(const Point3& p, const Point3& d, bool tilted)
{
  RationalVector result = Subtract(p, d);
  result[2] = Rational(0);
  for (int axis = 0; axis < (tilted ? 3 : 2); ++axis)
  {
    result[2] += Rational(p[axis]) * Rational(p[axis]) - Rational(d[axis]) * Rational(d[axis]);
  }
  return result;
}

Point3 GetPoint(const TriangleMesh& mesh, std::int64_t id)
{
  return { mesh.Points.Get(id, 0), mesh.Points.Get(id, 1), mesh.Points.Get(id, 2) };
}

/// Quad a, p, q, b has the triangles (a, p, q) and (b, q, p). The angles at a and b sum to more
/// than pi if sin(A + B) < 0. Sines are positive multiples of the lengths of cross products, which
/// in one plane can be compared along any vector parallel to the normal.
bool IsViolated(const std::array<Point3, 4>& quad)
{
  const RationalVector ap = Subtract(quad[1], quad[0]);
  const RationalVector aq = Subtract(quad[2], quad[0]);
  const RationalVector bp = Subtract(quad[1], quad[3]);
  const RationalVector bq = Subtract(quad[2], quad[3]);
  const RationalVector normalA = Cross(ap, aq);
  const RationalVector normalB = Cross(bq, bp);
  const RationalVector normal = { normalA[0] + normalB[0], normalA[1] + normalB[1],
    normalA[2] + normalB[2] };
  return Dot(normalA, normal) * Dot(bp, bq) + Dot(ap, aq) * Dot(normalB, normal) < Rational(0);
}

}

int RationalTurn(const Point3& a, const Point3& b, const Point3& c)
{
  const RationalVector p = Subtract(a, c);
  const RationalVector q = Subtract(b, c);
  return Sign(p[0] * q[1] - p[1] * q[0]);
}

int RationalOrientation3D(const Point3& a, const Point3& b, const Point3& c, const Point3& d)
{
  return Sign(Determinant(Subtract(a, d), Subtract(b, d), Subtract(c, d)));
}

int RationalInCircle(
  const Point3& a, const Point3& b, const Point3& c, const Point3& d, bool tilted)
{
  return Sign(Determinant(LiftedDifference(a, d, tilted), LiftedDifference(b, d, tilted),
    LiftedDifference(c, d, tilted)));
}

std::int64_t CountRationalViolations(const TriangleMesh& mesh)
{
  return CountEdges(FindOpposites(mesh.Triangles),
    [&](std::int64_t a, std::int64_t p, std::int64_t q, std::int64_t b)
    {
      return IsViolated(
        { GetPoint(mesh, a), GetPoint(mesh, p), GetPoint(mesh, q), GetPoint(mesh, b) });
    });
}

TriangleTurns CountTurns(const TriangleMesh& mesh)
{
  TriangleTurns counts;
  for (std::int64_t t = 0; t < mesh.Triangles.Count; ++t)
  {
    const int turn = RationalTurn(GetPoint(mesh, mesh.Triangles.Get(t, 0)),
      GetPoint(mesh, mesh.Triangles.Get(t, 1)), GetPoint(mesh, mesh.Triangles.Get(t, 2)));
    ++(turn > 0 ? counts.Left : turn < 0 ? counts.Right : counts.Straight);
  }
  return counts;
}

std::int64_t FlipByLawson(
  OwnedMesh<double>& mesh, const std::set<VertexPair>& constraints, TieRuleKind rule)
{
  const auto isBad = [&](std::int64_t a, std::int64_t p, std::int64_t q, std::int64_t b)
  {
    const TriangleMesh view = mesh.View();
    const Point3 points[4] = { GetPoint(view, a), GetPoint(view, p), GetPoint(view, q),
      GetPoint(view, b) };
    const int sign = RationalInCircle(points[0], points[1], points[2], points[3]);
    // If two diagonals tie, the one away from the lexicographically largest point stays.
    const Point3* largest = std::max_element(points, points + 4);
    const bool isWrongTie = rule == TieRuleKind::Canonical && sign == 0 &&
      (largest == &points[1] || largest == &points[2]);
    return constraints.count({ p, q }) == 0 && (sign > 0 || isWrongTie);
  };
  OppositeMap opposites = FindOpposites(mesh.View().Triangles);
  const auto add = [&](std::int64_t a, std::int64_t b, std::int64_t c)
  {
    opposites[{ a, b }] = c;
    opposites[{ b, c }] = a;
    opposites[{ c, a }] = b;
  };
  std::int64_t flips = 0;
  const auto flip = [&](std::int64_t a, std::int64_t p, std::int64_t q, std::int64_t b)
  {
    if (!isBad(a, p, q, b))
    {
      return false;
    }
    opposites.erase({ p, q });
    opposites.erase({ q, p });
    add(a, p, b);
    add(b, q, a);
    return ++flips > 0;
  };
  while (FindEdge(opposites, flip))
  {
  }
  mesh.Triangles.clear();
  for (const auto& [edge, opposite] : opposites)
  {
    // Each triangle once: at the edge that starts at its smallest vertex.
    if (edge.first < edge.second && edge.first < opposite)
    {
      for (const std::int64_t id : { edge.first, edge.second, opposite })
      {
        mesh.Triangles.push_back(static_cast<std::int32_t>(id));
      }
    }
  }
  return flips;
}

//------------------------------------------------------------------------------
namespace
{

/// Without z.
Point3 GetPlace(const TriangleMesh& mesh, std::int64_t id)
{
  return { mesh.Points.Get(id, 0), mesh.Points.Get(id, 1), 0.0 };
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
Places DrawLattice(std::size_t count, std::int32_t size, std::mt19937& random)
{
  const double last = size;
  std::set<std::array<double, 2>> points = { { 0, 0 }, { last, 0 }, { 0, last }, { last, last } };
  while (points.size() < count)
  {
    const double x = DrawIndex(random, size + 1);
    const double y = DrawIndex(random, size + 1);
    points.insert({ x, y });
  }
  Places drawn(points.begin(), points.end());
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
  return WithConstraints(this->Mesh.View(), this->Ends, this->ToInsert.data());
}

ConstrainedMesh Constrain(OwnedMesh<double> mesh, int constraints, std::mt19937& random)
{
  ConstrainedMesh drawn{ std::move(mesh), {}, {} };
  for (int i = 0; i < constraints; ++i)
  {
    const std::int64_t from = DrawIndex(random, drawn.Mesh.NumberOfPoints());
    drawn.Add(from, DrawIndex(random, drawn.Mesh.NumberOfPoints()));
  }
  return drawn;
}

ConstrainedMesh DrawCase(std::size_t points, std::int32_t size, int constraints, std::uint32_t seed)
{
  std::mt19937 random(seed);
  return Constrain(MakeSweptMesh(DrawLattice(points, size, random)), constraints, random);
}

ConstrainedMesh DrawOverlapping(int constraints, std::uint32_t seed)
{
  ConstrainedMesh drawn = DrawCase(40, 10, constraints, seed);
  std::mt19937 random(seed);
  for (int i = 0; i < 6; ++i)
  {
    const std::size_t point = DrawIndex(random, drawn.Mesh.NumberOfPoints());
    drawn.Mesh.Points[3 * point] = DrawIndex(random, 11);
    drawn.Mesh.Points[3 * point + 1] = DrawIndex(random, 11);
  }
  drawn.Mesh = seed % 2 == 0 ? drawn.Mesh : RepeatTriangles(drawn.Mesh);
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
  const Point3 a = GetPlace(mesh, from);
  const Point3 b = GetPlace(mesh, to);
  std::vector<std::int64_t> on;
  for (std::int64_t id = 0; id < mesh.Points.Count; ++id)
  {
    const Point3 p = GetPlace(mesh, id);
    if (RationalTurn(a, b, p) == 0 && std::min(a, b) <= p && p <= std::max(a, b))
    {
      on.push_back(id);
    }
  }
  std::sort(on.begin(), on.end(),
    [&](std::int64_t i, std::int64_t j) { return GetPlace(mesh, i) < GetPlace(mesh, j); });
  std::vector<VertexPair> pieces;
  for (std::size_t i = 1; i < on.size(); ++i)
  {
    pieces.emplace_back(on[i - 1], on[i]);
  }
  return pieces;
}

bool Cross(const TriangleMesh& mesh, const VertexPair& a, const VertexPair& b)
{
  const auto divides = [&](const VertexPair& line, const VertexPair& other)
  {
    const auto turn = [&](std::int64_t id)
    {
      return RationalTurn(
        GetPlace(mesh, line.first), GetPlace(mesh, line.second), GetPlace(mesh, id));
    };
    return turn(other.first) * turn(other.second) < 0;
  };
  return divides(a, b) && divides(b, a);
}

std::vector<VertexPair> FindHeldPieces(
  const TriangleMesh& mesh, const std::vector<std::int32_t>& triangles)
{
  const EdgeMap edges = CollectEdges(ViewTriangles(triangles));
  std::set<VertexPair> held;
  for (std::int64_t i = 0; i < mesh.NumberOfConstraintEdges; ++i)
  {
    const std::vector<VertexPair> pieces =
      SplitAtVertices(mesh, mesh.ConstraintEdges[2 * i], mesh.ConstraintEdges[2 * i + 1]);
    if (std::all_of(pieces.begin(), pieces.end(),
          [&](const VertexPair& piece)
          { return edges.count(Sorted(piece.first, piece.second)) == 1; }))
    {
      held.insert(pieces.begin(), pieces.end());
    }
  }
  return { held.begin(), held.end() };
}

ExpectedInsertion PredictInsertion(const TriangleMesh& mesh)
{
  ExpectedInsertion expected;
  const EdgeMap edges = CollectEdges(mesh.Triangles);
  std::vector<VertexPair> wanted;
  for (std::int64_t i = 0; i < mesh.NumberOfConstraintEdges; ++i)
  {
    const VertexPair ends = Sorted(mesh.ConstraintEdges[2 * i], mesh.ConstraintEdges[2 * i + 1]);
    const bool isKnown = std::find(wanted.begin(), wanted.end(), ends) != wanted.end();
    if (mesh.ConstraintsToInsert[i] == 0)
    {
      expected.Pieces.insert(expected.Pieces.end(), edges.count(ends), ends);
    }
    else if (!isKnown && ends.first != ends.second)
    {
      wanted.push_back(ends);
    }
  }
  for (const VertexPair& ends : wanted)
  {
    const std::vector<VertexPair> pieces = SplitAtVertices(mesh, ends.first, ends.second);
    const bool isRefused = CrossAny(mesh, pieces, expected.Pieces);
    expected.Refused += isRefused ? 1 : 0;
    if (!isRefused)
    {
      expected.Inserted += edges.count(ends) > 0 ? 0 : 1;
      expected.Pieces.insert(expected.Pieces.end(), pieces.begin(), pieces.end());
    }
  }
  return expected;
}

void ExpectEdges(const std::vector<std::int32_t>& triangles, const std::vector<VertexPair>& edges)
{
  const EdgeMap all = CollectEdges(ViewTriangles(triangles));
  for (const VertexPair& edge : edges)
  {
    EXPECT_EQ(1u, all.count(Sorted(edge.first, edge.second))) << edge.first << "-" << edge.second;
  }
}

void ExpectConstrainedDelaunay(const TriangleMesh& mesh, const std::vector<VertexPair>& pieces)
{
  std::set<VertexPair> held;
  for (const auto& [from, to] : pieces)
  {
    held.insert(Sorted(from, to));
  }
  const auto isBad = [&](std::int64_t a, std::int64_t p, std::int64_t q, std::int64_t b)
  {
    return held.count({ p, q }) == 0 &&
      RationalInCircle(GetPlace(mesh, a), GetPlace(mesh, p), GetPlace(mesh, q), GetPlace(mesh, b)) >
      0;
  };
  EXPECT_EQ(0, CountEdges(FindOpposites(mesh.Triangles), isBad));
}

double SumAreas(const TriangleMesh& mesh)
{
  double sum = 0.0;
  for (std::int64_t t = 0; t < mesh.Triangles.Count; ++t)
  {
    const Point3 a = GetPlace(mesh, mesh.Triangles.Get(t, 0));
    const Point3 b = GetPlace(mesh, mesh.Triangles.Get(t, 1));
    const Point3 c = GetPlace(mesh, mesh.Triangles.Get(t, 2));
    sum += (a[0] - c[0]) * (b[1] - c[1]) - (a[1] - c[1]) * (b[0] - c[0]);
  }
  return sum;
}

}
