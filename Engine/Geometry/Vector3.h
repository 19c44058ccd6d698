// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_VECTOR3_H
#define DELAUNAYFLIP_VECTOR3_H

#include "HostDevice.h"

#include <cmath>

namespace delaunayflip
{

/// Whether a number is neither NaN nor infinite: only then its difference with itself is 0.
DELAUNAYFLIP_HOST_DEVICE inline bool IsFinite(double number) { return number - number == 0.0; }

struct Vector3
{
  double X = 0.0, Y = 0.0, Z = 0.0;
};

DELAUNAYFLIP_HOST_DEVICE inline Vector3 operator+(const Vector3& a, const Vector3& b)
{
  return { a.X + b.X, a.Y + b.Y, a.Z + b.Z };
}

DELAUNAYFLIP_HOST_DEVICE inline Vector3 operator-(const Vector3& a, const Vector3& b)
{
  return { a.X - b.X, a.Y - b.Y, a.Z - b.Z };
}

DELAUNAYFLIP_HOST_DEVICE inline double Dot(const Vector3& a, const Vector3& b)
{
  return a.X * b.X + a.Y * b.Y + a.Z * b.Z;
}

DELAUNAYFLIP_HOST_DEVICE inline Vector3 Cross(const Vector3& a, const Vector3& b)
{
  return { a.Y * b.Z - a.Z * b.Y, a.Z * b.X - a.X * b.Z, a.X * b.Y - a.Y * b.X };
}

DELAUNAYFLIP_HOST_DEVICE inline double Length(const Vector3& a) { return std::sqrt(Dot(a, a)); }

/// Normal of triangle a, b, c; its length is twice the area.
DELAUNAYFLIP_HOST_DEVICE inline Vector3 AreaVector(
  const Vector3& a, const Vector3& b, const Vector3& c)
{
  return Cross(b - a, c - a);
}

}

#endif
