// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_TRIANGLESHAPE_H
#define DELAUNAYFLIP_TRIANGLESHAPE_H

#include "PlaneMesh.h"
#include "PortableMath.h"

#include <cmath>
#include <cstdint>
#include <cstring>

/// @file
/// Which triangles refinement improves, in which order, and where it puts a point for each.

namespace delaunayflip
{

/// What all triangles shall be like. Infinity is no limit.
struct RefinementGoals
{
  double Cotangent = INFINITY; ///< That of the smallest angle.
  /// How far the point for a triangle may be from the middle of its shortest edge, in lengths of
  /// that edge. The point is then the off-center of Üngör (2004): it and the edge make a triangle
  /// with a smallest angle a little above the goal.
  double OffCenter = INFINITY;
  double Area = INFINITY; ///< That of the largest triangle.
  double SquaredEdge = INFINITY; ///< That of the longest edge.
  /// Whether the angle is so large that triangles may become ever smaller towards a corner.
  bool MayNotEnd = false;
};

/// The goals for an angle in degrees; 0: none.
inline void SetSmallestAngle(double degrees, RefinementGoals& goals)
{
  if (degrees > 0.0)
  {
    constexpr double RadiansPerDegree = 0.017453292519943295;
    // Below 1/2, since rounding must not make the angle smaller than the goal; as in Triangle.
    constexpr double Share = 0.475;
    const double angle = degrees * RadiansPerDegree;
    goals.Cotangent = 1.0 / Tangent(angle);
    goals.OffCenter = Share / Tangent(0.5 * angle);
    constexpr double LargestSafe = 30.0;
    goals.MayNotEnd = degrees > LargestSafe;
  }
}

/// A triangle, seen from its shortest edge.
struct TriangleShape
{
  PlanePoint Apex, From, To; ///< Counter-clockwise; the shortest edge runs from From to To.
  int Slot; ///< That of the apex.
  double SquaredShortest, SquaredLongest;
  double Dot, Cross; ///< Products of the two edges at the apex, where the smallest angle is.

  DELAUNAYFLIP_HOST_DEVICE DELAUNAYFLIP_ALWAYS_INLINE TriangleShape(
    const PlaneMesh& mesh, TriangleId triangle)
  {
    const TriangleRecord& record = mesh.Edges.Triangles[triangle];
    const PlanePoint corners[3] = { mesh.GetPoint(record.Vertices[0]),
      mesh.GetPoint(record.Vertices[1]), mesh.GetPoint(record.Vertices[2]) };
    const double squared[3] = { GetSquaredDistance(corners[1], corners[2]),
      GetSquaredDistance(corners[2], corners[0]), GetSquaredDistance(corners[0], corners[1]) };
    // Which edge is the shortest cannot be predicted, so this has no branches.
    const int shorter = squared[1] < squared[0] ? 1 : 0;
    this->Slot = squared[2] < squared[shorter] ? 2 : shorter;
    this->SquaredShortest = squared[this->Slot];
    const double longer = squared[1 - shorter];
    this->SquaredLongest = squared[2] > longer ? squared[2] : longer;
    this->Apex = corners[this->Slot];
    this->From = corners[NextSlot(this->Slot)];
    this->To = corners[PreviousSlot(this->Slot)];
    const double u1 = this->From.U - this->Apex.U, v1 = this->From.V - this->Apex.V;
    const double u2 = this->To.U - this->Apex.U, v2 = this->To.V - this->Apex.V;
    this->Dot = u1 * u2 + v1 * v2;
    this->Cross = u1 * v2 - v1 * u2;
  }

  DELAUNAYFLIP_HOST_DEVICE static double GetSquaredDistance(
    const PlanePoint& a, const PlanePoint& b)
  {
    const double u = b.U - a.U, v = b.V - a.V;
    return u * u + v * v;
  }

  DELAUNAYFLIP_HOST_DEVICE bool IsSharperThan(double cotangent) const
  {
    return this->Dot > cotangent * this->Cross;
  }

  /// Whether doubles can hold the squares of the triangle's lengths.
  DELAUNAYFLIP_HOST_DEVICE bool IsMeasurable() const
  {
    constexpr double Least = 0x1p-1000;
    return this->SquaredLongest >= Least && this->SquaredLongest < INFINITY;
  }

