// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_FLIPRULES_H
#define DELAUNAYFLIP_FLIPRULES_H

#include "EdgeMesh.h"
#include "ExactPredicates.h"
#include "FlipOptions.h"
#include "HostDevice.h"
#include "MeshSurvey.h"
#include "PortableMath.h"
#include "SurfaceAngles.h"
#include "WideAngles.h"

/// @file
/// The rules that judge edges, one per geometry. A rule reads the coordinates of a quad and returns
/// EdgeState::Good, Bad, BlockedByShape, BlockedByDeviation, or Uncertain when floating-point
/// arithmetic cannot decide; JudgeExactly can. Judgements do not depend on the order in which edges
/// are judged.

namespace delaunayflip
{

/// Whether signs are exact, or by floating-point arithmetic and perhaps UncertainSign.
enum class SignKind
{
  Filtered,
  Exact
};

template <SignKind Kind>
DELAUNAYFLIP_HOST_DEVICE int FindOrientationBy(
  const PlanePoint& a, const PlanePoint& b, const PlanePoint& c)
{
  if constexpr (Kind == SignKind::Exact)
  {
    return ExactOrientation(a, b, c);
  }
  else
  {
    return FilteredOrientation(a, b, c);
  }
}

template <SignKind Kind, bool Tilted>
DELAUNAYFLIP_HOST_DEVICE int FindInCircleBy(const PlanePoint (&apqb)[4])
{
  if constexpr (Kind == SignKind::Exact)
  {
    return ExactInCircle(apqb, Tilted);
  }
  else
  {
    return FilteredInCircle<Tilted>(apqb[0], apqb[1], apqb[2], apqb[3]);
  }
}

/// The common orientation of two triangles, one of which may have no area; 0 if they have different
/// ones or neither has an area.
DELAUNAYFLIP_HOST_DEVICE inline int JoinOrientations(int upper, int lower)
{
  if (upper * lower < 0)
  {
    return 0;
  }
  return upper != 0 ? upper : lower;
}

template <SignKind Kind>
DELAUNAYFLIP_HOST_DEVICE int FindOrientation3DBy(
  const PlanePoint& a, const PlanePoint& b, const PlanePoint& c, const PlanePoint& d)
{
  if constexpr (Kind == SignKind::Exact)
  {
    return ExactOrientation3D(a, b, c, d);
  }
  else
  {
    return FilteredOrientation3D(a, b, c, d);
  }
}

/// The orientation of the two triangles of a quad: 1 or -1; 0 if they have different ones or
/// neither has an area; or UncertainSign. `strict` receives whether both have an area.
template <SignKind Kind>
DELAUNAYFLIP_HOST_DEVICE int FindSide(const PlanePoint (&apqb)[4], bool& strict)
{
  const int upper = FindOrientationBy<Kind>(apqb[0], apqb[1], apqb[2]);
  const int lower = FindOrientationBy<Kind>(apqb[3], apqb[2], apqb[1]);
  strict = upper != 0 && lower != 0;
  if (upper == UncertainSign || lower == UncertainSign)
  {
    return UncertainSign;
  }
  return JoinOrientations(upper, lower);
}

/// BlockedByShape unless both triangles of the flipped quad have orientation `side`.
template <SignKind Kind>
DELAUNAYFLIP_HOST_DEVICE EdgeState CheckConvex(const PlanePoint (&apqb)[4], int side)
{
  const int left = FindOrientationBy<Kind>(apqb[0], apqb[1], apqb[3]);
  const int right = FindOrientationBy<Kind>(apqb[3], apqb[2], apqb[0]);
  if (left == UncertainSign || right == UncertainSign)
  {
    return EdgeState::Uncertain;
  }
  return left == side && right == side ? EdgeState::Bad : EdgeState::BlockedByShape;
}

DELAUNAYFLIP_HOST_DEVICE inline bool IsLexicographicallyLess(
  const PlanePoint& a, const PlanePoint& b)
{
  return a.U < b.U || (a.U == b.U && a.V < b.V);
}

/// Exchanges two points unless they are in lexicographic order, which along a line is their order
/// on it.
DELAUNAYFLIP_HOST_DEVICE inline void Sort(PlanePoint& first, PlanePoint& last)
{
  if (!IsLexicographicallyLess(first, last))
  {
    const PlanePoint larger = first;
    first = last;
    last = larger;
  }
}

/// Whether the edge p-q spans both opposite vertices, so that the flip shortens it. Either may lie
/// at an end of it. The two triangles have no area, and the four points lie in one line.
DELAUNAYFLIP_HOST_DEVICE inline bool SpansOpposite(const PlanePoint (&apqb)[4])
{
  PlanePoint first = apqb[1], last = apqb[2];
  Sort(first, last);
  PlanePoint lower = apqb[0], upper = apqb[3];
  Sort(lower, upper);
  const bool startsLater = IsLexicographicallyLess(first, lower);
  const bool endsEarlier = IsLexicographicallyLess(upper, last);
  return !IsLexicographicallyLess(lower, first) && !IsLexicographicallyLess(last, upper) &&
    (startsLater || endsEarlier);
}

/// Bad if a condition holds, else Good. This is a selection instead of a branch, which would be
/// mispredicted half of the time.
DELAUNAYFLIP_HOST_DEVICE inline EdgeState BadIf(bool isBad)
{
  return isBad ? EdgeState::Bad : EdgeState::Good;
}

/// The canonical diagonal of four points on a circle is the one without the lexicographically
/// largest point.
DELAUNAYFLIP_HOST_DEVICE inline bool EdgeHoldsLargest(const PlanePoint (&apqb)[4])
{
  // This takes no reference to the larger one, for which a device would store the points in memory.
  const auto isBelow = [&](const PlanePoint& point)
  { return IsLexicographicallyLess(point, apqb[1]) || IsLexicographicallyLess(point, apqb[2]); };
  return isBelow(apqb[0]) && isBelow(apqb[3]);
}

/// Judges in the plane, by the exact in-circle predicate. Components = 2: (u, v); 3: (u, v, w) of a
/// tilted plane.
template <typename Real, int Components>
struct PlanarRule
{
  static constexpr bool Tilted = Components == 3;
  static constexpr bool MayBlock = Tilted; ///< Whether an edge may be BlockedByShape.
  /// Whether it judges in space. Then flips always have a guard, an edge may be BlockedByDeviation,
  /// and Judge leaves none to JudgeExactly.
  static constexpr bool IsInSpace = false;

