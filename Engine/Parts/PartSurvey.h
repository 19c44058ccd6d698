// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PARTSURVEY_H
#define DELAUNAYFLIP_PARTSURVEY_H

#include "HostMemory.h"
#include "MeshSurvey.h"
#include "PieceFlip.h"
#include "PieceGroup.h"
#include "Records.h"
#include "SmallestAngle.h"
#include "ThreadBackend.h"
#include "TriangleMesh.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace delaunayflip
{

/// The keys of points. A key is a number that stands for one point of the whole mesh: all ranks
/// that have the point use the same key.
struct PointKeys
{
  RankNumbers Owners; ///< For each key a rank that has the point from the start.
  HostVector<std::int64_t> Keys; ///< One per point of this rank.
  std::vector<unsigned char> Shared; ///< One flag per point: whether another rank has it, too.
  std::vector<unsigned char> Used; ///< One flag per point: whether a triangle has it.
  /// One flag per point: whether it is not shared and its triangles form a closed fan.
  std::vector<unsigned char> Closed;

  // These are about the whole mesh:
  std::int64_t Repeated = 0; ///< Points of all ranks that a lower rank has, too.
  std::int64_t UsedPoints = 0; ///< Points of triangles, each once.
  /// Points that coincide with others of their rank and with a point of another rank.
  std::int64_t Ambiguous = 0;
};

/// Finds the points that several ranks have: points with the same global number or, without such
/// numbers, with the same coordinates if at least one of them is at the border of a part. A point
/// without triangles that is the end of a constraint counts as a border point. Two points with the
/// same number that are inside their parts are found if each of them lies in the bounding box of
/// the other one's rank.
PointKeys MatchPoints(
  const MeshPiece& piece, PieceGroup& group, const ThreadBackend& threads = ThreadBackend(1));

/// What is known of the whole mesh; the same on all ranks.
struct PartSurvey : MeshSurvey
{
  WholeMesh Whole; ///< With the same plane; without SharedPoints.
  bool IsFloat = true; ///< Whether all ranks that have points have coordinates of type float.

  PartSurvey() = default;
  /// Without StarsAreSimple. Drops the values of single points.
  PartSurvey(MeshSurvey found, bool isFloat);

  /// Whether a flip could make an edge that already exists on some rank. Then flips need a guard
  /// (PartRun.cpp).
  bool NeedsGuard() const { return !this->Whole.StarsAreSimple; }
  /// Lists defects of ids and coordinates.
  std::vector<Defect> ListDefects() const;
};

/// Measures the angles of `count` triangles.
/// @param get get(i, x) sets the coordinates of triangle i; it does not count if that returns
/// false.
template <typename Get>
AngleSums MeasureAngles(
  std::int64_t count, const PartSurvey& survey, const ThreadBackend& threads, const Get& get)
{
  const bool isFlat = survey.Geometry == GeometryKind::PlanarXY;
  const auto measure = [&](std::int64_t i, AngleSums& sum)
  {
    double x[3][3];
    const auto corner = [&](int slot) {
      return Vector3{ x[slot][0], x[slot][1], isFlat ? 0.0 : x[slot][2] };
    };
    if (get(i, x))
    {
      sum.Add(MeasureSquaredCotangent(corner(0), corner(1), corner(2), survey.Range));
    }
  };
  return threads.Sum<AngleSums>(count, measure);
}

/// Returns that of some axes along which items extend most.
/// @param get get(item, axis) is a coordinate.
template <typename Iterator, typename Get>
int FindLongestAxis(Iterator begin, Iterator end, const std::vector<int>& axes, const Get& get)
{
  int longest = axes.front();
  double most = -1.0;
  for (const int axis : axes)
  {
    const auto [least, greatest] = std::minmax_element(
      begin, end, [&](const auto& a, const auto& b) { return get(a, axis) < get(b, axis); });
    if (get(*greatest, axis) - get(*least, axis) > most)
    {
      most = get(*greatest, axis) - get(*least, axis);
      longest = axis;
    }
  }
  return longest;
}

/// @throws on every rank: InvalidMesh for an id that is not a point of its rank; InvalidOptions.
PartSurvey SurveyParts(
  const MeshPiece& piece, const PointKeys& keys, const FlipOptions& options, PieceGroup& group);

/// Checks ids and options on every rank, as SurveyParts does, before anything else is done.
void CheckParts(const MeshPiece& piece, const FlipOptions& options, PieceGroup& group);

/// The input of a run on one rank. All of it must live as long as the run.
struct PartJob
{
  const MeshPiece& Piece;
  const FlipOptions& Options; ///< With the survey's geometry.
  const PartSurvey& Survey;
  PieceGroup& Group;
  const ProgressObserver& Progress;
};

/// Sets Side and StarsAreSimple of the whole mesh: whether all its triangles strictly turn to the
/// same side in the plane, and the triangles around every point cover no direction twice. Then
/// flips need no guard (PlanarSurvey::StarsAreSimple), neither in the whole mesh nor in a part,
/// where the star of a point has some of the same triangles. All ranks must call this together.
/// @param keys of which only Keys, Shared and Closed matter.
void SurveyStars(const TriangleMesh& mesh, const PointKeys& keys, const ThreadBackend& threads,
  PieceGroup& group, PartSurvey& survey);

}

#endif
