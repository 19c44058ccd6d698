// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_GEOMETRYCHOICE_H
#define DELAUNAYFLIP_GEOMETRYCHOICE_H

#include "Array.h"
#include "Atomics.h"
#include "EdgeMesh.h"
#include "ExactPredicates.h"
#include "FilteredPredicates.h"
#include "FlipError.h"
#include "FlipOptions.h"
#include "HostDevice.h"
#include "MeshSurvey.h"
#include "SpatialOrder.h"
#include "SurfaceAngles.h"
#include "TriangleMesh.h"
#include "WideAngles.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

/// @file
/// Chooses the space in which the edges of a mesh are judged, and says why: in a plane; over x and
/// y, if the mesh is a height field that is not steep; or as a surface. Decided before edges are
/// known. Only integers and maxima are computed, so that both backends come to the same answer.

namespace delaunayflip
{

/// Scales by a power of two, in two steps, so that the largest coordinate is in 1 .. 2 and lengths
/// neither overflow nor vanish. All backends scale alike.
struct PlaneScale
{
  double Factors[2] = { 1.0, 1.0 }; ///< Their product may be beyond the range of double.

  explicit PlaneScale(const BoundingBox& box)
  {
    double largest = 0.0;
    for (int axis = 0; axis < 3; ++axis)
    {
      largest = std::max({ largest, std::fabs(box.Lower[axis]), std::fabs(box.Upper[axis]) });
    }
    const int exponent = largest > 0.0 ? -std::ilogb(largest) : 0;
    this->Factors[0] = std::scalbn(1.0, exponent / 2);
    this->Factors[1] = std::scalbn(1.0, exponent - exponent / 2);
  }

  DELAUNAYFLIP_HOST_DEVICE Vector3 operator()(const Vector3& p) const
  {
    return this->Factors[1] * (this->Factors[0] * p);
  }

  double FindDiagonal(const BoundingBox& box) const
  {
    return Length((*this)({ box.Upper[0], box.Upper[1], box.Upper[2] }) -
      (*this)({ box.Lower[0], box.Lower[1], box.Lower[2] }));
  }
};

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

/// The turn of a, b, c in x and y. Also 0 if the filter finds almost no area and fixed-point
/// integers do not suffice, because a device has no wider ones.
DELAUNAYFLIP_HOST_DEVICE inline int FindTurn(const Vector3& a, const Vector3& b, const Vector3& c)
{
  const PlanePoint p{ a.X, a.Y, 0.0 }, q{ b.X, b.Y, 0.0 }, r{ c.X, c.Y, 0.0 };
  int sign = FilteredOrientation(p, q, r);
  if (sign == UncertainSign)
  {
    sign = FixedPointOrientation(p, q, r);
  }
  return sign == UncertainSign ? 0 : sign;
}

/// Whether a triangle slopes below 45 degrees: its plane or, of a sliver, its three edges. A sliver
/// is less than a fifth as high as its longest edge is long.
///
/// An edge joins two points of the terrain, so its slope is one that the terrain has. The plane of
/// a sliver may be steep in the gentlest terrain.
/// @param normal of length twice the area.
DELAUNAYFLIP_HOST_DEVICE inline bool IsGentle(const Vector3 (&corners)[3], const Vector3& normal)
{
  if (normal.Z * normal.Z > normal.X * normal.X + normal.Y * normal.Y)
  {
    return true;
  }
  constexpr double Fifth = 0.2;
  const double squaredArea = Dot(normal, normal);
  bool isSliver = false;
  bool areEdgesGentle = true;
  for (int slot = 0; slot < 3; ++slot)
  {
    const Vector3 edge = corners[(slot + 1) % 3] - corners[slot];
    const double square = Dot(edge, edge);
    // Without branches, which could not be predicted.
    isSliver |= squaredArea < Fifth * Fifth * square * square;
    areEdgesGentle &= edge.Z * edge.Z < edge.X * edge.X + edge.Y * edge.Y;
  }
  return isSliver && areEdgesGentle;
}

struct TurnSums
{
  TurnSample Turns; ///< In x and y.
  /// Area in space, in units of 2^-60: of all triangles, and of those that slope below 45 degrees.
  Integer128 All = 0, Gentle = 0;