  const Real* Coordinates; ///< Components numbers per vertex.
  int UniformSide; ///< 1 or -1 when every triangle has that orientation, 0 if unknown.
  bool Canonical; ///< Whether ties are decided instead of kept.
  bool FiltersApply; ///< Whether coordinates are in the range of the filters.

  DELAUNAYFLIP_HOST_DEVICE const Real* Address(VertexId vertex) const
  {
    return this->Coordinates + std::size_t(Components) * vertex;
  }

  DELAUNAYFLIP_HOST_DEVICE PlanePoint Get(VertexId vertex) const
  {
#if DELAUNAYFLIP_ON_DEVICE
    if (!Tilted)
    {
      const auto point = reinterpret_cast<const CoordinatePair<Real>*>(this->Coordinates)[vertex];
      return { point.U, point.V, Real(0) };
    }
#endif
    const Real* x = this->Address(vertex);
    return { x[0], x[1], Tilted ? x[Components - 1] : Real(0) };
  }

  DELAUNAYFLIP_HOST_DEVICE EdgeState Judge(const Quad& quad) const
  {
    if (!this->FiltersApply)
    {
      return EdgeState::Uncertain;
    }
    return this->Decide<SignKind::Filtered>(quad);
  }

  DELAUNAYFLIP_HOST_DEVICE EdgeState JudgeExactly(const Quad& quad) const
  {
    return this->Decide<SignKind::Exact>(quad);
  }

private:
  /// In the plane, if in-circle > 0, one triangle has an area, and the other is not folded over,
  /// the quad is strictly convex. With a tilted lift, points off the plane can break this.
  template <SignKind Kind>
  DELAUNAYFLIP_HOST_DEVICE EdgeState Decide(const Quad& quad) const
  {
    const PlanePoint apqb[4] = { this->Get(quad.A), this->Get(quad.P), this->Get(quad.Q),
      this->Get(quad.B) };
    bool strict = true;
    int side = this->UniformSide;
    if (side == 0)
    {
      side = FindSide<Kind>(apqb, strict);
    }
    const int inCircle = FindInCircleBy<Kind, Tilted>(apqb);
    if (side == UncertainSign || inCircle == UncertainSign)
    {
      return EdgeState::Uncertain;
    }
    if (side == 0)
    {
      return BadIf(!strict && SpansOpposite(apqb));
    }
    EdgeState state = BadIf(inCircle * side > 0);
    if (inCircle == 0 && this->Canonical && strict)
    {
      state = BadIf(EdgeHoldsLargest(apqb));
    }
    if (Tilted && state == EdgeState::Bad)
    {
      return CheckConvex<Kind>(apqb, side);
    }
    return state;
  }
};

DELAUNAYFLIP_HOST_DEVICE inline bool IsLexicographicallyLess3D(
  const PlanePoint& a, const PlanePoint& b)
{
  return IsLexicographicallyLess(a, b) || (a.U == b.U && a.V == b.V && a.W < b.W);
}

/// What EdgeHoldsLargest finds, in space.
DELAUNAYFLIP_HOST_DEVICE inline bool EdgeHoldsLargest3D(const PlanePoint (&apqb)[4])
{
  const auto isBelow = [&](const PlanePoint& point) {
    return IsLexicographicallyLess3D(point, apqb[1]) || IsLexicographicallyLess3D(point, apqb[2]);
  };
  return isBelow(apqb[0]) && isBelow(apqb[3]);
}

/// Judges on a sphere, by the exact orientation of four points in space. An edge is convex if the
/// far corner of one triangle is not beyond the plane of the other. An edge that is not convex
/// flips unless a new triangle would be turned over, seen from the center. Each flip makes the
/// volume larger, so the flips end.
template <typename Real>
struct SphereRule
{
  static constexpr bool MayBlock = true;
  static constexpr bool IsInSpace = false;

