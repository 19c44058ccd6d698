// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_ANGLESURVEY_H
#define DELAUNAYFLIP_ANGLESURVEY_H

#include "EdgeMesh.h"
#include "FilteredPredicates.h"
#include "HostDevice.h"
#include "SurfaceAngles.h"
#include "WideAngles.h"

#include <cmath>
#include <cstdint>

namespace delaunayflip
{

/// A maximum, with operator+= so that Sum can compute it.
struct LargestValue
{
  double Value = -INFINITY;

  DELAUNAYFLIP_HOST_DEVICE LargestValue& operator+=(const LargestValue& other)
  {
    this->Value = other.Value > this->Value ? other.Value : this->Value;
    return *this;
  }
};

/// LargestSquaredCotangent (SurfaceAngles.h) of a triangle, in the coordinates of a rule.
template <typename Rule>
struct AngleSurvey
{
  const TriangleRecord* Triangles;
  Rule Decision;
  CoordinateRange Range;

  DELAUNAYFLIP_HOST_DEVICE void Prefetch(std::int64_t t) const
  {
    for (const VertexId vertex : this->Triangles[t].Vertices)
    {
      delaunayflip::Prefetch(this->Decision.Address(vertex));
    }
  }
  DELAUNAYFLIP_HOST_DEVICE void operator()(std::int64_t t, LargestValue& sum) const
  {
    const VertexId* v = this->Triangles[t].Vertices;
    const Vector3 a = this->GetPosition(v[0]);
    const Vector3 b = this->GetPosition(v[1]);
    const Vector3 c = this->GetPosition(v[2]);
    LargestValue largest;
    largest.Value =
      Rule::Flat ? LargestSquaredCotangentFlat(a, b, c) : LargestSquaredCotangent(a, b, c);
    if (IsLost(largest.Value) || IsWide(this->Range, a, b, c))
    {
      largest.Value = LargestSquaredCotangentWide(a, b, c);
    }
    sum += largest;
  }

private:
  DELAUNAYFLIP_HOST_DEVICE Vector3 GetPosition(VertexId vertex) const
  {
    return ToPosition(this->Decision.Get(vertex));
  }
  /// Whether a triangle seems to have no area, as when the squares of its lengths vanish.
  DELAUNAYFLIP_HOST_DEVICE static bool IsLost(double squaredCotangent)
  {
    return squaredCotangent == INFINITY;
  }
  DELAUNAYFLIP_HOST_DEVICE static Vector3 ToPosition(const Vector3& point) { return point; }
  DELAUNAYFLIP_HOST_DEVICE static Vector3 ToPosition(const PlanePoint& point)
  {
    return { point.U, point.V, point.W };
  }
};

}

#endif
