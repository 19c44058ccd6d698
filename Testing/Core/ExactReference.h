// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_EXACTREFERENCE_H
#define DELAUNAYFLIP_EXACTREFERENCE_H

#include "TriangleMesh.h"

#include <array>
#include <cstdint>

/// @file
/// Geometry in rational numbers: slow, obvious, and independent of the engine's predicates.

namespace delaunayflip
{

using Point3 = std::array<double, 3>;

/// The sign of the turn a, b, c in x and y.
int RationalTurn(const Point3& a, const Point3& b, const Point3& c);

/// Sign of the determinant with rows (x, y, x^2 + y^2, 1); with `tilted`, z^2 joins the third.
int RationalInCircle(
  const Point3& a, const Point3& b, const Point3& c, const Point3& d, bool tilted = false);

/// Counts the interior edges of a mesh that lies exactly in some plane whose fourth point lies
/// inside the circle of the other three, by a determinant in space, without projection.
std::int64_t CountRationalViolations(const TriangleMesh& mesh);

/// Triangles by the sign of their turn in x and y.
struct TriangleTurns
{
  std::int64_t Left = 0, Right = 0, Straight = 0;
};
TriangleTurns CountTurns(const TriangleMesh& mesh);

}

#endif