  const Real* Coordinates; ///< x, y and z of every vertex.
  PlanePoint Center; ///< The place from which triangles are seen.
  int UniformSide; ///< See PlanarRule; as seen from the center.
  bool Canonical; ///< Whether ties are decided instead of kept.
  bool FiltersApply; ///< Whether coordinates are in the range of the filters.

  DELAUNAYFLIP_HOST_DEVICE const Real* Address(VertexId vertex) const
  {
    return this->Coordinates + std::size_t(3) * vertex;
  }

  DELAUNAYFLIP_HOST_DEVICE PlanePoint Get(VertexId vertex) const
  {
    const Real* x = this->Address(vertex);
    return { x[0], x[1], x[2] };
  }

  DELAUNAYFLIP_HOST_DEVICE EdgeState Judge(const Quad& quad) const
  {
    if (!this->FiltersApply)
    {
      return EdgeState::Uncertain;
    }
    return this->Decide<SignKind::Filtered>(quad);
  }

  DELAUNAYFLIP_HOST_DEVICE EdgeState JudgeExactly(const Quad& quad) const
  {
    return this->Decide<SignKind::Exact>(quad);
  }

private:
  template <SignKind Kind>
  DELAUNAYFLIP_HOST_DEVICE EdgeState Decide(const Quad& quad) const
  {
    const PlanePoint apqb[4] = { this->Get(quad.A), this->Get(quad.P), this->Get(quad.Q),
      this->Get(quad.B) };
    int side = this->UniformSide;
    if (side == 0)
    {
      side = this->FindSide<Kind>(apqb);
    }
    const int below = FindOrientation3DBy<Kind>(apqb[0], apqb[1], apqb[2], apqb[3]);
    if (side == UncertainSign || below == UncertainSign)
    {
      return EdgeState::Uncertain;
    }
    const bool isTie = below == 0;
    const bool mayFlip =
      below * side < 0 || (isTie && side != 0 && this->Canonical && EdgeHoldsLargest3D(apqb));
    if (!mayFlip)
    {
      return EdgeState::Good;
    }
    const EdgeState state = this->CheckConvex<Kind>(apqb, side);
    if (isTie && state == EdgeState::BlockedByShape)
    {
      return EdgeState::Good; // nothing is better than this
    }
    return state;
  }

  /// What the function FindSide finds in the plane. The next one is CheckConvex of the plane.
  template <SignKind Kind>
  DELAUNAYFLIP_HOST_DEVICE int FindSide(const PlanePoint (&apqb)[4]) const
  {
    const int upper = FindOrientation3DBy<Kind>(apqb[0], apqb[1], apqb[2], this->Center);
    const int lower = FindOrientation3DBy<Kind>(apqb[3], apqb[2], apqb[1], this->Center);
    if (upper == UncertainSign || lower == UncertainSign)
    {
      return UncertainSign;
    }
    return JoinOrientations(upper, lower);
  }

