// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_GEOMETRYCHOICE_H
#define DELAUNAYFLIP_GEOMETRYCHOICE_H

#include "Defects.h"
#include "FlipError.h"
#include "FlipOptions.h"
#include "HeightFieldSurvey.h"
#include "MeshSurvey.h"
#include "PlaneFinder.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>

/// @file
/// Chooses the space in which the edges of a mesh are judged, and says why.

namespace delaunayflip
{

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

/// How many percent of the area slope less than 45 degrees, rounded down; 0 without area.
inline int GetGentlePercent(const TurnSums& sums)
{
  const Integer128 all = sums.All.Get();
  return all > 0 ? static_cast<int>(100 * sums.Gentle.Get() / all) : 0;
}

inline TurnCounts CountTurns(const TurnSums& sums)
{
  const std::int64_t left = sums.Left.Count;
  const std::int64_t right = sums.Right.Count;
  TurnCounts counts;
  counts.Side = left + right == 0 ? 0 : (left >= right ? 1 : -1);
  counts.Triangles = left + right + sums.Flat.Count;
  counts.Others = left >= right ? right : left;
  counts.Flat = sums.Flat.Count;
  return counts;
}

/// "12 of 30000 triangles turn the other way and 7 have no area".
inline std::string DescribeStrays(const TurnCounts& turns)
{
  const std::string all = " of " + std::to_string(turns.Triangles) + " triangles";
  const std::string flat = std::to_string(turns.Flat);
  if (turns.Others == 0)
  {
    return flat + all + " have no area";
  }
  return std::to_string(turns.Others) + all + " turn the other way" +
    (turns.Flat > 0 ? " and " + flat + " have no area" : "");
}

/// Sets a survey's geometry, the reason, and what depends on the geometry.
template <typename Backend>
class GeometryChoice
{
public:
  GeometryChoice(const MeshInput& input, MeshSurvey& survey, const Backend& backend)
    : Input(input),
      Survey(survey),
      Engine(backend)
  {
  }