  DELAUNAYFLIP_HOST_DEVICE TurnSums& operator+=(const TurnSums& part)
  {
    this->Turns += part.Turns;
    this->All += part.All;
    this->Gentle += part.Gentle;
    return *this;
  }
};

/// The finite triangles of the caller, scaled.
struct ScaledTriangles
{
  TriangleMesh Mesh;
  const PointUse* Uses; ///< Null: all points are finite.
  PlaneScale Scale; ///< Brings coordinates near 1, where the filters apply.

  DELAUNAYFLIP_HOST_DEVICE void Prefetch(std::int64_t t) const
  {
    for (int slot = 0; slot < 3; ++slot)
    {
      this->Mesh.Points.Prefetch(this->Mesh.Triangles.Get(t, slot));
    }
  }

  DELAUNAYFLIP_HOST_DEVICE bool IsFinite(std::int64_t t) const
  {
    return !this->Uses ||
      (this->Uses[this->Mesh.Triangles.Get(t, 0)] == PointUse::Used &&
        this->Uses[this->Mesh.Triangles.Get(t, 1)] == PointUse::Used &&
        this->Uses[this->Mesh.Triangles.Get(t, 2)] == PointUse::Used);
  }

  DELAUNAYFLIP_HOST_DEVICE Vector3 GetCorner(std::int64_t t, int slot) const
  {
    return this->Scale(LoadPoint(this->Mesh.Points, this->Mesh.Triangles.Get(t, slot)));
  }
};

/// Adds up the turn, area and slope of a triangle.
struct TurnStep
{
  ScaledTriangles Triangles;
  double Factor; ///< Power of two that brings the scaled bounding box's diagonal to 1 .. 2.
  int Up = 2; ///< The axis of heights, in the place of z.
  std::int64_t Stride = 1; ///< Every how many triangles one is taken.

  DELAUNAYFLIP_HOST_DEVICE void Prefetch(std::int64_t i) const
  {
    this->Triangles.Prefetch(i * this->Stride);
  }

  DELAUNAYFLIP_HOST_DEVICE void operator()(std::int64_t i, TurnSums& sums) const
  {
    const std::int64_t t = i * this->Stride;
    if (!this->Triangles.IsFinite(t))
    {
      return;
    }
    const Vector3 corners[3] = { this->GetCorner(t, 0), this->GetCorner(t, 1),
      this->GetCorner(t, 2) };
    sums.Turns.Note(FindTurn(corners[0], corners[1], corners[2]), t);
    const Vector3 normal = AreaVector(corners[0], corners[1], corners[2]);
    const double area = Length(normal) * this->Factor * this->Factor; // below 4
    const auto units = static_cast<std::int64_t>(0x1p60 * area);
    sums.All += units;
    sums.Gentle += IsGentle(corners, normal) ? units : 0;
  }

private:
  DELAUNAYFLIP_HOST_DEVICE Vector3 GetCorner(std::int64_t t, int slot) const
  {
    const Vector3 p = this->Triangles.GetCorner(t, slot);
    if (this->Up == 2)
    {
      return p;
    }
    return this->Up == 1 ? Vector3{ p.Z, p.X, p.Y } : Vector3{ p.Y, p.Z, p.X };
  }
};

/// Adds the angles of a triangle's corners, in x and y, to the sums of its points.
///
/// An angle is the difference of two directions. Both triangles of an edge compute the same number
/// for its direction. So the angles around an inner point add up exactly to a whole number of
/// turns; at the boundary, to within the rounding of two directions. Triangles that are turned over
/// count as negative.
struct StarStep
{
  static constexpr std::uint32_t QuarterTurn = 1u << 22;
  static constexpr std::uint32_t FullTurn = 4 * QuarterTurn;

  ScaledTriangles Triangles;
  std::uint32_t* Angles; ///< One sum per point, modulo 2^32, for stars of up to 128 turns.

  DELAUNAYFLIP_HOST_DEVICE void Prefetch(std::int64_t t) const
  {
    this->Triangles.Prefetch(t);
    for (int slot = 0; slot < 3; ++slot)
    {
      delaunayflip::Prefetch(&this->Angles[this->Triangles.Mesh.Triangles.Get(t, slot)]);
    }
  }

