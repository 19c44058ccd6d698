// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_GEOMETRYCHOICE_H
#define DELAUNAYFLIP_GEOMETRYCHOICE_H

#include "Array.h"
#include "FlipError.h"
#include "FlipOptions.h"
#include "GeometryPasses.h"
#include "HostDevice.h"
#include "MeshSurvey.h"
#include "SphereSurvey.h"
#include "SurfaceAngles.h"
#include "TriangleMesh.h"

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

/// If a backend knows only a part of the mesh, an overload adds what other parts have summed at the
/// points that they share with this one.
template <typename Backend>
void JoinPointSums(const Backend&, std::uint32_t*)
{
}

/// Whether a bounding box is higher than wide, as with x and y in degrees and z in metres.
/// @param times how many times as high, at least.
inline bool IsHigherThanWide(const BoundingBox& box, double times = 1.0)
{
  // All numbers are halved if the box is so wide that its extent would overflow. The halves of the
  // smallest numbers would be rounded.
  const double largest = std::max(
    { box.Upper[0], box.Upper[1], box.Upper[2], -box.Lower[0], -box.Lower[1], -box.Lower[2] });
  const bool mayOverflow = largest > 0.5 * std::numeric_limits<double>::max();
  const double unit = mayOverflow ? 0.5 : 1.0;
  const auto extent = [&](int axis) { return unit * box.Upper[axis] - unit * box.Lower[axis]; };
  return extent(2) > times * extent(0) && extent(2) > times * extent(1);
}

/// "12 of 30000 triangles face the other way and 7 have no area".
inline std::string DescribeStrays(const OrientationSample& orientations)
{
  const std::string all = " of " + std::to_string(orientations.Count()) + " triangles";
  const std::string flat = std::to_string(orientations.Flat.Count);
  if (orientations.GetOthers().Count == 0)
  {
    return flat + all + " have no area";
  }
  std::string strays = std::to_string(orientations.GetOthers().Count) + all + " face the other way";
  if (orientations.Flat.Count > 0)
  {
    strays += " and " + flat + " have no area";
  }
  return strays;
}

