// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_REFERENCES_H
#define DELAUNAYFLIP_REFERENCES_H

#include "FlipTestSupport.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

/// @file
/// What results are compared with: CGAL, rational numbers, Lawson's algorithm, and all pairs of
/// constraints. All of it is slow, obvious and independent of the engine's geometry.

namespace delaunayflip
{

using VertexPair = std::pair<std::int64_t, std::int64_t>;
using Place = std::array<double, 2>;
using Places = std::vector<Place>;

inline VertexPair Sorted(std::int64_t a, std::int64_t b) { return std::minmax(a, b); }

/// The pairs of a list of vertex ids, the smaller id first.
std::set<VertexPair> ToEdges(const std::vector<std::int64_t>& ids);

/// Edges, the smaller id first, with their incident triangles. One that names a point twice has
/// none.
using EdgeMap = std::map<VertexPair, std::vector<std::int64_t>>;
EdgeMap CollectEdges(const TriangleArray& triangles);

/// The opposite vertex of every half-edge.
using OppositeMap = std::map<VertexPair, std::int64_t>;
OppositeMap FindOpposites(const TriangleArray& triangles);

/// Calls judge(a, p, q, b) for every edge p-q with the triangles (a, p, q) and (b, q, p), until it
/// returns true. @returns whether it did.
template <typename Judge>
bool FindEdge(const OppositeMap& opposites, const Judge& judge)
{
  for (const auto& [edge, opposite] : opposites)
  {
    const auto twin = opposites.find({ edge.second, edge.first });
    if (edge.first < edge.second && twin != opposites.end() &&
      judge(opposite, edge.first, edge.second, twin->second))
    {
      return true;
    }
  }
  return false;
}

/// Counts the edges p-q for which isBad(a, p, q, b) is true.
template <typename Judge>
std::int64_t CountEdges(const OppositeMap& opposites, const Judge& isBad)
{
  std::int64_t count = 0;
  FindEdge(opposites,
    [&](std::int64_t a, std::int64_t p, std::int64_t q, std::int64_t b)
    {
      count += isBad(a, p, q, b) ? 1 : 0;
      return false;
    });
  return count;
}

//------------------------------------------------------------------------------
// CGAL, in x and y.

/// Delaunay triangulation of all points, which must be distinct. Ties are broken by CGAL's symbolic
/// perturbation.
TriangleSet MakeCgalDelaunay(const PointArray& points);

/// Constrained Delaunay triangulation. Constraints must meet only at points. Ties are left as CGAL
/// happens to decide them.
TriangleSet MakeCgalConstrainedDelaunay(const TriangleMesh& mesh);

/// Edges of two triangles that CGAL's exact in-circle predicate rejects, for counter-clockwise
/// meshes without degenerate triangles.
std::int64_t CountCgalViolations(const TriangleMesh& mesh);

/// A mesh of these points. z is 0.
OwnedMesh<double> ToMesh(const Places& points, const std::vector<std::int32_t>& triangles = {});

/// A valid but bad triangulation of the convex hull of distinct points, which are inserted in the
/// order of x without regard to shape. z is 0.
OwnedMesh<double> MakeSweptMesh(const Places& points);

/// Up to `count` distinct points of a lattice, in the order of x.
Places DrawDistinct(std::mt19937& random, int count, int columns, int rows);

//------------------------------------------------------------------------------
// Rational numbers.

/// The sign of the turn a, b, c in x and y.
int RationalTurn(const Point3& a, const Point3& b, const Point3& c);

/// The sign of the determinant with rows a - d, b - d and c - d.
int RationalOrientation3D(const Point3& a, const Point3& b, const Point3& c, const Point3& d);

/// Sign of the determinant with rows (x, y, x^2 + y^2, 1); with `tilted`, z^2 joins the third.
int RationalInCircle(
  const Point3& a, const Point3& b, const Point3& c, const Point3& d, bool tilted = false);

/// For a mesh exactly in some plane, counts the interior edges with the fourth point inside the
/// circle of the other three, by a determinant in space, without projection.
std::int64_t CountRationalViolations(const TriangleMesh& mesh);

/// Triangles by the sign of their turn in x and y.
struct TriangleTurns
{
  std::int64_t Left = 0, Right = 0, Straight = 0;
};
TriangleTurns CountTurns(const TriangleMesh& mesh);

/// Lawson's algorithm in x and y in rational arithmetic, one flip at a time, until none is left.
/// @param mesh without flat, overlapping or clockwise triangles.
/// @param constraints edges that stay, the smaller id first.
/// @returns the number of flips.
std::int64_t FlipByLawson(
  OwnedMesh<double>& mesh, const std::set<VertexPair>& constraints, TieRuleKind rule);

//------------------------------------------------------------------------------
// Constraints.

/// A mesh with constraints, all of which are to be inserted.
struct ConstrainedMesh
{
  OwnedMesh<double> Mesh;
  std::vector<std::int64_t> Ends;
  std::vector<unsigned char> ToInsert;

