// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PRECISECAVITY_H
#define DELAUNAYFLIP_PRECISECAVITY_H

#include "PlaceCavity.h"
#include "PlaceFrame.h"
#include "PlaneMesh.h"

#include <cmath>

/// @file
/// The cavity of a place with areas of twice the digits, for places where doubles do not suffice:
/// in triangles with a vertex that is very far away, centres are so far away that areas cancel.

namespace delaunayflip
{

/// A number with about 32 digits: a double, and what its rounding has taken (Dekker 1971).
struct PreciseNumber
{
  double High, Low;
};

/// The sum of a number and a far smaller one.
DELAUNAYFLIP_HOST_DEVICE inline PreciseNumber MakePrecise(double high, double low)
{
  const double sum = high + low;
  return { sum, low - (sum - high) };
}

DELAUNAYFLIP_HOST_DEVICE inline PreciseNumber operator-(const PreciseNumber& a)
{
  return { -a.High, -a.Low };
}

/// a - b of doubles, exactly.
DELAUNAYFLIP_HOST_DEVICE inline PreciseNumber SubtractExactly(double a, double b)
{
  const double difference = a - b;
  return { difference, GetDifferenceError(a, b, difference) };
}

/// Keeps the digits also where the high parts cancel.
DELAUNAYFLIP_HOST_DEVICE inline PreciseNumber operator-(
  const PreciseNumber& a, const PreciseNumber& b)
{
  const PreciseNumber high = SubtractExactly(a.High, b.High);
  const PreciseNumber low = SubtractExactly(a.Low, b.Low);
  const PreciseNumber sum = MakePrecise(high.High, high.Low + low.High);
  return MakePrecise(sum.High, sum.Low + low.Low);
}
DELAUNAYFLIP_HOST_DEVICE inline PreciseNumber operator+(
  const PreciseNumber& a, const PreciseNumber& b)
{
  return a - (-b);
}

DELAUNAYFLIP_HOST_DEVICE inline PreciseNumber operator*(
  const PreciseNumber& a, const PreciseNumber& b)
{
  const double product = a.High * b.High;
  return MakePrecise(
    product, GetProductError(a.High, b.High, product) + (a.High * b.Low + a.Low * b.High));
}

/// By long division, with three digits that are doubles.
DELAUNAYFLIP_HOST_DEVICE inline PreciseNumber operator/(
  const PreciseNumber& a, const PreciseNumber& b)
{
  const double first = a.High / b.High;
  PreciseNumber rest = a - b * PreciseNumber{ first, 0.0 };
  const double second = rest.High / b.High;
  rest = rest - b * PreciseNumber{ second, 0.0 };
  const PreciseNumber leading = MakePrecise(first, second);
  return leading + PreciseNumber{ rest.High / b.High, 0.0 };
}

/// A vector.
struct PreciseOffset
{
  PreciseNumber U, V;
};

DELAUNAYFLIP_HOST_DEVICE inline PreciseOffset operator-(
  const PreciseOffset& a, const PreciseOffset& b)
{
  return { a.U - b.U, a.V - b.V };
}

DELAUNAYFLIP_HOST_DEVICE inline PlaceOffset Round(const PreciseOffset& offset)
{
  return { offset.U.High, offset.V.High };
}

DELAUNAYFLIP_HOST_DEVICE inline PreciseNumber FindCross(
  const PreciseOffset& a, const PreciseOffset& b)
{
  return a.U * b.V - a.V * b.U;
}

/// The centre of the circle through the origin and two points.
DELAUNAYFLIP_HOST_DEVICE inline PreciseOffset FindCentre(
  const PreciseOffset& a, const PreciseOffset& b)
{
  const PreciseNumber squareOfA = a.U * a.U + a.V * a.V, squareOfB = b.U * b.U + b.V * b.V;
  const PreciseNumber factor = PreciseNumber{ 0.5, 0.0 } / FindCross(a, b);
  return { (b.V * squareOfA - a.V * squareOfB) * factor,
    (a.U * squareOfB - b.U * squareOfA) * factor };
}

/// PolygonArea with twice the digits.
class PrecisePolygonArea
{
public:
  DELAUNAYFLIP_HOST_DEVICE explicit PrecisePolygonArea(const PreciseOffset& first)
    : First(first),
      Last(first)
  {
  }

