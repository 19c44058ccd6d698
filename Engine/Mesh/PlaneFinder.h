// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PLANEFINDER_H
#define DELAUNAYFLIP_PLANEFINDER_H

#include "MeshSurvey.h"
#include "PlaneScale.h"
#include "SurfaceAngles.h"
#include "TriangleMesh.h"

#include <cmath>
#include <cstdint>

namespace delaunayflip
{

/// Points closer to a plane than this share of the bounding box's diagonal lie in it.
constexpr double PlanarTolerance = 1e-6;

/// A point, its scaled position, and a value to be maximised; the first of equals wins.
struct Farthest
{
  std::int64_t Point = -1;
  double Value = -1.0;
  Vector3 Position;

  DELAUNAYFLIP_HOST_DEVICE Farthest& operator+=(const Farthest& other)
  {
    const bool first = other.Value == this->Value && other.Point < this->Point;
    if (other.Value > this->Value || first)
    {
      *this = other;
    }
    return *this;
  }
};

/// The measure to maximise: squared distance from an origin, squared area with a vector, or
/// distance from a plane times the length of its normal.
struct DistanceFrom
{
  Vector3 Origin;
  DELAUNAYFLIP_HOST_DEVICE double operator()(const Vector3& p) const
  {
    const Vector3 d = p - this->Origin;
    return Dot(d, d);
  }
};

struct AreaWith
{
  Vector3 Origin, Along;
  DELAUNAYFLIP_HOST_DEVICE double operator()(const Vector3& p) const
  {
    const Vector3 n = Cross(this->Along, p - this->Origin);
    return Dot(n, n);
  }
};

struct HeightAbove
{
  Vector3 Origin, Normal;
  DELAUNAYFLIP_HOST_DEVICE double operator()(const Vector3& p) const
  {
    return std::fabs(Dot(this->Normal, p - this->Origin));
  }
};

/// Finds the plane of a survey's points.
template <typename Backend>
class PlaneFinder
{
public:
  PlaneFinder(const MeshInput& input, const MeshSurvey& survey, const Backend& backend)
    : Input(input),
      Uses(survey.Uses.Data()),
      Scale(survey.Box),
      Engine(backend)
  {
    const BoundingBox& box = survey.Box;
    this->Level = box.Lower[2] == box.Upper[2];
    this->Diagonal = Length(this->Scale(box.Upper[0], box.Upper[1], box.Upper[2]) -
      this->Scale(box.Lower[0], box.Lower[1], box.Lower[2]));
  }

  /// Whether all used points lie in one plane; its normal is then known.
  bool Find()
  {
    this->Normal = { 0.0, 0.0, 1.0 };
    if (this->Level)
    {
      return true;
    }
    // This finds the first used point: the measure is the same for all.
    const Farthest first = this->ArgMax(HeightAbove{});
    if (first.Point < 0)
    {
      return true;
    }
    const Vector3 origin = first.Position;
    const Vector3 along = this->ArgMax(DistanceFrom{ origin }).Position - origin;
    const Vector3 across = this->ArgMax(AreaWith{ origin, along }).Position - origin;
    this->Normal = Cross(along, across);
    const HeightAbove height{ origin, this->Normal };
    const Farthest off = this->ArgMax(height);
    this->Off = off.Point;
    return height(off.Position) <= PlanarTolerance * this->Diagonal * Length(this->Normal);
  }

  int DominantAxis() const
  {
    const double x = std::fabs(this->Normal.X);
    const double y = std::fabs(this->Normal.Y);
    const double z = std::fabs(this->Normal.Z);
    if (z >= x && z >= y)
    {
      return 2;
    }
    return y >= x ? 1 : 0;
  }

  std::int64_t FarthestOff() const { return this->Off; }

  /// The used point with the largest measure. Public because device lambdas require it.
  template <typename Measure>
  Farthest ArgMax(const Measure& measure) const
  {
    const PointArray points = this->Input.Local.Points;
    const PointUse* uses = this->Uses;
    const PlaneScale scale = this->Scale;
    return this->Engine.template Sum<Farthest>(points.Count,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i, Farthest & farthest)
      {
        if (uses[i] == PointUse::Used)
        {
          const Vector3 position = scale(points.Get(i, 0), points.Get(i, 1), points.Get(i, 2));
          farthest += { i, measure(position), position };
        }
      });
  }

private:
  const MeshInput& Input;
  const PointUse* Uses;
  PlaneScale Scale;
  const Backend& Engine;
  double Diagonal = 0.0;
  bool Level; ///< All z are equal, as in most planar meshes.
  Vector3 Normal;
  std::int64_t Off = -1;
};

}

#endif
