// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_FLIPRULES_H
#define DELAUNAYFLIP_FLIPRULES_H

#include "EdgeMesh.h"
#include "ExactPredicates.h"
#include "HostDevice.h"
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
DELAUNAYFLIP_HOST_DEVICE int FindTurnBy(
  const PlanePoint& a, const PlanePoint& b, const PlanePoint& c)
{
  return Kind == SignKind::Exact ? ExactOrientation(a, b, c) : FilteredOrientation(a, b, c);
}

/// The side to which the two triangles of a quad turn: 1 or -1; 0 if they turn to different sides
/// or neither has an area; or UncertainSign. `strict` receives whether both have an area.
template <SignKind Kind>
DELAUNAYFLIP_HOST_DEVICE int FindSide(const PlanePoint (&apqb)[4], bool& strict)
{
  const int upper = FindTurnBy<Kind>(apqb[0], apqb[1], apqb[2]);
  const int lower = FindTurnBy<Kind>(apqb[3], apqb[2], apqb[1]);
  strict = upper != 0 && lower != 0;
  if (upper == UncertainSign || lower == UncertainSign)
  {
    return UncertainSign;
  }
  return upper * lower < 0 ? 0 : (upper != 0 ? upper : lower);
}

/// BlockedByShape unless both triangles of the flipped quad turn to `side`.
template <SignKind Kind>
DELAUNAYFLIP_HOST_DEVICE EdgeState CheckConvex(const PlanePoint (&apqb)[4], int side)
{
  const int left = FindTurnBy<Kind>(apqb[0], apqb[1], apqb[3]);
  const int right = FindTurnBy<Kind>(apqb[3], apqb[2], apqb[0]);
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

/// Whether the edge p-q spans both opposite vertices, so that the flip shortens it. Either may lie
/// at an end of it. Both triangles have no area, and the four points lie in one line.
DELAUNAYFLIP_HOST_DEVICE inline bool SpansOpposite(const PlanePoint (&apqb)[4])
{
  // Along a line the lexicographic order is that of the points on it.
  const bool forward = IsLexicographicallyLess(apqb[1], apqb[2]);
  const PlanePoint first = forward ? apqb[1] : apqb[2];
  const PlanePoint last = forward ? apqb[2] : apqb[1];
  const bool sorted = IsLexicographicallyLess(apqb[0], apqb[3]);
  const PlanePoint lower = sorted ? apqb[0] : apqb[3];
  const PlanePoint upper = sorted ? apqb[3] : apqb[0];
  const bool startsLater = IsLexicographicallyLess(first, lower);
  const bool endsEarlier = IsLexicographicallyLess(upper, last);
  return !IsLexicographicallyLess(lower, first) && !IsLexicographicallyLess(last, upper) &&
    (startsLater || endsEarlier);
}

/// The canonical diagonal of four points on a circle is the one without the lexicographically
/// largest point.
DELAUNAYFLIP_HOST_DEVICE inline bool EdgeHoldsLargest(const PlanePoint (&apqb)[4])
{
  // Not a reference to the larger one: for that a device would have to store the points in memory.
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
  int UniformSide; ///< 1 or -1 when every triangle turns to that side, 0 if unknown.
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
    return this->FiltersApply ? this->Decide<SignKind::Filtered>(quad) : EdgeState::Uncertain;
  }

  DELAUNAYFLIP_HOST_DEVICE EdgeState JudgeExactly(const Quad& quad) const
  {
    return this->Decide<SignKind::Exact>(quad);
  }

private:
  /// In the plane, if in-circle > 0, one triangle has an area, and the other is not turned over,
  /// the quad is strictly convex. With a tilted lift, points off the plane can break this.
  template <SignKind Kind>
  DELAUNAYFLIP_HOST_DEVICE EdgeState Decide(const Quad& quad) const
  {
    const PlanePoint apqb[4] = { this->Get(quad.A), this->Get(quad.P), this->Get(quad.Q),
      this->Get(quad.B) };
    bool strict = true;
    const int side = this->UniformSide != 0 ? this->UniformSide : FindSide<Kind>(apqb, strict);
    const int inCircle = Kind == SignKind::Exact
      ? ExactInCircle(apqb, Tilted)
      : FilteredInCircle<Tilted>(apqb[0], apqb[1], apqb[2], apqb[3]);
    if (side == UncertainSign || inCircle == UncertainSign)
    {
      return EdgeState::Uncertain;
    }
    // A selection instead of a branch, which would be mispredicted half of the time.
    EdgeState state = inCircle * side > 0 ? EdgeState::Bad : EdgeState::Good;
    if (side == 0)
    {
      return !strict && SpansOpposite(apqb) ? EdgeState::Bad : EdgeState::Good;
    }
    if (inCircle == 0 && this->Canonical && strict)
    {
      state = EdgeHoldsLargest(apqb) ? EdgeState::Bad : EdgeState::Good;
    }
    return Tilted && state == EdgeState::Bad ? CheckConvex<Kind>(apqb, side) : state;
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
    return this->ExceedsPi(quad, sum) ? EdgeState::Uncertain : EdgeState::Good;
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
      return !strict && SpansOpposite(apqb) ? EdgeState::Bad : EdgeState::Good;
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
    return this->MaximumDeviation < INFINITY && this->MovesTooFar(quad)
      ? EdgeState::BlockedByDeviation
      : EdgeState::Bad;
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

}

#endif