  DELAUNAYFLIP_HOST_DEVICE void Add(const PreciseOffset& corner)
  {
    const PreciseOffset step = corner - this->Last;
    const bool isNearer = FindSize(Round(corner)) < FindSize(Round(this->Last));
    this->Twice = this->Twice + FindCross(isNearer ? corner : this->Last, step);
    this->Last = corner;
  }

  /// Closes the polygon.
  DELAUNAYFLIP_HOST_DEVICE double GetTwice()
  {
    this->Add(this->First);
    return this->Twice.High;
  }

private:
  PreciseOffset First, Last;
  PreciseNumber Twice = { 0.0, 0.0 };
};

/// WeightCheck for weights of which only that of a vertex very far away may have lost digits. There
/// its product with the offset is large, although the weight hardly counts. So the sum is compared
/// with all weights at the farthest vertex.
class FarWeightCheck
{
public:
  DELAUNAYFLIP_HOST_DEVICE void Add(double weight, const PreciseOffset& offset)
  {
    this->SumU += weight * offset.U.High;
    this->SumV += weight * offset.V.High;
    this->Weights += std::fabs(weight);
    const double size = FindSize(Round(offset));
    if (size > this->Farthest)
    {
      this->Farthest = size;
    }
  }

  DELAUNAYFLIP_HOST_DEVICE bool IsGood() const
  {
    return AreSmallSums(this->SumU, this->SumV, this->Weights * this->Farthest);
  }

private:
  double SumU = 0.0, SumV = 0.0, Weights = 0.0, Farthest = 0.0;
};

/// What PlaceCavity is, with twice the digits and without what saves time.
template <typename Frame>
class PreciseCavity
{
public:
  using Centre = PreciseOffset;
  using Area = PrecisePolygonArea;
  using Check = FarWeightCheck;

  struct Vertex
  {
    PreciseOffset Offset;
  };

  static constexpr int NotKept = -1;

  /// @param triangle has the place.
  DELAUNAYFLIP_HOST_DEVICE PreciseCavity(const Frame& frame, TriangleId triangle)
    : Seen(frame),
      Begin(triangle)
  {
  }

  DELAUNAYFLIP_HOST_DEVICE Vertex See(CornerId corner) const
  {
    const ScaledPoint point = this->Seen.GetPoint(this->Seen.GetVertex(corner));
    const ScaledPoint place = this->Seen.GetPlace();
    return { { SubtractExactly(point.U, place.U), SubtractExactly(point.V, place.V) } };
  }

  /// The centre of the circumcircle of a triangle of the cavity, from the place. It is found from
  /// the nearest vertex: from one that is very far away, both others have the same direction.
  DELAUNAYFLIP_HOST_DEVICE PreciseOffset GetCentre(TriangleId triangle, int&) const
  {
    PreciseOffset offsets[3];
    int nearest = 0;
    for (int slot = 0; slot < 3; ++slot)
    {
      offsets[slot] = this->See(MakeCorner(triangle, slot)).Offset;
      if (FindSize(Round(offsets[slot])) < FindSize(Round(offsets[nearest])))
      {
        nearest = slot;
      }
    }
    const PreciseOffset& origin = offsets[nearest];
    const PreciseOffset centre =
      FindCentre(offsets[NextSlot(nearest)] - origin, offsets[PreviousSlot(nearest)] - origin);
    return { origin.U + centre.U, origin.V + centre.V };
  }

  /// The centre of the triangle that an edge of the boundary makes with the place.
  DELAUNAYFLIP_HOST_DEVICE PreciseOffset FindNewCentre(const Vertex& from, const Vertex& to) const
  {
    return FindCentre(from.Offset, to.Offset);
  }

  /// The corner on the other side of the edge opposite a corner of the cavity, if its triangle is
  /// in the cavity, too; else NoCorner.
  DELAUNAYFLIP_HOST_DEVICE CornerId FindWithin(CornerId corner, int&) const
  {
    const CornerId across = this->Seen.FindBeyond(corner);
    const bool isWithin =
      across != NoCorner && (TriangleOf(across) == this->Begin || this->Seen.IsInCircle(across));
    return isWithin ? across : NoCorner;
  }

private:
  const Frame Seen;
  const TriangleId Begin;
};

}

#endif
