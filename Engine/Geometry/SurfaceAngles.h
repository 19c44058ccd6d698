// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_SURFACEANGLES_H
#define DELAUNAYFLIP_SURFACEANGLES_H

#include "HostDevice.h"
#include "TriangleMesh.h"
#include "Vector3.h"

#include <cmath>
#include <cstdint>

/// @file
/// Angles in space by cross and dot products: no inverse trigonometry, no dependence on scale.

namespace delaunayflip
{

constexpr double Pi = 3.14159265358979323846;
constexpr double DegreesToRadians = Pi / 180.0;

DELAUNAYFLIP_HOST_DEVICE inline Vector3 LoadPoint(const PointArray& points, std::int64_t point)
{
  return { points.Get(point, 0), points.Get(point, 1), points.Get(point, 2) };
}

/// The points of a quad (EdgeFlip.h's picture).
struct QuadPoints
{
  Vector3 A, P, Q, B;
};

/// Whether the normals of the two triangles differ by more than the angle with that cosine. False
/// if a triangle has no area, and so no normal.
DELAUNAYFLIP_HOST_DEVICE inline bool IsSharp(const QuadPoints& quad, double cosine)
{
  const Vector3 upper = AreaVector(quad.A, quad.P, quad.Q);
  const Vector3 lower = AreaVector(quad.B, quad.Q, quad.P);
  const double lengths = Length(upper) * Length(lower);
  return lengths > 0.0 && Dot(upper, lower) < cosine * lengths;
}

/// Whether flipping p-q to a-b would fold the surface over: whether a new normal points away from
/// the quad's vector area, which the flip does not change.
DELAUNAYFLIP_HOST_DEVICE inline bool FoldsOver(const QuadPoints& quad)
{
  const Vector3 area = AreaVector(quad.A, quad.P, quad.Q) + AreaVector(quad.B, quad.Q, quad.P);
  return !(Dot(AreaVector(quad.A, quad.P, quad.B), area) > 0.0 &&
    Dot(AreaVector(quad.B, quad.Q, quad.A), area) > 0.0);
}

/// Squared cotangent of the smallest angle of a triangle, which grows as the angle shrinks:
/// infinite without area, -infinite (no angle) with a coordinate that is NaN or infinite. The
/// smallest angle is at most 60 degrees, so its cotangent is positive.
/// @param atA, atB, atC products of the edges at the corners. @param squaredArea of twice the
/// triangle.
DELAUNAYFLIP_HOST_DEVICE inline double LargestSquaredCotangent(
  double atA, double atB, double atC, double squaredArea)
{
  if (!(squaredArea < INFINITY))
  {
    return -INFINITY;
  }
  const double atBOrC = atB > atC ? atB : atC;
  const double largest = atA > atBOrC ? atA : atBOrC;
  return squaredArea > 0.0 ? largest * largest / squaredArea : INFINITY;
}

DELAUNAYFLIP_HOST_DEVICE inline double LargestSquaredCotangent(
  const Vector3& a, const Vector3& b, const Vector3& c)
{
  const Vector3 ab = b - a, ac = c - a, bc = c - b;
  const Vector3 normal = Cross(ab, ac);
  return LargestSquaredCotangent(Dot(ab, ac), -Dot(ab, bc), Dot(ac, bc), Dot(normal, normal));
}

/// The same for triangles with Z = 0, with the same bits.
DELAUNAYFLIP_HOST_DEVICE inline double LargestSquaredCotangentFlat(
  const Vector3& a, const Vector3& b, const Vector3& c)
{
  const double abX = b.X - a.X, abY = b.Y - a.Y;
  const double acX = c.X - a.X, acY = c.Y - a.Y;
  const double bcX = c.X - b.X, bcY = c.Y - b.Y;
  const double area = abX * acY - abY * acX;
  return LargestSquaredCotangent(
    abX * acX + abY * acY, -(abX * bcX + abY * bcY), acX * bcX + acY * bcY, area * area);
}

}

#endif
