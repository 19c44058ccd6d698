// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_SEAMQUADS_H
#define DELAUNAYFLIP_SEAMQUADS_H

#include "EdgeMesh.h"
#include "FlipOptions.h"
#include "FlipReport.h"
#include "OppositeAngles.h"
#include "PackedPoints.h"
#include "PartMesh.h"
#include "PartSurvey.h"
#include "Records.h"
#include "TriangleMesh.h"

#include <cstdint>
#include <vector>

namespace delaunayflip
{

/// Coordinates of points, in the precision of the caller's coordinates.
class PointList
{
public:
  explicit PointList(bool isFloat)
    : IsFloat(isFloat)
  {
  }
  void Reserve(std::int64_t size);
  void Add(const double (&x)[3]);
  std::int64_t GetSize() const;
  PointArray View() const;

private:
  bool IsFloat;
  std::vector<float> Floats;
  std::vector<double> Doubles;
};

/// One of the two triangles of an edge, with all that decides whether the edge is fixed.
struct SeamSide
{
  double Ends[2][3]; ///< Of the edge, in the same order for both triangles.
  double Opposite[3];
  bool RunsForward; ///< The triangle runs through the edge from the first end to the second.
  bool IsFrozen;
  std::int32_t Region;
};

/// A mesh of quads that share no points. Each quad has two triangles: those of an edge, which may
/// come from different ranks. So the engine judges such edges by the same rules as all others.
class QuadSoup
{
public:
  QuadSoup(const PartSurvey& survey, const FlipOptions& options);

  void Add(const SeamSide& one, const SeamSide& other);
  std::int64_t GetSize() const { return this->Points.GetSize() / 4; }

  /// One flag per quad: whether its edge is fixed. Adds these edges, and why they are fixed, to
  /// `counts`.
  std::vector<unsigned char> FindFixed(EdgeCounts& counts) const;

private:
  TriangleMesh View() const;
  FlipOptions Options;
  WholeMesh Whole;
  PointList Points;
  std::vector<std::int64_t> Triangles;
  std::vector<std::int32_t> Regions;
  std::vector<unsigned char> Frozen;
};

/// The options for flipping a part of the whole mesh. The geometry has been chosen for the whole
/// mesh, and the fixed edges must be given.
FlipOptions GetPartOptions(const PartSurvey& survey, const FlipOptions& options);

/// A triangle at an edge between two shared points, as its rank sends it to the home of the edge.
struct SeamTriangle
{
  PointPair Ends; ///< Keys of the ends of the edge.
  std::int64_t Opposite; ///< Key of the point opposite to the edge.
  std::int64_t Corner; ///< 3 * triangle + slot of the opposite point, on its rank.
  SeamSide Side;

  std::int64_t GetTriangle() const { return this->Corner / 3; }
  int GetSlot() const { return static_cast<int>(this->Corner % 3); }
};

/// The triangle, for its edge opposite to corner `slot`. Takes it as not frozen and in no region.
SeamTriangle MakeSeamTriangle(const PartMesh& mesh, std::int64_t triangle, int slot);

/// A SeamTriangle with the rank that has sent it.
struct RankedTriangle
{
  PointPair Ends; ///< Seam->Ends.
  int Rank;
  const SeamTriangle* Seam;
};

/// Orders by edge, then by rank.
template <typename First, typename Second>
bool IsBefore(const First& a, const Second& b)
{
  if (a.Ends[0] != b.Ends[0])
  {
    return a.Ends[0] < b.Ends[0];
  }
  return a.Ends[1] != b.Ends[1] ? a.Ends[1] < b.Ends[1] : a.Rank < b.Rank;
}

/// Sorts the triangles that all ranks have sent by edge, then by rank.
/// @param lists must live as long as the result.
std::vector<RankedTriangle> SortByEdge(const RecordLists<SeamTriangle>& lists);

/// Judges single edges by the rules of the engine (FlipRules.h).
class QuadJudge
{
public:
  QuadJudge(const PartSurvey& survey, const FlipOptions& options);

  /// @param apqb x, y and z of the points a, p, q and b of a quad (picture in EdgeFlip.h).
  /// @returns Good, Bad or BlockedByShape.
  EdgeState Judge(const double (&apqb)[4][3]) const;

  /// The same for the two triangles of an edge. They must run through it in opposite directions.
  EdgeState Judge(const SeamSide& one, const SeamSide& other) const;

  /// The same for the edge that is opposite to both corners.
  EdgeState Judge(const PartMesh& mesh, const PartCorner& one, const PartCorner& other) const;

private:
  PackingPlan Plan;
  CriterionKind Criterion;
  bool IsSurface;
  bool Canonical;
  bool FiltersApply;
  AngleTolerance Tolerance;
  CoordinateRange Range;
};

}

#endif