  /// @throws InvalidOptions for GeometryKind::Planar if the points lie in no plane.
  void Choose(GeometryKind requested)
  {
    const HeightFieldSurvey<Backend> heights(this->Input, this->Survey, this->Engine);
    if (requested == GeometryKind::PlanarXY)
    {
      this->Take(requested, AsRequested);
    }
    else if (requested == GeometryKind::Surface)
    {
      this->Take(requested, AsRequested);
      this->Survey.Turns = CountTurns(heights.SumTurns());
    }
    else if (!this->TakePlane(requested))
    {
      this->TakeSpace(heights);
    }
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

  void ProjectAlong(int axis, bool tilted)
  {
    PlaneProjection& projection = this->Survey.Projection;
    projection.AxisU = (axis + 1) % 3;
    projection.AxisV = (axis + 2) % 3;
    projection.AxisW = axis;
    projection.Tilted = tilted;
  }

  /// Whether all points lie in one plane.
  bool TakePlane(GeometryKind requested)
  {
    const WholeMesh& whole = this->Input.Caller.Whole;
    if (requested == GeometryKind::Planar && whole.PlaneAxis >= 0)
    {
      this->ProjectAlong(whole.PlaneAxis, whole.PlaneIsTilted);
      this->Take(requested, AsRequested);
      return true;
    }
    PlaneFinder<Backend> finder(this->Input, this->Survey, this->Engine);
    if (finder.Find())
    {
      const int axis = finder.DominantAxis();
      this->ProjectAlong(axis, this->Survey.Box.Lower[axis] < this->Survey.Box.Upper[axis]);
      this->Take(GeometryKind::Planar,
        requested == GeometryKind::Planar ? AsRequested : "all points lie in one plane");
      return true;
    }
    if (requested == GeometryKind::Planar)
    {
      throw InvalidOptions(
        "geometry 'planar' was requested, but the points do not lie in one plane: point " +
        std::to_string(finder.FarthestOff()) +
        " is off by more than 1e-6 of the bounding box's diagonal; use 'surface', or 'planar-xy' "
        "for terrain");
    }
    return false;
  }

  /// Chooses PlanarXY for what can only be terrain, else Surface. Flipping terrain as a surface
  /// turns triangles over in x and y if units are mixed or slopes are steep; flipping steep
  /// surfaces by their projection ruins them.
  void TakeSpace(const HeightFieldSurvey<Backend>& heights)
  {
    const TurnSums sums = heights.SumTurns();
    this->Survey.Turns = CountTurns(sums);
    const TurnCounts& turns = this->Survey.Turns;
    const bool isHigh = IsHigherThanWide(this->Survey.Box);
    // Only mixed units extend like that, of a globe, say, cut where x jumps from 180 to -180.
    const bool mayStray = IsHigherThanWide(this->Survey.Box, 10.0) && turns.AreNearlyUniform();
    const int gentle = GetGentlePercent(sums);
    const bool suits = isHigh || gentle >= MostlyGentle;
    const std::string slopes = std::to_string(gentle) + " % of its area slopes below 45 degrees";
    if (!turns.AreUniform() && !mayStray)
    {
      this->RefuseStrays(sums);
    }
    else if (!suits)
    {
      this->Take(GeometryKind::Surface, this->DescribeField() + ", but only " + slopes + Advice);
      this->WarnOfStrays(sums);
    }
    else if (!this->RefuseOverlaps(heights))
    {
      this->Take(GeometryKind::PlanarXY,
        this->DescribeField() + ", and " + (isHigh ? "z extends further than x and y" : slopes));
    }
  }

  std::string DescribeField() const
  {
    const TurnCounts& turns = this->Survey.Turns;
    return "a height field over x and y" +
      (turns.GetStrays() > 0 ? ", although " + DescribeStrays(turns) + " there" : std::string());
  }

  void RefuseStrays(const TurnSums& sums)
  {
    const TurnCounts& turns = this->Survey.Turns;
    this->Take(GeometryKind::Surface,
      turns.Side == 0
        ? "no triangle has area in x and y"
        : "in x and y " + DescribeStrays(turns) + (turns.AreNearlyUniform() ? Advice : ""));
    this->WarnOfStrays(sums);
  }

  /// Where they are few, and all that keeps the mesh from being a height field.
  void WarnOfStrays(const TurnSums& sums)
  {
    const TurnCounts& turns = this->Survey.Turns;
    if (turns.GetStrays() > 0 && turns.AreNearlyUniform())
    {
      const bool areTurned = turns.Others > 0;
      std::string what = areTurned ? "triangles that turn the other way in x and y"
                                   : "triangles that have no area in x and y";
      if (areTurned && turns.Flat > 0)
      {
        what += ", and " + std::to_string(turns.Flat) + " that have no area there";
      }
      this->Survey.NearlyHeightField = MakeDefect(what +
          ", so the mesh, nearly a height field, is flipped as a surface; if it is terrain, use "
          "planar-xy",
        !areTurned ? sums.Flat : (turns.Side > 0 ? sums.Right : sums.Left));
    }
  }

  /// Whether stars overlap.
  bool RefuseOverlaps(const HeightFieldSurvey<Backend>& heights)
  {
    const IdSample overlaps = heights.FindOverlaps(this->Survey.Turns.Side);
    if (overlaps.Count == 0)
    {
      return false;
    }
    this->Take(GeometryKind::Surface,
      "triangles overlap in x and y around " + std::to_string(overlaps.Count) +
        (overlaps.Count == 1 ? " point" : " points"));
    this->Survey.NearlyHeightField = MakeDefect("points whose triangles overlap in x and y, so "
                                                "the mesh, nearly a height field, is flipped "
                                                "as a surface; if it is terrain, use planar-xy",
      overlaps, DefectIds::Points);
    return true;
  }

  const MeshInput& Input;
  MeshSurvey& Survey;
  const Backend& Engine;
};

}

#endif