  template <SignKind Kind>
  DELAUNAYFLIP_HOST_DEVICE EdgeState CheckConvex(const PlanePoint (&apqb)[4], int side) const
  {
    const int left = FindOrientation3DBy<Kind>(apqb[0], apqb[1], apqb[3], this->Center);
    const int right = FindOrientation3DBy<Kind>(apqb[3], apqb[2], apqb[0], this->Center);
    if (left == UncertainSign || right == UncertainSign)
    {
      return EdgeState::Uncertain;
    }
    return left == side && right == side ? EdgeState::Bad : EdgeState::BlockedByShape;
  }
};

/// Three coordinates of every vertex, and the tolerance of the opposite-angle test on them.
template <typename Real>
struct AnglePoints
{
  const Real* Coordinates;
  AngleTolerance Tolerance;
  CoordinateRange Range;

  DELAUNAYFLIP_HOST_DEVICE const Real* Address(VertexId vertex) const
  {
    return this->Coordinates + std::size_t(3) * vertex;
  }

  DELAUNAYFLIP_HOST_DEVICE Vector3 Get(VertexId vertex) const
  {
    const Real* x = this->Address(vertex);
    return { x[0], x[1], x[2] };
  }

  DELAUNAYFLIP_HOST_DEVICE QuadPoints Get(const Quad& quad) const
  {
    return { this->Get(quad.A), this->Get(quad.P), this->Get(quad.Q), this->Get(quad.B) };
  }

  /// Whether the quad of these points must be judged by WideAngles.h.
  DELAUNAYFLIP_HOST_DEVICE bool IsWide(const Quad& quad, const AngleSum& sum) const
  {
    return sum.MayVanish || this->Range == CoordinateRange::Extreme ||
      (this->Range == CoordinateRange::Mixed && this->IsWide(quad));
  }

  DELAUNAYFLIP_HOST_DEVICE bool ExceedsPi(const Quad& quad, const AngleSum& sum) const
  {
    if (this->IsWide(quad, sum))
    {
      return this->ExceedsPiWide(quad);
    }
    return sum.ExceedsPi(this->Tolerance) &&
      !(this->Tolerance.Precision > 0.0 && this->IsNoise(quad, sum.GetExcess()));
  }

private:
  DELAUNAYFLIP_HOST_DEVICE DELAUNAYFLIP_NO_INLINE bool IsWide(const Quad& quad) const
  {
    return delaunayflip::IsWide(this->Range, this->Get(quad));
  }

  /// These load the points again. They are separate functions, so that they take no registers from
  /// the test of the many edges that do not need them.
  DELAUNAYFLIP_HOST_DEVICE DELAUNAYFLIP_NO_INLINE bool IsNoise(
    const Quad& quad, double excess) const
  {
    return delaunayflip::IsNoise(this->Get(quad), this->Tolerance.Precision, excess);
  }

  DELAUNAYFLIP_HOST_DEVICE DELAUNAYFLIP_NO_INLINE bool ExceedsPiWide(const Quad& quad) const
  {
    return delaunayflip::ExceedsPiWide(this->Get(quad), this->Tolerance);
  }
};

/// Judges in the plane, by the paper's opposite-angle sum. Coordinates are u, v, w; convexity in
/// (u, v) is tested exactly.
struct PlanarAngleRule : AnglePoints<double>
{
  static constexpr bool MayBlock = true;
  static constexpr bool IsInSpace = false;

  DELAUNAYFLIP_HOST_DEVICE EdgeState Judge(const Quad& quad) const
  {
    const AngleSum sum(this->Get(quad));
    if (this->ExceedsPi(quad, sum))
    {
      return EdgeState::Uncertain;
    }
    return EdgeState::Good;
  }

  DELAUNAYFLIP_HOST_DEVICE EdgeState JudgeExactly(const Quad& quad) const
  {
    const QuadPoints points = this->Get(quad);
    const PlanePoint apqb[4] = { { points.A.X, points.A.Y, 0.0 }, { points.P.X, points.P.Y, 0.0 },
      { points.Q.X, points.Q.Y, 0.0 }, { points.B.X, points.B.Y, 0.0 } };
    bool strict = true;
    const int side = FindSide<SignKind::Exact>(apqb, strict);
    if (side == 0)
    {
      return BadIf(!strict && SpansOpposite(apqb));
    }
    return CheckConvex<SignKind::Exact>(apqb, side);
  }
};

/// Judges in space, by the opposite-angle sum; flips must not fold the surface over, or move it too
/// far.
template <typename Real>
struct SurfaceRule : AnglePoints<Real>
{
  using AnglePoints<Real>::Get;
  static constexpr bool MayBlock = true;
  static constexpr bool IsInSpace = true;

  double MaximumDeviation = INFINITY; ///< None.

