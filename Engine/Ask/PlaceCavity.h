// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PLACECAVITY_H
#define DELAUNAYFLIP_PLACECAVITY_H

#include "PlaceFrame.h"
#include "PlaneMesh.h"

#include <cmath>

/// @file
/// The cavity that an insertion of a place would make in a triangulation, and areas in it.

namespace delaunayflip
{

/// The centre of the circle through three points, as a vector from the first one.
/// @param a, b the others, as seen from the first. @param cross that of their offsets.
DELAUNAYFLIP_HOST_DEVICE inline PlaceOffset FindCentre(
  const ScaledPoint& origin, const SeenPoint& a, const SeenPoint& b, const CrossProduct& cross)
{
  const double factor = 0.5 / FindTwiceArea(origin, a, b, cross);
  return { (b.Offset.V * a.Square - a.Offset.V * b.Square) * factor,
    (a.Offset.U * b.Square - b.Offset.U * a.Square) * factor };
}

DELAUNAYFLIP_HOST_DEVICE inline PlaceOffset FindCentre(
  const ScaledPoint& origin, const SeenPoint& a, const SeenPoint& b)
{
  return FindCentre(origin, a, b, CrossProduct(a.Offset, b.Offset));
}

/// The centre of the circumcircle of a triangle, from the place. All callers must begin with the
/// corner of slot 0, so that a centre has the same bits wherever it is found.
template <typename Frame>
DELAUNAYFLIP_HOST_DEVICE DELAUNAYFLIP_ALWAYS_INLINE PlaceOffset FindCentre(
  const Frame& frame, const ScaledPoint& first, const ScaledPoint& second, const ScaledPoint& third)
{
  const PlaceOffset centre = FindCentre(first, { second, first }, { third, first });
  const PlaceOffset toFirst = Subtract(first, frame.GetPlace());
  return { toFirst.U + centre.U, toFirst.V + centre.V };
}

/// A corner of a polygon, from the place.
struct AreaCorner
{
  AreaCorner() = default;
  DELAUNAYFLIP_HOST_DEVICE AreaCorner(const PlaceOffset& offset)
    : Offset(offset),
      Size(FindSize(offset))
  {
  }

  PlaceOffset Offset;
  double Size;
};

/// What an edge of a polygon adds to twice its area.
class AreaStep
{
public:
  AreaStep() = default;
  DELAUNAYFLIP_HOST_DEVICE DELAUNAYFLIP_ALWAYS_INLINE AreaStep(
    const AreaCorner& from, const AreaCorner& to)
  {
    // Corners may be very far away. The nearer one as the factor loses least.
    const PlaceOffset step = { to.Offset.U - from.Offset.U, to.Offset.V - from.Offset.V };
    const PlaceOffset& nearer = to.Size < from.Size ? to.Offset : from.Offset;
    const CrossProduct cross(nearer, step);
    this->Value = cross.Value;
    this->Rest = 0.0;
    if (cross.IsCancelled())
    {
      this->Rest = cross.GetRest(nearer, step);
    }
  }

  /// Returns a sum with this step added.
  DELAUNAYFLIP_HOST_DEVICE double Add(double sum) const { return (sum + this->Value) + this->Rest; }

  /// Returns a sum with the step in the other direction added.
  /// @param from where the other step starts. @param to where it ends.
  DELAUNAYFLIP_HOST_DEVICE double AddBack(
    double sum, const AreaCorner& from, const AreaCorner& to) const
  {
    if (from.Size == to.Size) // only then it may have another factor
    {
      return AreaStep(from, to).Add(sum);
    }
    return (sum - this->Value) - this->Rest;
  }

private:
  double Value, Rest;
};

/// Twice the area of a polygon. Its corners are told one after the other.
class PolygonArea
{
public:
  DELAUNAYFLIP_HOST_DEVICE explicit PolygonArea(const AreaCorner& first)
    : First(first),
      Last(first)
  {
  }

  DELAUNAYFLIP_HOST_DEVICE void Add(const AreaCorner& corner)
  {
    this->Twice = AreaStep(this->Last, corner).Add(this->Twice);
    this->Last = corner;
  }

