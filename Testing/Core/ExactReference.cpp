// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ExactReference.h"

#include <CGAL/Gmpq.h>

#include <map>
#include <utility>
#include <vector>

namespace delaunayflip
{

namespace
{

using Rational = CGAL::Gmpq;
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

int Sign(const Rational& value) { return static_cast<int>(CGAL::sign(value)); }

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

int RationalInCircle(
  const Point3& a, const Point3& b, const Point3& c, const Point3& d, bool tilted)
{
  return Sign(Determinant(LiftedDifference(a, d, tilted), LiftedDifference(b, d, tilted),
    LiftedDifference(c, d, tilted)));
}

std::int64_t CountRationalViolations(const TriangleMesh& mesh)
{
  // Opposite vertices by directed edge.
  std::map<std::pair<std::int64_t, std::int64_t>, std::int64_t> opposites;
  for (std::int64_t t = 0; t < mesh.Triangles.Count; ++t)
  {
    for (int slot = 0; slot < 3; ++slot)
    {
      opposites[{ mesh.Triangles.Get(t, slot), mesh.Triangles.Get(t, (slot + 1) % 3) }] =
        mesh.Triangles.Get(t, (slot + 2) % 3);
    }
  }
  std::int64_t violated = 0;
  for (const auto& [edge, opposite] : opposites)
  {
    const auto twin = opposites.find({ edge.second, edge.first });
    if (edge.first < edge.second && twin != opposites.end())
    {
      violated += IsViolated({ GetPoint(mesh, opposite), GetPoint(mesh, edge.first),
        GetPoint(mesh, edge.second), GetPoint(mesh, twin->second) });
    }
  }
  return violated;
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

}
