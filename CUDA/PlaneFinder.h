// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PLANEFINDER_H
#define DELAUNAYFLIP_PLANEFINDER_H

#include "MeshSurvey.h"
#include "SurfaceAngles.h"
#include "ThreadBackend.h"
#include "TriangleMesh.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace delaunayflip
{

/// Points closer to a plane than this share of the bounding box's diagonal lie in it.
constexpr double PlanarTolerance = 1e-6;

/// A point and a value to be maximised; the first of equals wins.
struct Farthest
{
  std::int64_t Point = -1;
  double Value = -1.0;

  Farthest& operator+=(const Farthest& other)
  {
    if (other.Value > this->Value)
    {
      *this = other;
    }
    return *this;
  }
};

/// Finds the plane of a survey's points.
class PlaneFinder
{
public:
  PlaneFinder(const PointArray& points, const MeshSurvey& survey, const ThreadBackend& backend)
    : Points(points),
      Survey(survey),
      Backend(backend)
  {
    // Lengths relative to the largest coordinate neither overflow nor underflow to nothing.
    double largest = 0.0;
    for (int axis = 0; axis < 3; ++axis)
    {
      largest = std::max({ largest, std::fabs(survey.Lower[axis]), std::fabs(survey.Upper[axis]) });
    }
    this->Shift = largest > 0.0 ? -std::ilogb(largest) : 0;
    const Vector3 diagonal = this->Scaled(survey.Upper[0], survey.Upper[1], survey.Upper[2]) -
      this->Scaled(survey.Lower[0], survey.Lower[1], survey.Lower[2]);
    this->Diagonal = std::sqrt(Dot(diagonal, diagonal));
  }

  /// Whether all used points lie in one plane; its normal is then known.
  bool Find()
  {
    const std::int64_t first = this->FirstPoint();
    if (first < 0)
    {
      this->Normal = { 0.0, 0.0, 1.0 };
      return true;
    }
    this->Origin = this->Get(first);
    const Vector3 along = this->Get(this->ArgMax(
                            [this](const Vector3& p)
                            {
                              const Vector3 d = p - this->Origin;
                              return Dot(d, d);
                            })) -
      this->Origin;
    const Vector3 across = this->Get(this->ArgMax(
                             [&](const Vector3& p)
                             {
                               const Vector3 n = Cross(along, p - this->Origin);
                               return Dot(n, n);
                             })) -
      this->Origin;
    this->Normal = Cross(along, across);
    const double length = std::sqrt(Dot(this->Normal, this->Normal));
    this->Off = this->ArgMax([this](const Vector3& p) { return this->Height(p); });
    return this->Height(this->Get(this->Off)) <= PlanarTolerance * this->Diagonal * length;
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

private:
  Vector3 Scaled(double x, double y, double z) const
  {
    return { std::scalbn(x, this->Shift), std::scalbn(y, this->Shift),
      std::scalbn(z, this->Shift) };
  }

  Vector3 Get(std::int64_t i) const
  {
    return this->Scaled(this->Points.Get(i, 0), this->Points.Get(i, 1), this->Points.Get(i, 2));
  }

  double Height(const Vector3& p) const { return std::fabs(Dot(this->Normal, p - this->Origin)); }

  std::int64_t FirstPoint() const
  {
    for (std::int64_t i = 0; i < this->Points.Count; ++i)
    {
      if (this->Survey.Uses[i] == PointUse::Used)
      {
        return i;
      }
    }
    return -1;
  }

  template <typename Measure>
  std::int64_t ArgMax(const Measure& measure) const
  {
    return this->Backend
      .Sum<Farthest>(this->Points.Count,
        [&](std::int64_t begin, std::int64_t end)
        {
          Farthest farthest;
          for (std::int64_t i = begin; i < end; ++i)
          {
            if (this->Survey.Uses[i] == PointUse::Used)
            {
              farthest += { i, measure(this->Get(i)) };
            }
          }
          return farthest;
        })
      .Point;
  }

  const PointArray& Points;
  const MeshSurvey& Survey;
  const ThreadBackend& Backend;
  int Shift = 0;
  double Diagonal = 0.0;
  Vector3 Origin, Normal;
  std::int64_t Off = -1;
};

}

#endif