  DELAUNAYFLIP_HOST_DEVICE PlanePoint FindCentroid() const
  {
    constexpr double Third = 1.0 / 3.0;
    return { this->Apex.U + Third * ((this->From.U - this->Apex.U) + (this->To.U - this->Apex.U)),
      this->Apex.V + Third * ((this->From.V - this->Apex.V) + (this->To.V - this->Apex.V)), 0.0 };
  }

  DELAUNAYFLIP_HOST_DEVICE double GetArea() const { return 0.5 * this->Cross; }

  /// The place that improves the triangle: its circumcenter, or an off-center nearer to the
  /// shortest edge. Both are on the bisector of that edge. Without a goal for angles, the place is
  /// not farther away than half of the longest edge, so that obtuse triangles are halved.
  DELAUNAYFLIP_HOST_DEVICE PlanePoint FindCenter(double offCenter) const
  {
    double distance = 0.5 * this->Dot / this->Cross; // of the circumcenter, in lengths of the edge
    const bool hasLimit = offCenter < INFINITY;
    const double limit =
      hasLimit ? offCenter : 0.5 * std::sqrt(this->SquaredLongest / this->SquaredShortest);
    const bool isNear = this->Cross > 0.0 && distance < limit;
    distance = isNear ? distance : limit;
    const double u = this->To.U - this->From.U, v = this->To.V - this->From.V;
    return { this->From.U + 0.5 * u - distance * v, this->From.V + 0.5 * v + distance * u, 0.0 };
  }
};

/// The bits of a number that is not negative, which are ordered like these numbers.
DELAUNAYFLIP_HOST_DEVICE inline std::uint64_t ToSortableBits(double number)
{
  std::uint64_t bits = 0;
  std::memcpy(&bits, &number, sizeof(bits));
  return bits;
}

/// Numbers items in an order that looks random. UnshuffleItem is the inverse.
DELAUNAYFLIP_HOST_DEVICE inline std::uint32_t ShuffleItem(std::int64_t item)
{
  constexpr std::uint32_t Odd = 2654435769u; // 2^32 over the golden ratio, by Knuth
  return static_cast<std::uint32_t>(item) * Odd;
}
DELAUNAYFLIP_HOST_DEVICE inline std::uint32_t UnshuffleItem(std::uint32_t shuffled)
{
  constexpr std::uint32_t Inverse = 340573321u; // of that number, modulo 2^32
  return shuffled * Inverse;
}

/// The rank of the place for a triangle. If places exclude each other, the one with the lowest rank
/// is inserted. Places for small angles come first, by the shortest edge; places for large
/// triangles follow, the largest first. Many places have the same rank, so that many can be
/// inserted at a time. Ranks have RefinementKey::RankBits bits and are not 0.
DELAUNAYFLIP_HOST_DEVICE inline std::uint32_t FindRank(const TriangleShape& shape, bool isSharp)
{
  constexpr std::uint32_t Infinite = 0x7F800000u, SecondClass = 0x80000000u;
  constexpr int UnusedBits = 22; // one bit of the fraction is left
  const auto squared = static_cast<float>(isSharp ? shape.SquaredShortest : shape.SquaredLongest);
  std::uint32_t bits = 0;
  std::memcpy(&bits, &squared, sizeof(bits));
  const std::uint32_t rank = isSharp ? bits : SecondClass + (Infinite - bits);
  return (rank >> UnusedBits) + 1;
}

/// The key with which a place claims triangles. The lowest key wins. Its highest bits make it lower
/// than all keys of earlier rounds, so that claims need not be cleared. The rank follows, and then
/// the shuffled number of the item, so that all keys are different.
struct RefinementKey
{
  static constexpr int RankBits = 10, RoundShift = 32 + RankBits;
  static constexpr std::uint64_t MostRounds = (std::uint64_t(1) << (64 - RoundShift)) - 1;
  static constexpr std::uint64_t None =
    ~std::uint64_t(0); ///< The key of triangles without a claim.

  /// @param round from 1 to MostRounds.
  DELAUNAYFLIP_HOST_DEVICE static std::uint64_t Make(
    std::uint64_t round, std::uint32_t rank, std::int64_t item)
  {
    const std::uint64_t place = (MostRounds - round) << RankBits;
    return ((place | rank) << 32) | ShuffleItem(item);
  }
  DELAUNAYFLIP_HOST_DEVICE static std::uint32_t GetItem(std::uint64_t key)
  {
    return UnshuffleItem(static_cast<std::uint32_t>(key));
  }
};

}

#endif