  /// Closes the polygon.
  DELAUNAYFLIP_HOST_DEVICE double GetTwice()
  {
    this->Add(this->First);
    return this->Twice;
  }

private:
  AreaCorner First, Last;
  double Twice = 0.0;
};

/// Whether the components of a sum that is 0 in exact arithmetic are small.
/// @param size what they are relative to.
DELAUNAYFLIP_HOST_DEVICE inline bool AreSmallSums(double u, double v, double size)
{
  constexpr double Tolerance = 1e-10;
  constexpr double Least = 1e-200, Most = 1e200; // so that no sum underflows or overflows
  const double sum = FindSize({ u, v }); // may be NaN
  return sum <= Tolerance * size && size > Least && size < Most;
}

/// Whether weights and the offsets of their vertices fit together. In exact arithmetic the weighted
/// sum of the offsets is 0. Next to triangles that are nearly on one line, such as those along a
/// hull, centres are so far away that rounding can leave nothing of the areas.
class WeightCheck
{
public:
  DELAUNAYFLIP_HOST_DEVICE void Add(double weight, const PlaceOffset& offset)
  {
    this->SumU += weight * offset.U;
    this->SumV += weight * offset.V;
    this->Size += std::fabs(weight) * FindSize(offset);
  }

  DELAUNAYFLIP_HOST_DEVICE bool IsGood() const
  {
    return AreSmallSums(this->SumU, this->SumV, this->Size);
  }

private:
  double SumU = 0.0, SumV = 0.0, Size = 0.0;
};

/// The triangles with a place in their circumcircle that can be reached from the place without
/// crossing a segment: the ones that an insertion of the place would replace. No vertex is inside
/// of their union. So they form a tree, and their boundary is one ring. A walk along it comes to
/// each triangle three times, so the centres of the first ones are kept.
template <typename Frame>
class PlaceCavity
{
public:
  using Centre = PlaceOffset;
  using Vertex = SeenPoint;
  using Area = PolygonArea;
  using Check = WeightCheck;

  DELAUNAYFLIP_HOST_DEVICE explicit PlaceCavity(const Frame& frame)
    : Seen(frame)
  {
  }

  DELAUNAYFLIP_HOST_DEVICE ScaledPoint GetPoint(CornerId corner) const
  {
    return this->Seen.GetPoint(this->Seen.GetVertex(corner));
  }

  /// The vertex of a corner, as seen from the place.
  DELAUNAYFLIP_HOST_DEVICE SeenPoint See(CornerId corner) const
  {
    return { this->GetPoint(corner), this->Seen.GetPlace() };
  }

  /// The centre of the circumcircle of a triangle of the cavity, from the place.
  /// @param kept its number among the kept ones, or NotKept; becomes a number if there is room.
  DELAUNAYFLIP_HOST_DEVICE PlaceOffset GetCentre(TriangleId triangle, int& kept)
  {
    if (kept != NotKept)
    {
      return { this->KeptCentres[kept][0], this->KeptCentres[kept][1] };
    }
    const PlaceOffset centre = FindCentre(this->Seen, this->GetPoint(MakeCorner(triangle, 0)),
      this->GetPoint(MakeCorner(triangle, 1)), this->GetPoint(MakeCorner(triangle, 2)));
    if (this->NumberOfKept < MostKept)
    {
      kept = this->NumberOfKept++;
      this->Kept[kept] = triangle;
      this->KeptCentres[kept][0] = centre.U;
      this->KeptCentres[kept][1] = centre.V;
    }
    return centre;
  }

  /// The centre of the triangle that an edge of the boundary makes with the place.
  DELAUNAYFLIP_HOST_DEVICE PlaceOffset FindNewCentre(
    const SeenPoint& from, const SeenPoint& to) const
  {
    return FindCentre(this->Seen.GetPlace(), from, to);
  }

  /// The corner on the other side of the edge opposite a corner of the cavity, if its triangle is
  /// in the cavity, too; else NoCorner.
  /// @param kept becomes the number of that triangle, if there is one, as for GetCentre.
  DELAUNAYFLIP_HOST_DEVICE CornerId FindWithin(CornerId corner, int& kept) const
  {
    const CornerId across = this->Seen.FindBeyond(corner);
    if (across == NoCorner)
    {
      return NoCorner;
    }
    const int found = this->FindKept(TriangleOf(across));
    if (found != NotKept)
    {
      kept = found;
      return across;
    }
    if (!this->Seen.IsInCircle(across))
    {
      return NoCorner;
    }
    kept = NotKept;
    return across;
  }

  static constexpr int NotKept = -1;

private:
  static constexpr int MostKept = 8;

  DELAUNAYFLIP_HOST_DEVICE int FindKept(TriangleId triangle) const
  {
    for (int i = 0; i < this->NumberOfKept; ++i)
    {
      if (this->Kept[i] == triangle)
      {
        return i;
      }
    }
    return NotKept;
  }

  const Frame Seen; ///< A copy: through a reference, each access on a GPU would be one more load.
  int NumberOfKept = 0;
  TriangleId Kept[MostKept];
  double KeptCentres[MostKept][2];
};

}

#endif