  DELAUNAYFLIP_HOST_DEVICE void operator()(std::int64_t t) const
  {
    if (!this->Triangles.IsFinite(t))
    {
      return;
    }
    const Vector3 a = this->Triangles.GetCorner(t, 0);
    const Vector3 b = this->Triangles.GetCorner(t, 1);
    const Vector3 c = this->Triangles.GetCorner(t, 2);
    const int turn = FindTurn(a, b, c);
    if (turn == 0)
    {
      return;
    }
    const std::uint32_t directions[3] = { FindDirection(a, b), FindDirection(b, c),
      FindDirection(c, a) };
    for (int slot = 0; slot < 3; ++slot)
    {
      AtomicAdd(&this->Angles[this->Triangles.Mesh.Triangles.Get(t, slot)],
        FindAngle(directions[slot], directions[(slot + 2) % 3], turn));
    }
  }

private:
  /// From 0 (along x) to FullTurn, increasing with the angle. The directions from a to b and from b
  /// to a differ by exactly half a turn.
  DELAUNAYFLIP_HOST_DEVICE static std::uint32_t FindDirection(const Vector3& a, const Vector3& b)
  {
    const double x = b.X - a.X;
    const double y = b.Y - a.Y;
    const double sum = std::fabs(x) + std::fabs(y);
    const double share = sum > 0.0 ? std::fabs(y) / sum : 0.0;
    const auto part = static_cast<std::uint32_t>(QuarterTurn * share);
    if (y >= 0.0)
    {
      return x >= 0.0 ? part : 2 * QuarterTurn - part;
    }
    return x < 0.0 ? 2 * QuarterTurn + part : FullTurn - part;
  }

  /// The angle of a corner, from the directions to the next point and from the previous one: up to
  /// half a turn, to the side to which the triangle turns. Rounding may exceed this range a little.
  DELAUNAYFLIP_HOST_DEVICE static std::uint32_t FindAngle(
    std::uint32_t toNext, std::uint32_t fromPrevious, int turn)
  {
    const std::uint32_t angle = (fromPrevious + 2 * QuarterTurn - toNext) & (FullTurn - 1);
    const std::uint32_t most = turn > 0 ? 3 * QuarterTurn : QuarterTurn;
    return angle < most ? angle : angle - FullTurn;
  }
};

/// Where a backend knows only a piece of the mesh, an overload adds what other pieces have summed
/// at the points that they share with this one.
template <typename Backend>
void JoinPointSums(const Backend&, std::uint32_t*)
{
}

/// Whether a bounding box is higher than wide, as with x and y in degrees and z in metres.
/// @param times how many times as high, at least.
inline bool IsHigherThanWide(const BoundingBox& box, double times = 1.0)
{
  // Half of each number where the box is so wide that its extent would overflow. The halves of the
  // smallest numbers would be rounded.
  const double largest = std::max(
    { box.Upper[0], box.Upper[1], box.Upper[2], -box.Lower[0], -box.Lower[1], -box.Lower[2] });
  const double unit = largest > 0.5 * std::numeric_limits<double>::max() ? 0.5 : 1.0;
  const auto extent = [&](int axis) { return unit * box.Upper[axis] - unit * box.Lower[axis]; };
  return extent(2) > times * extent(0) && extent(2) > times * extent(1);
}

/// "12 of 30000 triangles face the other way and 7 have no area".
inline std::string DescribeStrays(const TurnSample& turns)
{
  const std::string all = " of " + std::to_string(turns.Count()) + " triangles";
  const std::string flat = std::to_string(turns.Flat.Count);
  if (turns.GetOthers().Count == 0)
  {
    return flat + all + " have no area";
  }
  return std::to_string(turns.GetOthers().Count) + all + " face the other way" +
    (turns.Flat.Count > 0 ? " and " + flat + " have no area" : "");
}

/// Sets a survey's geometry, the reason, and what depends on the geometry.
template <typename BackendT>
class GeometryChoice
{
public:
  GeometryChoice(const MeshInput& input, MeshSurvey& survey, const BackendT& backend)
    : Input(input),
      Survey(survey),
      Backend(backend),
      Triangles{ input.Local, survey.NonFinitePoints.Count == 0 ? nullptr : survey.Uses.Data(),
        PlaneScale(survey.Box) }
  {
  }

