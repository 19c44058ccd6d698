// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PARTSURVEY_H
#define DELAUNAYFLIP_PARTSURVEY_H

#include "HostMemory.h"
#include "MeshSurvey.h"
#include "PieceFlip.h"
#include "PieceGroup.h"
#include "PointMatching.h"
#include "SmallestAngle.h"
#include "ThreadBackend.h"
#include "TriangleMesh.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace delaunayflip
{

/// The survey of the whole mesh, which is the same on all ranks.
struct PartSurvey : MeshSurvey
{
  WholeMesh Whole; ///< Has the same plane, and no SharedPoints.
  bool IsFloat = true; ///< Whether all ranks that have points have coordinates of type float.

  PartSurvey() = default;
  /// Drops the values of single points. StarsAreSimple is not known yet.
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

/// Sets Side and StarsAreSimple of the whole mesh. Its stars are simple if all its triangles have
/// the same strict orientation in the plane, and the triangles around every point cover no
/// direction twice. Then flips need no guard (PlanarSurvey::StarsAreSimple) in the whole mesh. They
/// need none in a part either, where the star of a point has some of the same triangles. All ranks
/// must call this together.
/// @param keys with Keys, Shared and Closed.
void SurveyStars(const TriangleMesh& mesh, const PointKeys& keys, const ThreadBackend& threads,
  PieceGroup& group, PartSurvey& survey);

}

#endif
