// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_FILTEREDPREDICATES_H
#define DELAUNAYFLIP_FILTEREDPREDICATES_H

#include "HostDevice.h"

#include <cmath>

/// @file
/// Points and vectors, and signs that double arithmetic can certify. Error bounds: Shewchuk 1997,
/// Table 2 and Fig. 21, with 1/1000 added for the terms that underflow.

namespace delaunayflip
{

/// Whether a number is neither NaN nor infinite. Only then is its difference with itself 0.
DELAUNAYFLIP_HOST_DEVICE inline bool IsFinite(double number) { return number - number == 0.0; }

/// The power of two below a positive number, as std::ilogb; 0 for numbers that have none.
DELAUNAYFLIP_HOST_DEVICE inline int ExponentOf(double number)
{
  if (number > 0.0 && IsFinite(number))
  {
    return std::ilogb(number);
  }
  return 0;
}

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

/// What a filter returns when it cannot decide.
constexpr int UncertainSign = 2;

/// A point in the plane in which edges are judged: u and v span it; W is the coordinate along the
/// dropped axis, which only the lift of tilted planes uses. Predicates in space use it for x, y, z.
struct PlanePoint
{
  double U, V, W;
};

/// Underflow of a product loses at most 2^-1074, times cofactors below 2^502 when coordinate
/// differences stay below 2^250: a determinant this large is not affected. Meshes with larger
/// differences do not use the filters (MeshSurvey::FiltersApply).
constexpr double SmallestCertifiable = 3.0549363634996047e-151; // 2^-500
constexpr double LargestFilteredDifference = 1.8092513943330656e75; // 2^250

/// Coordinates up to here have differences of that size.
constexpr double LargestFilteredCoordinate = LargestFilteredDifference / 2;

/// Whether the filters may be used for the point's u and v.
DELAUNAYFLIP_HOST_DEVICE inline bool IsInFilterRange(const PlanePoint& point)
{
  return std::fabs(point.U) <= LargestFilteredCoordinate &&
    std::fabs(point.V) <= LargestFilteredCoordinate;
}

/// Whether the filters may be used for all three coordinates.
DELAUNAYFLIP_HOST_DEVICE inline bool IsInFilterRange3D(const PlanePoint& point)
{
  return IsInFilterRange(point) && std::fabs(point.W) <= LargestFilteredCoordinate;
}

DELAUNAYFLIP_HOST_DEVICE inline bool IsFinite(const PlanePoint& point)
{
  return IsFinite(point.U) && IsFinite(point.V) && IsFinite(point.W);
}

/// Bounds of the errors, relative to the sum of the products' magnitudes, with eps = 2^-53:
/// (3 + 16 eps) eps for orientations in the plane, (7 + 56 eps) eps in space, and (10 + 96 eps) eps
/// for in-circle tests. The lift of a tilted plane has one product and two sums more:
/// (12 + 128 eps) eps.
constexpr double OrientationBound = 3.34e-16;
constexpr double SpaceOrientationBound = 7.78e-16;
constexpr double InCircleBound = 1.112e-15;
constexpr double TiltedInCircleBound = 1.56e-15;

/// What a determinant must exceed for its sign to be certain.
DELAUNAYFLIP_HOST_DEVICE inline double GetBound(double error)
{
  return error + SmallestCertifiable;
}

/// The sign of a determinant, or UncertainSign if the error may exceed it. This has no branches,
/// because they would be mispredicted half of the time.
DELAUNAYFLIP_HOST_DEVICE inline int CertifiedSign(double determinant, double error)
{
  const double bound = GetBound(error);
  const int positive = int(determinant > bound);
  const int negative = int(-determinant > bound);
  return positive - negative + UncertainSign * (1 - positive - negative);
}

/// Orientation of a, b, c in (u, v), or UncertainSign.
DELAUNAYFLIP_HOST_DEVICE inline int FilteredOrientation(
  const PlanePoint& a, const PlanePoint& b, const PlanePoint& c)
{
  const double left = (a.U - c.U) * (b.V - c.V);
  const double right = (a.V - c.V) * (b.U - c.U);
  return CertifiedSign(left - right, OrientationBound * (std::fabs(left) + std::fabs(right)));
}

/// Sum and permanent of the 3 x 3 determinant with rows (u, v, lift) relative to a fourth point.
struct FilteredDeterminant
{
  double Value = 0.0;
  double Permanent = 0.0;
};

/// The determinant of FilteredInCircle.
template <bool Tilted = false>
DELAUNAYFLIP_HOST_DEVICE inline FilteredDeterminant InCircleDeterminant(
  const PlanePoint& a, const PlanePoint& b, const PlanePoint& c, const PlanePoint& d)
{
  const double au = a.U - d.U, av = a.V - d.V;
  const double bu = b.U - d.U, bv = b.V - d.V;
  const double cu = c.U - d.U, cv = c.V - d.V;
  FilteredDeterminant determinant;
  const auto addTerm = [&](double u, double v, double atP, double first, double second)
  {
    const double square = u * u + v * v;
    double lift = square;
    double magnitude = square;
    if constexpr (Tilted)
    {
      const double w = (atP - d.W) * (atP + d.W);
      lift += w;
      magnitude += std::fabs(w);
    }
    determinant.Value += lift * (first - second);
    determinant.Permanent += magnitude * (std::fabs(first) + std::fabs(second));
  };
  addTerm(au, av, a.W, bu * cv, cu * bv);
  addTerm(bu, bv, b.W, cu * av, au * cv);
  addTerm(cu, cv, c.W, au * bv, bu * av);
  return determinant;
}

/// Sign of the in-circle determinant of a, b, c, d in (u, v), or UncertainSign.
/// @tparam Tilted whether W belongs to the lift: the difference of squared lengths, up to what is
/// linear in u and v.
template <bool Tilted = false>
DELAUNAYFLIP_HOST_DEVICE inline int FilteredInCircle(
  const PlanePoint& a, const PlanePoint& b, const PlanePoint& c, const PlanePoint& d)
{
  const FilteredDeterminant determinant = InCircleDeterminant<Tilted>(a, b, c, d);
  constexpr double Bound = Tilted ? TiltedInCircleBound : InCircleBound;
  return CertifiedSign(determinant.Value, Bound * determinant.Permanent);
}

/// Sign of the determinant with rows a - d, b - d and c - d, with W as the third coordinate, or
/// UncertainSign. See Orientation3D in Predicates.h.
DELAUNAYFLIP_HOST_DEVICE inline int FilteredOrientation3D(
  const PlanePoint& a, const PlanePoint& b, const PlanePoint& c, const PlanePoint& d)
{
  const double au = a.U - d.U, av = a.V - d.V;
  const double bu = b.U - d.U, bv = b.V - d.V;
  const double cu = c.U - d.U, cv = c.V - d.V;
  FilteredDeterminant determinant;
  const auto addTerm = [&](double w, double first, double second)
  {
    determinant.Value += w * (first - second);
    determinant.Permanent += std::fabs(w) * (std::fabs(first) + std::fabs(second));
  };
  addTerm(a.W - d.W, bu * cv, cu * bv);
  addTerm(b.W - d.W, cu * av, au * cv);
  addTerm(c.W - d.W, au * bv, bu * av);
  return CertifiedSign(determinant.Value, SpaceOrientationBound * determinant.Permanent);
}

}

#endif