/// The scale of a mesh in this box.
inline PlaneScale FindScale(const BoundingBox& box)
{
  double largest = 0.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    largest = std::max({ largest, std::fabs(box.Lower[axis]), std::fabs(box.Upper[axis]) });
  }
  const int exponent = -ExponentOf(largest);
  return { { std::scalbn(1.0, exponent / 2), std::scalbn(1.0, exponent - exponent / 2) } };
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
      Triangles{ input.Local, survey.GetUsesIfNeeded(), FindScale(survey.Box) }
  {
  }

  /// @throws InvalidOptions for GeometryKind::Planar if the points lie in no plane.
  void Choose(GeometryKind requested)
  {
    if (requested == GeometryKind::PlanarXY || requested == GeometryKind::Surface ||
      requested == GeometryKind::Sphere)
    {
      this->Take(requested, AsRequested);
      if (requested == GeometryKind::Surface)
      {
        this->Survey.Orientations = this->SumOrientations().Orientations;
      }
    }
    else if (!this->TakePlane(requested))
    {
      this->TakeSpace();
      if (this->IsGlobe())
      {
        this->Survey.GeometryReason += "; if it is a globe, use sphere";
      }
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

  /// Whether the used points are on a sphere around the origin. A sample tells that most are not.
  bool IsGlobe() const
  {
    constexpr std::int64_t Sample = 1000;
    const std::int64_t points = this->Input.Local.Points.Count;
    return this->SurveyGlobe(std::max<std::int64_t>(1, points / Sample)).IsGlobe() &&
      this->SurveyGlobe(1).IsGlobe();
  }

  /// @param stride every how many points one is taken.
  GlobeSurvey SurveyGlobe(std::int64_t stride) const
  {
    const PointArray points = this->Input.Local.Points;
    const PointUse* uses = this->Survey.Uses.Data();
    const PlaneScale scale = this->Triangles.Scale;
    return this->Backend.template Sum<GlobeSurvey>((points.Count + stride - 1) / stride,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i, GlobeSurvey & survey)
      {
        if (uses[i * stride] == PointUse::Used)
        {
          survey.Include(scale(LoadPoint(points, i * stride)));
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

  /// How triangles are oriented in x and y, and how steep they are.
  /// @param up the axis of heights. If it is not z, the two axes that follow it replace x and y.
  /// @param atMost about how many triangles are taken, evenly.
  OrientationSums SumOrientations(
    int up = 2, std::int64_t atMost = std::numeric_limits<std::int64_t>::max()) const
  {
    // The square of the factor must not overflow; areas in smaller boxes vanish anyway.
    constexpr int SmallestExponent = -500;
    const double length = this->Triangles.Scale.FindDiagonal(this->Survey.Box);
    const double factor = std::scalbn(1.0, -std::max(ExponentOf(length), SmallestExponent));
    const std::int64_t all = this->Input.Local.Triangles.Count;
    const std::int64_t stride = std::max<std::int64_t>(1, all / atMost);
    return this->Backend.template Sum<OrientationSums>(
      (all + stride - 1) / stride, OrientationStep{ this->Triangles, factor, up, stride });
  }

  /// The points around which triangles wind more than once.
  IdSample FindOverlaps() const
  {
    // At both ends of an open fan, directions are rounded.
    constexpr std::int64_t Slack = 8;
    const int side = this->Survey.Orientations.GetSide();
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
        if (side * angle > StarStep::FullCircle + Slack)
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
    this->Survey.GeometryReason = reason;
    if (geometry != GeometryKind::Surface)
    {
      this->Survey.GeometryReason += "; the feature angle has no effect";
    }
  }

  void TakePlane(int axis, bool isTilted, const char* reason)
  {
    PlaneProjection& plane = this->Survey.Projection;
    plane.AxisU = (axis + 1) % 3;
    plane.AxisV = (axis + 2) % 3;
    plane.AxisW = axis;
    plane.Tilted = isTilted;
    this->Take(GeometryKind::Planar, reason);
  }

  /// Finds two directions in a tilted plane from its normal, which has a component along W.
  static void FindDirections(const Vector3& normal, PlaneProjection& plane)
  {
    const double xyz[3] = { normal.X, normal.Y, normal.Z };
    const double slopeU = -xyz[plane.AxisU] / xyz[plane.AxisW];
    const double slopeV = -xyz[plane.AxisV] / xyz[plane.AxisW];
    const double lengthU = std::sqrt(1.0 + slopeU * slopeU);
    const double length = std::sqrt(1.0 + slopeU * slopeU + slopeV * slopeV);
    const double first[3] = { 1.0 / lengthU, 0.0, slopeU / lengthU };
    // This is the cross product of the unit normal and the first direction.
    const double second[3] = { -slopeU * slopeV / (lengthU * length), lengthU / length,
      slopeV / (lengthU * length) };
    std::copy_n(first, 3, plane.Along[0]);
    std::copy_n(second, 3, plane.Along[1]);
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
      const int axisOfXY = y >= x ? 1 : 0;
      const int axis = z >= x && z >= y ? 2 : axisOfXY;
      const char* reason = isRequested ? AsRequested : "all points lie in one plane";
      const bool isTilted = this->Survey.Box.Lower[axis] < this->Survey.Box.Upper[axis];
      this->TakePlane(axis, isTilted, reason);
      if (isTilted)
      {
        FindDirections(normal, this->Survey.Projection);
      }
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
  /// folds triangles over in x and y if units are mixed or slopes are steep; flipping steep
  /// surfaces by their projection ruins them.
  void TakeSpace()
  {
    const OrientationSums sums = this->SumOrientations();
    this->Survey.Orientations = sums.Orientations;
    const OrientationSample& orientations = this->Survey.Orientations;
    const bool isHigh = IsHigherThanWide(this->Survey.Box);
    // A mesh extends like that only in mixed units, as a globe that is cut where x jumps from 180
    // to -180.
    const bool mayStray =
      IsHigherThanWide(this->Survey.Box, 10.0) && orientations.AreNearlyUniform();
    // In percent, rounded down.
    const auto gentle = static_cast<int>(100 * sums.Gentle / std::max<Integer128>(1, sums.All));
    const bool suits = isHigh || gentle >= MostlyGentle;
    const std::string slopes = std::to_string(gentle) + " % of its area slopes below 45 degrees";
    std::string field = "a height field over x and y";
    if (orientations.CountStrays() > 0)
    {
      field += ", although " + DescribeStrays(orientations) + " there";
    }
    if (orientations.GetSide() == 0)
    {
      this->Take(
        GeometryKind::Surface, "no triangle has area in x and y" + this->AdviseOtherHeights());
    }
    else if (!orientations.AreUniform() && !mayStray)
    {
      const std::string advice =
        orientations.AreNearlyUniform() ? Advice : this->AdviseOtherHeights();
      this->Take(GeometryKind::Surface,
        "not a height field: seen from above, " + DescribeStrays(orientations) + advice);
      this->WarnOfStrays();
    }
    else if (!suits)
    {
      this->Take(GeometryKind::Surface, field + ", but only " + slopes + Advice);
      this->WarnOfStrays();
    }
    else if (!this->RefuseOverlaps())
    {
      const std::string reason = isHigh ? "z extends further than x and y" : slopes;
      this->Take(GeometryKind::PlanarXY, field + ", and " + reason);
    }
  }

  /// Names the axis, other than z, over which the mesh would be a height field of gentle slopes.
  std::string AdviseOtherHeights() const
  {
    constexpr std::int64_t Sample = 1000; // triangles, which tell that most meshes are none
    for (const int up : { 1, 0 })
    {
      const OrientationSample sample = this->SumOrientations(up, Sample).Orientations;
      if (10 * sample.CountStrays() > sample.Count())
      {
        continue;
      }
      const OrientationSums sums = this->SumOrientations(up);
      if (sums.Orientations.AreUniform() && 100 * sums.Gentle >= MostlyGentle * sums.All)
      {
        const std::string axis = up == 1 ? "y" : "x";
        return "; " + axis + " looks like the height of terrain: if it is, exchange " + axis +
          " and z";
      }
    }
    return "";
  }

  /// Warns if there are few strays, and only they keep the mesh from being a height field.
  void WarnOfStrays()
  {
    const OrientationSample& orientations = this->Survey.Orientations;
    if (orientations.CountStrays() == 0 || !orientations.AreNearlyUniform())
    {
      return;
    }
    Defect& defect = this->Survey.NearlyHeightField;
    defect = MakeDefect(DefectKind::FlatFromAbove, orientations.Flat);
    if (orientations.GetOthers().Count > 0)
    {
      defect = MakeDefect(DefectKind::TurnedFromAbove, orientations.GetOthers());
      if (orientations.Flat.Count > 0)
      {
        defect.Detail =
          ", and " + std::to_string(orientations.Flat.Count) + " that have no area there";
      }
    }
    defect.Detail += NearlyHeightField;
  }

  /// Whether stars overlap.
  bool RefuseOverlaps()
  {
    const IdSample overlaps = this->FindOverlaps();
    if (overlaps.Count == 0)
    {
      return false;
    }
    const std::string points = overlaps.Count == 1 ? " point" : " points";
    this->Take(GeometryKind::Surface,
      "not a height field: seen from above, triangles overlap around " +
        std::to_string(overlaps.Count) + points);
    this->Survey.NearlyHeightField = MakeDefect(DefectKind::OverlapFromAbove, overlaps);
    this->Survey.NearlyHeightField.Detail = NearlyHeightField;
    return true;
  }

  static constexpr const char* NearlyHeightField =
    ", so the mesh, nearly a height field, is flipped as a surface; if it is terrain, use "
    "planar-xy";

  const MeshInput& Input;
  MeshSurvey& Survey;
  const BackendT& Backend;
  const ScaledTriangles Triangles;
};

}

#endif
