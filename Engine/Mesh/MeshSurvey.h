// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_MESHSURVEY_H
#define DELAUNAYFLIP_MESHSURVEY_H

#include "Array.h"
#include "FilteredPredicates.h"
#include "FlipOptions.h"
#include "FlipReport.h"
#include "HostDevice.h"
#include "SurfaceAngles.h"
#include "TriangleMesh.h"
#include "WideAngles.h"

#include <cstdint>
#include <string>

/// @file
/// The first examination of an input: whether its ids are valid, which points are used, and in
/// which space edges are judged. Made by MeshSurveyBuilder.h.

namespace delaunayflip
{

//------------------------------------------------------------------------------
// Counts of defects of the input, on either backend.

/// A count and the three smallest ids, whatever the order of counting.
struct IdSample
{
  static constexpr int Kept = 3;

  std::int64_t Count = 0;
  std::int64_t Smallest[Kept] = { 0, 0, 0 }; ///< The first min(Count, 3), ascending.

  DELAUNAYFLIP_HOST_DEVICE void Note(std::int64_t id)
  {
    if (this->Count < Kept || id < this->Smallest[Kept - 1])
    {
      this->Keep(id, this->Count);
    }
    ++this->Count;
  }

  DELAUNAYFLIP_HOST_DEVICE IdSample& operator+=(const IdSample& other)
  {
    for (int i = 0; i < Kept && i < other.Count; ++i)
    {
      this->Keep(other.Smallest[i], this->Count + i);
    }
    this->Count += other.Count;
    return *this;
  }

private:
  /// Inserts an id among `count` known ones.
  DELAUNAYFLIP_HOST_DEVICE void Keep(std::int64_t id, std::int64_t count)
  {
    for (int i = 0; i < Kept; ++i)
    {
      if (i >= count)
      {
        this->Smallest[i] = id;
        return;
      }
      if (id < this->Smallest[i])
      {
        const std::int64_t next = this->Smallest[i];
        this->Smallest[i] = id;
        id = next;
      }
    }
  }
};

/// Triangles by the side to which they turn.
struct TurnSample
{
  IdSample Left, Right, Flat;

  /// @param turn positive: to the left.
  DELAUNAYFLIP_HOST_DEVICE void Note(int turn, std::int64_t triangle)
  {
    (turn == 0 ? this->Flat : (turn > 0 ? this->Left : this->Right)).Note(triangle);
  }

  DELAUNAYFLIP_HOST_DEVICE TurnSample& operator+=(const TurnSample& part)
  {
    this->Left += part.Left;
    this->Right += part.Right;
    this->Flat += part.Flat;
    return *this;
  }
};

inline Defect MakeDefect(
  const std::string& what, const IdSample& sample, DefectIds ids = DefectIds::Triangles)
{
  Defect defect{ what, sample.Count, {}, ids };
  for (int i = 0; i < IdSample::Kept && i < sample.Count; ++i)
  {
    defect.FirstIds.push_back(sample.Smallest[i]);
  }
  return defect;
}

//------------------------------------------------------------------------------

/// An input as a backend sees it.
struct MeshInput
{
  const TriangleMesh& Caller; ///< The caller's arrays.
  TriangleMesh Local; ///< The same in the backend's memory; constraints are the caller's.
  bool IsOnHost = true; ///< Whether the caller's points and triangles are in the host's memory;
                        ///< else the triangles are those of Local.
};

/// Which coordinates decide in planar geometry: U and V span the plane's projection along its
/// dominant axis W. The handedness of (U, V, W) is that of (x, y, z).
struct PlaneProjection
{
  int AxisU = 0;
  int AxisV = 1;
  int AxisW = 2;
  bool Tilted = false; ///< W is not constant, so it belongs to the lift of the in-circle test.

  PlanePoint Project(const PointArray& points, std::int64_t point) const
  {
    return { points.Get(point, this->AxisU), points.Get(point, this->AxisV),
      this->Tilted ? points.Get(point, this->AxisW) : 0.0 };
  }
};

enum class PointUse : std::uint8_t
{
  Unused,
  Used,
  NotFinite ///< Used, and a coordinate that matters is NaN or infinite.
};

struct BoundingBox
{
  double Lower[3] = { 0.0, 0.0, 0.0 };
  double Upper[3] = { 0.0, 0.0, 0.0 };
};

/// How the finite triangles of a mesh turn when seen along z.
struct TurnCounts
{
  int Side = 0; ///< The side to which most turn: 1 or -1; 0 if no triangle has area in x and y.
  std::int64_t Triangles = 0;
  std::int64_t Others = 0; ///< Turned to the other side.
  std::int64_t Flat = 0; ///< Without area in x and y.

  /// Whether all triangles, except at most one in 1,000, turn to one side.
  bool AreUniform() const { return this->Side != 0 && 1000 * this->GetStrays() <= this->Triangles; }
  /// Whether all with area do, except at most one in 100; at most one in five has none.
  bool AreNearlyUniform() const
  {
    return this->Side != 0 && 100 * this->Others <= this->Triangles - this->Flat &&
      5 * this->Flat <= this->Triangles;
  }
  std::int64_t GetStrays() const { return this->Others + this->Flat; }
};

struct MeshSurvey
{
  GeometryKind Geometry = GeometryKind::Surface; ///< Never Auto.
  std::string GeometryReason; ///< As FlipReport's.
  TurnCounts Turns; ///< For surfaces, and if Auto needed them.
  PlaneProjection Projection; ///< For the planar kinds.
  Array<PointUse> Uses; ///< One per point, in the backend's memory.
  std::int64_t UsedPoints = 0;
  BoundingBox Box; ///< Of the used, finite points.
  double SmallestMagnitude = INFINITY; ///< Of their coordinates that are not 0.
  bool FiltersApply = true; ///< Coordinates are in the range of FilteredPredicates.h.
  CoordinateRange Range = CoordinateRange::Usual; ///< Of the used, finite points.
  double Precision = DoublePrecision; ///< Of the caller's coordinates, by their type.
  Defect NonFinitePoints;
  Defect RepeatedIds;
  Defect NearlyHeightField; ///< What kept Auto from PlanarXY, if it was little.
};

/// Whether x, y and z of a point are finite; for PlanarXY only x and y matter.
DELAUNAYFLIP_HOST_DEVICE inline bool IsFinitePoint(
  const PointArray& points, std::int64_t point, GeometryKind geometry)
{
  const double z = geometry == GeometryKind::PlanarXY ? 0.0 : points.Get(point, 2);
  return IsFinite(points.Get(point, 0)) && IsFinite(points.Get(point, 1)) && IsFinite(z);
}

}

#endif