  /// @throws InvalidOptions for GeometryKind::Planar if the points lie in no plane.
  void Choose(GeometryKind requested)
  {
    if (requested == GeometryKind::PlanarXY || requested == GeometryKind::Surface)
    {
      this->Take(requested, AsRequested);
      if (requested == GeometryKind::Surface)
      {
        this->Survey.Turns = this->SumTurns().Turns;
      }
    }
    else if (!this->TakePlane(requested))
    {
      this->TakeSpace();
    }
  }

  // Public because device lambdas require it.
  /// The used point with the largest measure.
  template <typename Measure>
  Farthest FindFarthest(const Measure& measure) const
  {
    const PointArray points = this->Input.Local.Points;
    const PointUse* uses = this->Survey.Uses.Data();
    const PlaneScale scale = this->Triangles.Scale;
    return this->Backend.template Sum<Farthest>(points.Count,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i, Farthest & farthest)
      {
        if (uses[i] == PointUse::Used)
        {
          const Vector3 position = scale(LoadPoint(points, i));
          farthest += { i, measure(position), position };
        }
      });
  }

  /// Whether all used points lie in one plane.
  /// @param normal receives its normal, or that of a plane that one point lies off.
  /// @param off receives this point.
  bool FindPlane(Vector3& normal, std::int64_t& off) const
  {
    const BoundingBox& box = this->Survey.Box;
    normal = { 0.0, 0.0, 1.0 };
    if (box.Lower[2] == box.Upper[2]) // as in most planar meshes
    {
      return true;
    }
    // This finds the first used point: the measure is the same for all.
    const Farthest first =
      this->FindFarthest([=] DELAUNAYFLIP_HOST_DEVICE(const Vector3&) { return 0.0; });
    if (first.Point < 0)
    {
      return true;
    }
    const Vector3 origin = first.Position;
    const Farthest second = this->FindFarthest(
      [=] DELAUNAYFLIP_HOST_DEVICE(const Vector3& p) { return Dot(p - origin, p - origin); });
    const Vector3 along = second.Position - origin;
    const Farthest third = this->FindFarthest(
      [=] DELAUNAYFLIP_HOST_DEVICE(const Vector3& p)
      {
        const Vector3 area = Cross(along, p - origin);
        return Dot(area, area);
      });
    const Vector3 found = Cross(along, third.Position - origin);
    const Farthest farthest = this->FindFarthest(
      [=] DELAUNAYFLIP_HOST_DEVICE(const Vector3& p) { return std::fabs(Dot(found, p - origin)); });
    normal = found;
    off = farthest.Point;
    return farthest.Value <=
      PlanarTolerance * this->Triangles.Scale.FindDiagonal(box) * Length(normal);
  }

  /// How triangles turn in x and y, and how steep they are.
  /// @param up another axis: in the two that follow it, with heights along it.
  /// @param atMost about how many triangles are taken, evenly.
  TurnSums SumTurns(
    int up = 2, std::int64_t atMost = std::numeric_limits<std::int64_t>::max()) const
  {
    // The square of the factor must not overflow; areas in smaller boxes vanish anyway.
    constexpr int SmallestExponent = -500;
    const double length = this->Triangles.Scale.FindDiagonal(this->Survey.Box);
    const double factor =
      length > 0.0 ? std::scalbn(1.0, -std::max(std::ilogb(length), SmallestExponent)) : 1.0;
    const std::int64_t all = this->Input.Local.Triangles.Count;
    const std::int64_t stride = std::max<std::int64_t>(1, all / atMost);
    return this->Backend.template Sum<TurnSums>(
      (all + stride - 1) / stride, TurnStep{ this->Triangles, factor, up, stride });
  }

  /// The points around which triangles turn more than once.
  IdSample FindOverlaps() const
  {
    // At both ends of an open fan, directions are rounded.
    constexpr std::int64_t Slack = 8;
    const int side = this->Survey.Turns.GetSide();
    const std::int64_t points = this->Input.Local.Points.Count;
    Array<std::uint32_t> angles = this->Backend.template MakeArray<std::uint32_t>(points);
    std::uint32_t* angleOfPoint = angles.Data();
    this->Backend.ForEach(
      points, [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i) { angleOfPoint[i] = 0; });
    this->Backend.ForEach(
      this->Input.Local.Triangles.Count, StarStep{ this->Triangles, angleOfPoint });
    JoinPointSums(this->Backend, angleOfPoint);
    return this->Backend.template Sum<IdSample>(points,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i, IdSample & sum)
      {
        const std::int64_t angle = static_cast<std::int32_t>(angleOfPoint[i]);
        if (side * angle > StarStep::FullTurn + Slack)
        {
          sum.Note(i);
        }
      });
  }