  void Add(std::int64_t from, std::int64_t to, bool insert = true);
  TriangleMesh View() const;
};

/// The mesh with constraints between random points.
ConstrainedMesh Constrain(OwnedMesh<double> mesh, int constraints, std::mt19937& random);

/// Random constraints on a random bad mesh. The fewer lattice points there are to choose from, the
/// more constraints meet vertices.
ConstrainedMesh DrawCase(
  std::size_t points, std::int32_t size, int constraints, std::uint32_t seed);

/// Draws a case with some points moved and, for odd seeds, triangles repeated, so that triangles
/// overlap.
ConstrainedMesh DrawOverlapping(int constraints, std::uint32_t seed);

/// The mesh without constraints that would cross an earlier one.
ConstrainedMesh DropCrossing(const ConstrainedMesh& mesh);

/// The constraint cut at every vertex on it.
std::vector<VertexPair> SplitAtVertices(
  const TriangleMesh& mesh, std::int64_t from, std::int64_t to);

/// Whether two pieces meet in a point that is an end of neither.
bool Cross(const TriangleMesh& mesh, const VertexPair& a, const VertexPair& b);

/// The pieces of the constraints of which all pieces are edges of these triangles.
std::vector<VertexPair> FindHeldPieces(
  const TriangleMesh& mesh, const std::vector<std::int32_t>& triangles);

/// What should become of the constraints of a mesh that covers a convex domain, with distinct
/// points.
struct ExpectedInsertion
{
  std::vector<VertexPair> Pieces; ///< That must be edges.
  std::int64_t Inserted = 0;
  std::int64_t Refused = 0;
};
ExpectedInsertion PredictInsertion(const TriangleMesh& mesh);

/// Reports a failure for those that are no edges of the triangles.
void ExpectEdges(const std::vector<std::int32_t>& triangles, const std::vector<VertexPair>& edges);

/// Reports a failure for edges of two triangles that are not locally Delaunay and no pieces. Where
/// all triangles turn left and do not overlap, the mesh is constrained Delaunay without them.
void ExpectConstrainedDelaunay(const TriangleMesh& mesh, const std::vector<VertexPair>& pieces);

/// Twice the area of all triangles with their sign, exact for small whole coordinates.
double SumAreas(const TriangleMesh& mesh);

//------------------------------------------------------------------------------
// Long double.

using LongVector = std::array<long double, 3>;

inline LongVector Subtract(const LongVector& a, const LongVector& b)
{
  return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
}

inline long double Dot(const LongVector& a, const LongVector& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// The normal of a triangle, as long as twice its area.
inline LongVector FindNormal(const LongVector& a, const LongVector& b, const LongVector& c)
{
  const LongVector u = Subtract(b, a), v = Subtract(c, a);
  return { u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0] };
}

/// The angle p, apex, q in radians.
inline long double FindAngle(const LongVector& apex, const LongVector& p, const LongVector& q)
{
  const LongVector n = FindNormal(apex, p, q);
  return std::atan2(std::sqrt(Dot(n, n)), Dot(Subtract(p, apex), Subtract(q, apex)));
}

}

#endif