  DELAUNAYFLIP_HOST_DEVICE EdgeState Judge(const Quad& quad) const
  {
    const QuadPoints points = this->Get(quad);
#if !DELAUNAYFLIP_ON_DEVICE // where some edge of a warp would always need the rest
    if (this->Range == CoordinateRange::Usual && AreAcute(points))
    {
      return EdgeState::Good;
    }
#endif
    const AngleSum sum(points);
    if (!this->ExceedsPi(quad, sum))
    {
      return EdgeState::Good;
    }
    const bool folds = this->IsWide(quad, sum) ? this->FoldsOverWide(quad) : FoldsOver(points);
    if (folds)
    {
      return EdgeState::BlockedByShape;
    }
    if (this->MaximumDeviation < INFINITY && this->MovesTooFar(quad))
    {
      return EdgeState::BlockedByDeviation;
    }
    return EdgeState::Bad;
  }

  DELAUNAYFLIP_HOST_DEVICE EdgeState JudgeExactly(const Quad& quad) const
  {
    return this->Judge(quad);
  }

private:
  DELAUNAYFLIP_HOST_DEVICE DELAUNAYFLIP_NO_INLINE bool FoldsOverWide(const Quad& quad) const
  {
    return delaunayflip::FoldsOverWide(this->Get(quad));
  }

  DELAUNAYFLIP_HOST_DEVICE DELAUNAYFLIP_NO_INLINE bool MovesTooFar(const Quad& quad) const
  {
    return delaunayflip::MovesTooFar(this->Get(quad), this->MaximumDeviation);
  }
};

//------------------------------------------------------------------------------
/// Which rule judges a mesh.
struct RuleChoice
{
  /// @param center TriangleMesh::Center; only spheres use it.
  RuleChoice(const MeshSurvey& survey, const FlipOptions& options,
    const PlanePoint& center = { 0.0, 0.0, 0.0 })
    : IsSurface(survey.Geometry == GeometryKind::Surface),
      IsSphere(survey.Geometry == GeometryKind::Sphere),
      Center(center),
      ByAngles(options.Criterion == CriterionKind::OppositeAngles),
      IsTilted(survey.Projection.Tilted),
      IsCanonical(options.TieRule == TieRuleKind::Canonical),
      FiltersApply(survey.FiltersApply),
      Range(survey.Range),
      Tolerance(options.Tolerance < 0.0
          ? AngleTolerance{ 0.0, 1.0, survey.Precision }
          : AngleTolerance{ Sine(options.Tolerance), Cosine(options.Tolerance), 0.0 }),
      MaximumDeviation(options.MaximumDeviation < 1e299 ? options.MaximumDeviation : INFINITY)
  {
  }

  /// Calls visit(rule) for packed coordinates (PlanPacking), of one type or the other.
  /// @param uniformSide PlanarSurvey::UniformSide or SphereSurvey::UniformSide.
  template <typename Function>
  auto Visit(
    const float* floats, const double* doubles, int uniformSide, const Function& visit) const
  {
    if (this->IsSurface && floats)
    {
      return visit(
        SurfaceRule<float>{ { floats, this->Tolerance, this->Range }, this->MaximumDeviation });
    }
    if (this->IsSurface)
    {
      return visit(
        SurfaceRule<double>{ { doubles, this->Tolerance, this->Range }, this->MaximumDeviation });
    }
    if (this->IsSphere && floats)
    {
      return visit(SphereRule<float>{
        floats, this->Center, uniformSide, this->IsCanonical, this->FiltersApply });
    }
    if (this->IsSphere)
    {
      return visit(SphereRule<double>{
        doubles, this->Center, uniformSide, this->IsCanonical, this->FiltersApply });
    }
    if (this->ByAngles)
    {
      return visit(PlanarAngleRule{ { doubles, this->Tolerance, this->Range } });
    }
    if (this->IsTilted)
    {
      return visit(
        PlanarRule<double, 3>{ doubles, uniformSide, this->IsCanonical, this->FiltersApply });
    }
    if (floats)
    {
      return visit(
        PlanarRule<float, 2>{ floats, uniformSide, this->IsCanonical, this->FiltersApply });
    }
    return visit(
      PlanarRule<double, 2>{ doubles, uniformSide, this->IsCanonical, this->FiltersApply });
  }

  bool IsSurface, IsSphere;
  PlanePoint Center;
  bool ByAngles, IsTilted, IsCanonical, FiltersApply;
  CoordinateRange Range;
  AngleTolerance Tolerance;
  double MaximumDeviation;
};

}

#endif