private:
  static constexpr const char* AsRequested = "as requested";
  static constexpr const char* Advice = "; if it is terrain, use planar-xy";
  static constexpr int MostlyGentle = 95; ///< Percent of the area.

  void Take(GeometryKind geometry, const std::string& reason)
  {
    this->Survey.Geometry = geometry;
    this->Survey.GeometryReason =
      reason + (geometry == GeometryKind::Surface ? "" : "; the feature angle has no effect");
  }

  void TakePlane(int axis, bool isTilted, const char* reason)
  {
    this->Survey.Projection = { (axis + 1) % 3, (axis + 2) % 3, axis, isTilted };
    this->Take(GeometryKind::Planar, reason);
  }

  /// Whether all points lie in one plane.
  bool TakePlane(GeometryKind requested)
  {
    const bool isRequested = requested == GeometryKind::Planar;
    const WholeMesh& whole = this->Input.Caller.Whole;
    if (isRequested && whole.PlaneAxis >= 0)
    {
      this->TakePlane(whole.PlaneAxis, whole.PlaneIsTilted, AsRequested);
      return true;
    }
    Vector3 normal;
    std::int64_t off = -1;
    if (this->FindPlane(normal, off))
    {
      const double x = std::fabs(normal.X), y = std::fabs(normal.Y), z = std::fabs(normal.Z);
      const int axis = z >= x && z >= y ? 2 : (y >= x ? 1 : 0);
      this->TakePlane(axis, this->Survey.Box.Lower[axis] < this->Survey.Box.Upper[axis],
        isRequested ? AsRequested : "all points lie in one plane");
      return true;
    }
    if (isRequested)
    {
      throw InvalidOptions(
        "geometry 'planar' was requested, but the points do not lie in one plane: point " +
        std::to_string(off) +
        " is off by more than 1e-6 of the bounding box's diagonal; use 'surface', or 'planar-xy' "
        "for terrain");
    }
    return false;
  }

  /// Chooses PlanarXY for what can only be terrain, else Surface. Flipping terrain as a surface
  /// turns triangles over in x and y if units are mixed or slopes are steep; flipping steep
  /// surfaces by their projection ruins them.
  void TakeSpace()
  {
    const TurnSums sums = this->SumTurns();
    const TurnSample& turns = this->Survey.Turns = sums.Turns;
    const bool isHigh = IsHigherThanWide(this->Survey.Box);
    // Only mixed units extend like that, of a globe, say, cut where x jumps from 180 to -180.
    const bool mayStray = IsHigherThanWide(this->Survey.Box, 10.0) && turns.AreNearlyUniform();
    const int gentle = // percent, rounded down
      sums.All > 0 ? static_cast<int>(100 * sums.Gentle / sums.All) : 0;
    const bool suits = isHigh || gentle >= MostlyGentle;
    const std::string slopes = std::to_string(gentle) + " % of its area slopes below 45 degrees";
    const std::string field = "a height field over x and y" +
      (turns.CountStrays() > 0 ? ", although " + DescribeStrays(turns) + " there" : std::string());
    if (turns.GetSide() == 0)
    {
      this->Take(
        GeometryKind::Surface, "no triangle has area in x and y" + this->AdviseOtherHeights());
    }
    else if (!turns.AreUniform() && !mayStray)
    {
      this->Take(GeometryKind::Surface,
        "not a height field: seen from above, " + DescribeStrays(turns) +
          (turns.AreNearlyUniform() ? Advice : this->AdviseOtherHeights()));
      this->WarnOfStrays();
    }
    else if (!suits)
    {
      this->Take(GeometryKind::Surface, field + ", but only " + slopes + Advice);
      this->WarnOfStrays();
    }
    else if (!this->RefuseOverlaps())
    {
      this->Take(GeometryKind::PlanarXY,
        field + ", and " + (isHigh ? "z extends further than x and y" : slopes));
    }
  }

  /// Names the axis, other than z, over which the mesh would be a height field of gentle slopes.
  std::string AdviseOtherHeights() const
  {
    constexpr std::int64_t Sample = 1000; // triangles, which tell that most meshes are none
    for (const int up : { 1, 0 })
    {
      const TurnSums sample = this->SumTurns(up, Sample);
      if (10 * sample.Turns.CountStrays() > sample.Turns.Count())
      {
        continue;
      }
      const TurnSums sums = this->SumTurns(up);
      if (sums.Turns.AreUniform() && 100 * sums.Gentle >= MostlyGentle * sums.All)
      {
        const std::string axis = up == 1 ? "y" : "x";
        return "; " + axis + " looks like the height of terrain: if it is, exchange " + axis +
          " and z";
      }
    }
    return "";
  }

  /// Where they are few, and all that keeps the mesh from being a height field.
  void WarnOfStrays()
  {
    const TurnSample& turns = this->Survey.Turns;
    if (turns.CountStrays() > 0 && turns.AreNearlyUniform())
    {
      const bool areTurned = turns.GetOthers().Count > 0;
      std::string what = areTurned ? "triangles that face the other way seen from above"
                                   : "triangles without area in x and y";
      if (areTurned && turns.Flat.Count > 0)
      {
        what += ", and " + std::to_string(turns.Flat.Count) + " that have no area there";
      }
      this->Survey.NearlyHeightField = MakeDefect(what +
          ", so the mesh, nearly a height field, is flipped as a surface; if it is terrain, use "
          "planar-xy",
        areTurned ? turns.GetOthers() : turns.Flat);
    }
  }

  /// Whether stars overlap.
  bool RefuseOverlaps()
  {
    const IdSample overlaps = this->FindOverlaps();
    if (overlaps.Count == 0)
    {
      return false;
    }
    this->Take(GeometryKind::Surface,
      "not a height field: seen from above, triangles overlap around " +
        std::to_string(overlaps.Count) + (overlaps.Count == 1 ? " point" : " points"));
    this->Survey.NearlyHeightField = MakeDefect("points whose triangles overlap in x and y, so "
                                                "the mesh, nearly a height field, is flipped "
                                                "as a surface; if it is terrain, use planar-xy",
      overlaps, DefectIds::Points);
    return true;
  }

  const MeshInput& Input;
  MeshSurvey& Survey;
  const BackendT& Backend;
  const ScaledTriangles Triangles;
};

