// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FlipReport.h"

#include <cstddef>
#include <iterator>

/// @file
/// The only place that puts defects into words.

namespace delaunayflip
{

namespace
{

struct DefectWords
{
  DefectKind Kind;
  DefectIds Ids;
  const char* One; ///< Follows the number 1.
  const char* Several;
};

using Kind = DefectKind;

/// In the order of the kinds.
constexpr DefectWords AllWords[] = {
  { Kind::Other, DefectIds::Triangles, "", "" },
  { Kind::PointsNotFinite, DefectIds::Points, "point with NaN or infinite coordinates",
    "points with NaN or infinite coordinates" },
  { Kind::RepeatedIds, DefectIds::Triangles, "triangle with a repeated point id",
    "triangles with a repeated point id" },
  { Kind::TrianglesWithoutArea, DefectIds::Triangles, "triangle without area",
    "triangles without area" },
  { Kind::TurnedFromMost, DefectIds::Triangles, "triangle that faces the other way than most",
    "triangles that face the other way than most" },
  { Kind::DuplicateTriangles, DefectIds::Triangles, "triangle that repeats another one's points",
    "triangles that repeat another one's points" },
  { Kind::TurnedFromAbove, DefectIds::Triangles,
    "triangle that faces the other way seen from above",
    "triangles that face the other way seen from above" },
  { Kind::FlatFromAbove, DefectIds::Triangles, "triangle without area in x and y",
    "triangles without area in x and y" },
  { Kind::OverlapFromAbove, DefectIds::Points, "point with triangles that overlap in x and y",
    "points with triangles that overlap in x and y" },
  { Kind::TurnedByFlips, DefectIds::Triangles,
    "triangle that flips in space have turned over in x and y",
    "triangles that flips in space have turned over in x and y" },
  { Kind::SeparateTriangles, DefectIds::Triangles, "",
    "triangles of which no two share an edge, so that none can flip: merge points that lie at the "
    "same place" },
  { Kind::ConstraintsNotEdges, DefectIds::Points, "constraint edge that is not an edge of the mesh",
    "constraint edges that are not edges of the mesh" },
  { Kind::ConstraintsLeaveMesh, DefectIds::PointPairs,
    "constraint edge that cannot be inserted because it leaves the mesh",
    "constraint edges that cannot be inserted because they leave the mesh" },
  { Kind::ConstraintsLeavePart, DefectIds::PointPairs,
    "constraint edge that cannot be inserted because it leaves the part of the mesh that a rank "
    "has: insert constraints across ranks before the mesh is divided",
    "constraint edges that cannot be inserted because they leave the part of the mesh that a rank "
    "has: insert constraints across ranks before the mesh is divided" },
  { Kind::ConstraintsCross, DefectIds::PointPairs,
    "constraint edge that cannot be inserted because it crosses edges that stay",
    "constraint edges that cannot be inserted because they cross edges that stay" },
  { Kind::ConstraintsMeetOverlap, DefectIds::PointPairs,
    "constraint edge that cannot be inserted where triangles overlap or points coincide",
    "constraint edges that cannot be inserted where triangles overlap or points coincide" },
  { Kind::ConstraintsNeedGuard, DefectIds::PointPairs,
    "constraint edge that ranks cannot insert because triangles overlap or have no area: insert "
    "constraints before the mesh is divided",
    "constraint edges that ranks cannot insert because triangles overlap or have no area: insert "
    "constraints before the mesh is divided" },
  { Kind::ConstraintsOnSurface, DefectIds::PointPairs,
    "constraint edge that is not an edge of the mesh and cannot be inserted on a surface or a "
    "sphere",
    "constraint edges that are not edges of the mesh and cannot be inserted on a surface or a "
    "sphere" },
  { Kind::PointsRepeated, DefectIds::Points, "duplicate point skipped",
    "duplicate points skipped" },
  { Kind::PointsTooNear, DefectIds::Points,
    "point nearer than the tolerance to one with a lower id",
    "points nearer than the tolerance to one with a lower id" },
  { Kind::SegmentsCross, DefectIds::PointPairs, "segment that crosses an earlier one",
    "segments that cross an earlier one" },
  { Kind::SegmentsNotFinite, DefectIds::PointPairs,
    "segment that ends at a point that is not finite",
    "segments that end at a point that is not finite" },
  { Kind::SegmentsWithoutTriangles, DefectIds::PointPairs,
    "segment between points without a triangle", "segments between points without a triangle" },
  { Kind::HoleSeedsOutside, DefectIds::Points, "hole seed outside of all triangles",
    "hole seeds outside of all triangles" },
  { Kind::RingsWithoutArea, DefectIds::Rings, "ring without an area, left out",
    "rings without an area, left out" },
  { Kind::RingsRepeated, DefectIds::Rings, "ring with the edges of an earlier one, left out",
    "rings with the edges of an earlier one, left out" },
  { Kind::RingsRunAgain, DefectIds::Rings,
    "ring with a loop that is run more than once, counted once",
    "rings with a loop that is run more than once, counted once" },
  { Kind::HolePointsOutside, DefectIds::Points,
    "point of holes on the convex hull, to which the mesh reaches beyond all other points (an "
    "outline ends it before)",
    "points of holes on the convex hull, to which the mesh reaches beyond all other points (an "
    "outline ends it before)" },
  { Kind::PointsWithoutTriangles, DefectIds::Points,
    "point without a triangle: there are fewer than three places, or all are on one line",
    "points without a triangle: there are fewer than three places, or all are on one line" },
  { Kind::NothingLeft, DefectIds::Points, "point without a triangle", "points without a triangle" },
  { Kind::PolygonsTooSmall, DefectIds::Triangles, "polygon with fewer than three different points",
    "polygons with fewer than three different points" },
  { Kind::ConstraintsNotInMesh, DefectIds::Points,
    "constraint edge of the second input that the mesh does not have",
    "constraint edges of the second input that the mesh does not have" },
  { Kind::PointsWithoutHeights, DefectIds::Points, "point of segments without heights",
    "points of segments without heights" },
  { Kind::RegionSeedsOutside, DefectIds::Seeds, "region seed outside of all triangles",
    "region seeds outside of all triangles" },
  { Kind::TrianglesNotRefined, DefectIds::Triangles,
    "triangle that is not as good as wanted: segments meet there at a small angle or must not be "
    "split, points are within rounding of a line, or refinement ended before",
    "triangles that are not as good as wanted: segments meet there at a small angle or must not be "
    "split, points are within rounding of a line, or refinement ended before" },
  { Kind::PointLimitReached, DefectIds::Points,
    "point is there, so refinement has ended: PointLimit allows no more",
    "points are there, so refinement has ended: PointLimit allows no more" },
  { Kind::PointsInside, DefectIds::Points,
    "point inside of the convex hull of the others, not used: it is not on the sphere, or rounding "
    "has put it inside",
    "points inside of the convex hull of the others, not used: they are not on the sphere, or "
    "rounding has put them inside" },
  { Kind::PointsInOnePlane, DefectIds::Points,
    "point without a triangle: ", "points without a triangle: " },
  { Kind::SegmentsInside, DefectIds::PointPairs,
    "segment that ends at a point inside of the convex hull",
    "segments that end at a point inside of the convex hull" },
  { Kind::RegionSeedsRepeated, DefectIds::Seeds,
    "region seed in the same part as an earlier one, not used: its label or its area differs, so "
    "a segment between the two may be missing",
    "region seeds in the same part as earlier ones, not used: their labels or areas differ, so "
    "segments between them may be missing" },
  { Kind::OptionsWithoutGoal, DefectIds::Points,
    "option without effect, because without a goal nothing is refined: ",
    "options without effect, because without a goal nothing is refined: " },
  { Kind::TrianglesNotJudged, DefectIds::Triangles,
    "triangle that refinement has not looked at: MaximumIterations allows no round",
    "triangles that refinement has not looked at: MaximumIterations allows no round" },
  { Kind::SegmentsRemoved, DefectIds::PointPairs, "segment that ends at a removed point",
    "segments that end at a removed point" },
};

constexpr bool AreInOrder()
{
  for (std::size_t i = 0; i < std::size(AllWords); ++i)
  {
    if (static_cast<std::size_t>(AllWords[i].Kind) != i)
    {
      return false;
    }
  }
  return true;
}
static_assert(
  AreInOrder() && std::size(AllWords) == static_cast<std::size_t>(DefectKind::SegmentsRemoved) + 1,
  "one row per kind");

const DefectWords& GetWords(DefectKind kind) { return AllWords[static_cast<std::size_t>(kind)]; }

/// The first ids of a defect, e.g. "3, 8, 11", "3-9, 4-5" or "3-9 crosses segment 12 (points 1 and
/// 4)".
std::string ListFirstIds(const Defect& defect)
{
  std::string text;
  const std::size_t width = defect.Ids == DefectIds::PointPairs ? 2 : 1;
  for (std::size_t i = 0; i + width <= defect.FirstIds.size(); i += width)
  {
    text += (text.empty() ? "" : ", ") + std::to_string(defect.FirstIds[i]);
    if (width == 2)
    {
      text += "-" + std::to_string(defect.FirstIds[i + 1]);
    }
    if (i / width < defect.Crossed.size())
    {
      text += " " + DescribeCrossed(defect.Crossed[i / width], defect.Kind);
    }
  }
  return text;
}

std::string DescribeDefect(const Defect& defect)
{
  const DefectWords& words = GetWords(defect.Kind);
  std::string text = std::to_string(defect.Count) + " ";
  text += defect.Count == 1 ? words.One : words.Several;
  text += defect.Detail;
  const std::string first = ListFirstIds(defect);
  return first.empty() ? text : text + " (first: " + first + ")";
}

}

Defect::Defect(DefectKind kind, std::int64_t count, std::vector<std::int64_t> firstIds)
  : Kind(kind),
    Count(count),
    FirstIds(std::move(firstIds)),
    Ids(GetWords(kind).Ids)
{
}

std::string DescribeCrossed(const CrossedEdge& crossed, DefectKind kind)
{
  const std::string ends =
    std::to_string(crossed.Ends[0]) + " and " + std::to_string(crossed.Ends[1]);
  if (crossed.Number < 0)
  {
    return "crosses the edge of points " + ends;
  }
  const char* noun = kind == DefectKind::ConstraintsCross ? "constraint " : "segment ";
  return "crosses " + std::string(noun) + std::to_string(crossed.Number) + " (points " + ends + ")";
}

std::string DescribeDefects(const std::vector<Defect>& defects)
{
  std::string text;
  for (const Defect& defect : defects)
  {
    text += (text.empty() ? "" : "; ") + DescribeDefect(defect);
  }
  return text;
}

}
