// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ExactRest.h"

#include "References.h"

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace delaunayflip
{
namespace
{

using Real = boost::multiprecision::number<
  boost::multiprecision::cpp_bin_float<300, boost::multiprecision::digit_base_2>,
  boost::multiprecision::et_off>;
using RealVector = std::array<Real, 3>;

/// a, p, q, b: triangles (a, p, q) and (b, q, p).
using QuadCorners = std::array<Point3, 4>;

RealVector Subtract(const Point3& p, const Point3& q)
{
  return { Real(p[0]) - q[0], Real(p[1]) - q[1], Real(p[2]) - q[2] };
}

Real Dot(const RealVector& a, const RealVector& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// An angle as cosine and sine, and the lengths of its legs.
struct ExactAngle
{
  ExactAngle(const Point3& apex, const Point3& p, const Point3& q)
  {
    const RealVector u = Subtract(p, apex), v = Subtract(q, apex);
    const RealVector n = { u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
      u[0] * v[1] - u[1] * v[0] };
    this->First = sqrt(Dot(u, u));
    this->Second = sqrt(Dot(v, v));
    this->Cosine = Dot(u, v);
    this->Sine = sqrt(Dot(n, n));
    if (this->HasLegs())
    {
      this->Cosine /= this->First * this->Second;
      this->Sine /= this->First * this->Second;
    }
  }

  bool HasLegs() const { return this->First > 0 && this->Second > 0; }

  Real Cosine, Sine, First, Second;
};

/// Judges opposite-angle sums.
class AngleCriterion
{
public:
  AngleCriterion(double tolerance, double precision)
    : Tolerance(tolerance),
      Precision(precision)
  {
  }

  /// @returns whether the sum certainly exceeds pi plus the tolerance, and whether it may.
  std::pair<bool, bool> Judge(const QuadCorners& apqb) const
  {
    const ExactAngle a(apqb[0], apqb[1], apqb[2]);
    const ExactAngle b(apqb[3], apqb[1], apqb[2]);
    if (!a.HasLegs() || !b.HasLegs())
    {
      return { false, false };
    }
    // In double: sums with a relative error of 1e-12 suffice from here on.
    const auto sine = static_cast<double>(a.Sine * b.Cosine + a.Cosine * b.Sine);
    const auto cosine = static_cast<double>(a.Cosine * b.Cosine - a.Sine * b.Sine);
    const double sum = std::atan2(sine, cosine);
    const bool isObtuse = a.Cosine < 0 && b.Cosine < 0;
    // atan2 gives -pi to pi; the sum is in 0 .. 2 pi.
    const double excess = isObtuse || sum < 0.0 ? (sum > 0.0 ? sum - Pi : sum + Pi) : sum - Pi;
    const double limit = this->GetLimit(a, b, apqb);
    const double margin = 1e-9 * std::max(std::min(1.0, limit), 1e-5);
    return { excess > limit + margin, excess > limit - margin };
  }

private:
  static constexpr double Pi = 3.14159265358979323846;

  /// The tolerance of a quad in radians; Documentation/method.md has the automatic one.
  double GetLimit(const ExactAngle& a, const ExactAngle& b, const QuadCorners& apqb) const
  {
    if (this->Tolerance >= 0.0)
    {
      return this->Tolerance;
    }
    Real farthest = 0;
    for (const Point3& point : apqb)
    {
      farthest = std::max(farthest, Real(sqrt(Dot(Subtract(point, {}), Subtract(point, {})))));
    }
    const Real reciprocals = 1 / a.First + 1 / a.Second + 1 / b.First + 1 / b.Second;
    const auto sine = static_cast<double>(2 * this->Precision * farthest * reciprocals) + 0x1p-47;
    return sine < 1.0 ? std::asin(sine) : 2.0 * Pi;
  }

  double Tolerance;
  double Precision;
};

struct EdgeSide
{
  std::int64_t Triangle, Opposite;
  bool Upwards; ///< Whether the half-edge runs from the smaller id to the larger.
};
using EdgeSides = std::map<std::pair<std::int64_t, std::int64_t>, std::vector<EdgeSide>>;

EdgeSides CollectSides(const TriangleArray& triangles)
{
  EdgeSides sides;
  for (std::int64_t t = 0; t < triangles.Count; ++t)
  {
    for (int slot = 0; slot < 3; ++slot)
    {
      const std::int64_t from = triangles.Get(t, slot);
      const std::int64_t to = triangles.Get(t, (slot + 1) % 3);
      if (from != to)
      {
        sides[std::minmax(from, to)].push_back({ t, triangles.Get(t, (slot + 2) % 3), from < to });
      }
    }
  }
  return sides;
}

class RestJudge
{
public:
  RestJudge(const TriangleMesh& mesh, const FlipOptions& options, GeometryKind geometry)
    : Mesh(mesh),
      Options(options),
      IsPlane(geometry != GeometryKind::Surface),
      HasDepth(geometry != GeometryKind::PlanarXY),
      Angles(options.Tolerance, mesh.Points.Floats ? 0x1p-23 : 0x1p-52)
  {
    for (std::int64_t i = 0; i < mesh.NumberOfConstraintEdges; ++i)
    {
      this->Constraints.insert(
        std::minmax({ mesh.ConstraintEdges[2 * i], mesh.ConstraintEdges[2 * i + 1] }));
    }
  }

  RestBounds Count() const
  {
    RestBounds bounds;
    for (const auto& [ends, sides] : CollectSides(this->Mesh.Triangles))
    {
      if (sides.size() == 2 && this->Constraints.count(ends) == 0 && this->MayFlip(sides))
      {
        const auto [certain, possible] = this->Judge(this->GetQuad(ends, sides));
        bounds.Certain += certain;
        bounds.Possible += possible;
      }
    }
    return bounds;
  }

private:
  Point3 Get(std::int64_t id) const
  {
    const PointArray& points = this->Mesh.Points;
    return { points.Get(id, 0), points.Get(id, 1), this->HasDepth ? points.Get(id, 2) : 0.0 };
  }

  bool IsTouchable(std::int64_t t) const
  {
    const std::int64_t ids[] = { this->Mesh.Triangles.Get(t, 0), this->Mesh.Triangles.Get(t, 1),
      this->Mesh.Triangles.Get(t, 2) };
    const bool repeats = ids[0] == ids[1] || ids[1] == ids[2] || ids[2] == ids[0];
    const bool frozen = this->Mesh.FrozenTriangles && this->Mesh.FrozenTriangles[t] != 0;
    return !repeats && !frozen &&
      std::all_of(ids, ids + 3, [this](std::int64_t id) { return this->IsFinite(id); });
  }

  bool IsFinite(std::int64_t id) const
  {
    const Point3 point = this->Get(id);
    return std::isfinite(point[0]) && std::isfinite(point[1]) && std::isfinite(point[2]);
  }

  bool MayFlip(const std::vector<EdgeSide>& sides) const
  {
    const std::int32_t* regions = this->Mesh.Regions;
    const bool region = regions && regions[sides[0].Triangle] != regions[sides[1].Triangle];
    return !region && sides[0].Upwards != sides[1].Upwards &&
      sides[0].Opposite != sides[1].Opposite && this->IsTouchable(sides[0].Triangle) &&
      this->IsTouchable(sides[1].Triangle);
  }

  QuadCorners GetQuad(
    const std::pair<std::int64_t, std::int64_t>& ends, const std::vector<EdgeSide>& sides) const
  {
    const EdgeSide& up = sides[sides[0].Upwards ? 0 : 1];
    const EdgeSide& down = sides[sides[0].Upwards ? 1 : 0];
    return { this->Get(up.Opposite), this->Get(ends.first), this->Get(ends.second),
      this->Get(down.Opposite) };
  }

  std::pair<bool, bool> Judge(const QuadCorners& apqb) const
  {
    if (!this->IsPlane)
    {
      return this->Angles.Judge(apqb);
    }
    const auto& [a, p, q, b] = apqb;
    const int upper = RationalTurn(a, p, q), lower = RationalTurn(b, q, p);
    if (upper == 0 && lower == 0)
    {
      return this->JudgeFlat(apqb);
    }
    const int turn = upper + lower; // 0 if the triangles have opposite orientations
    if (this->Options.Criterion == CriterionKind::OppositeAngles)
    {
      return turn == 0 ? std::make_pair(false, false) : this->Angles.Judge(apqb);
    }
    const int inCircle = RationalInCircle(a, p, q, b);
    const bool isCanonical = this->Options.TieRule == TieRuleKind::Canonical;
    const bool isBad = inCircle == 0 && std::abs(turn) == 2 && isCanonical
      ? std::max(a, b) < std::max(p, q)
      : turn * inCircle > 0;
    return { isBad, isBad };
  }

  /// Judges a quad without area: bad if the flip would make a shorter edge within the edge.
  std::pair<bool, bool> JudgeFlat(const QuadCorners& apqb) const
  {
    const auto edge = std::minmax(apqb[1], apqb[2]);
    const auto made = std::minmax(apqb[0], apqb[3]);
    const bool spans = edge.first <= made.first && made.second <= edge.second && edge != made;
    const bool byAngles = this->Options.Criterion == CriterionKind::OppositeAngles;
    const auto [certain, possible] =
      byAngles ? this->Angles.Judge(apqb) : std::make_pair(true, true);
    return { spans && certain, spans && possible };
  }

  const TriangleMesh& Mesh;
  const FlipOptions& Options;
  bool IsPlane;
  bool HasDepth; ///< Whether z is used.
  AngleCriterion Angles;
  std::set<std::pair<std::int64_t, std::int64_t>> Constraints;
};

}

RestBounds BoundRest(const TriangleMesh& mesh, const FlipOptions& options, GeometryKind geometry)
{
  return RestJudge(mesh, options, geometry).Count();
}

}