struct TurnedSums
{
  std::int64_t All = 0;
  IdSample Flipped; ///< Triangles that flips have made.

  DELAUNAYFLIP_HOST_DEVICE TurnedSums& operator+=(const TurnedSums& part)
  {
    this->All += part.All;
    this->Flipped += part.Flipped;
    return *this;
  }
};

/// How many more triangles turn to the less common side in x and y than at first.
/// @param points the points in space.
template <typename Backend>
Defect FindTurnedTriangles(const EdgeMesh& mesh, const PackedPoints& points,
  const TurnSample& before, const Backend& backend)
{
  const TriangleRecord* triangles = mesh.Triangles.Data();
  const PackedPointsView packed = points.View();
  const int side = before.GetSide(); // to which most triangles turned at first
  const TurnedSums sums = backend.template Sum<TurnedSums>(mesh.NumberOfTriangles,
    [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t t, TurnedSums & sum)
    {
      const TriangleRecord& triangle = triangles[t];
      Vector3 a = packed.GetPosition(triangle.Vertices[0]);
      Vector3 b = packed.GetPosition(triangle.Vertices[1]);
      Vector3 c = packed.GetPosition(triangle.Vertices[2]);
      if (!IsFinite(a) || !IsFinite(b) || !IsFinite(c))
      {
        return;
      }
      BringNearOne(a, b, c);
      if (FindTurn(a, b, c) == -side)
      {
        ++sum.All;
        if (triangle.Flips >= OneFlip)
        {
          sum.Flipped.Note(triangle.InputTriangle);
        }
      }
    });
  Defect defect = MakeDefect("triangles that flips in space have turned over in x and y, although "
                             "the input was a height field or nearly one; if it is terrain, use "
                             "planar-xy",
    sums.Flipped);
  defect.Count = std::max<std::int64_t>(0, sums.All - before.GetOthers().Count);
  defect.FirstIds.resize(std::min<std::size_t>(defect.FirstIds.size(), defect.Count));
  return defect;
}

}

#endif
