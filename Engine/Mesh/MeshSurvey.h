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

#include <algorithm>
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

/// Triangles by their orientation when seen along an axis.
struct OrientationSample
{
  IdSample Left; ///< Counter-clockwise, with orientation 1.
  IdSample Right; ///< Clockwise, with orientation -1.
  IdSample Flat; ///< Without area.

  DELAUNAYFLIP_HOST_DEVICE void Note(int orientation, std::int64_t triangle)
  {
    if (orientation > 0)
    {
      this->Left.Note(triangle);
    }
    else if (orientation < 0)
    {
      this->Right.Note(triangle);
    }
    else
    {
      this->Flat.Note(triangle);
    }
  }

  DELAUNAYFLIP_HOST_DEVICE OrientationSample& operator+=(const OrientationSample& part)
  {
    this->Left += part.Left;
    this->Right += part.Right;
    this->Flat += part.Flat;
    return *this;
  }

  /// The orientation of most triangles: 1 or -1; 0 if none has area.
  int GetSide() const
  {
    if (this->Left.Count + this->Right.Count == 0)
    {
      return 0;
    }
    return this->Left.Count >= this->Right.Count ? 1 : -1;
  }
  /// The triangles with the other orientation.
  const IdSample& GetOthers() const { return this->GetOthers(this->GetSide()); }
  /// The triangles with another orientation than `side`.
  const IdSample& GetOthers(int side) const { return side < 0 ? this->Left : this->Right; }
  std::int64_t Count() const { return this->Left.Count + this->Right.Count + this->Flat.Count; }
  std::int64_t CountStrays() const { return this->GetOthers().Count + this->Flat.Count; }
  /// Whether all triangles, except at most one in 1,000, have one orientation.
  bool AreUniform() const
  {
    return this->GetSide() != 0 && 1000 * this->CountStrays() <= this->Count();
  }
  /// Whether all with an area have one, except at most one in 100, and at most one in five is flat.
  bool AreNearlyUniform() const
  {
    return this->GetSide() != 0 &&
      100 * this->GetOthers().Count <= this->Count() - this->Flat.Count &&
      5 * this->Flat.Count <= this->Count();
  }
};

inline Defect MakeDefect(DefectKind kind, const IdSample& sample)
{
  Defect defect(kind, sample.Count);
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
  TriangleMesh Local; ///< The mesh in the backend's memory; constraints are the caller's.
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

  bool IsInXY() const { return this->AxisW == 2 && !this->Tilted; }
  /// For refinement in a tilted plane: two orthogonal unit vectors in it, as (U, V, W). Seen from
  /// the positive end of W, the second one is to the left of the first.
  double Along[2][3] = { { 1.0, 0.0, 0.0 }, { 0.0, 1.0, 0.0 } };

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

/// If it holds no point, Lower exceeds Upper.
struct BoundingBox
{
  double Lower[3] = { INFINITY, INFINITY, INFINITY };
  double Upper[3] = { -INFINITY, -INFINITY, -INFINITY };

  /// NaN changes nothing.
  DELAUNAYFLIP_HOST_DEVICE void Include(int axis, double lower, double upper)
  {
    this->Lower[axis] = std::min(this->Lower[axis], lower);
    this->Upper[axis] = std::max(this->Upper[axis], upper);
  }
};

struct MeshSurvey
{
  GeometryKind Geometry = GeometryKind::Surface; ///< Never Auto.
  std::string GeometryReason; ///< FlipReport::GeometryReason.
  /// In x and y, of the finite triangles of surfaces, and if Auto needed them.
  OrientationSample Orientations;
  PlaneProjection Projection; ///< For the planar kinds.
  Array<PointUse> Uses; ///< One per point, in the backend's memory.
  std::int64_t UsedPoints = 0;
  BoundingBox Box{ {}, {} }; ///< Holds the used, finite points; all 0 without any.
  double SmallestMagnitude = INFINITY; ///< The smallest of their coordinates, without 0.
  bool FiltersApply = true; ///< Coordinates are in the range of FilteredPredicates.h.
  CoordinateRange Range = CoordinateRange::Usual; ///< The range of the used, finite points.
  double Precision = DoublePrecision; ///< By the type of the caller's coordinates.
  Defect NonFinitePoints;
  Defect RepeatedIds;
  Defect NearlyHeightField; ///< What kept Auto from PlanarXY, if it was little.

  /// Uses, or null if all used points are finite.
  const PointUse* GetUsesIfNeeded() const
  {
    return this->NonFinitePoints.Count > 0 ? this->Uses.Data() : nullptr;
  }
};

/// Whether x, y and z of a point are finite; for PlanarXY only x and y matter.
DELAUNAYFLIP_HOST_DEVICE inline bool IsFinitePoint(
  const PointArray& points, std::int64_t point, GeometryKind geometry)
{
  return IsFinite(points.Get(point, 0)) && IsFinite(points.Get(point, 1)) &&
    (geometry == GeometryKind::PlanarXY || IsFinite(points.Get(point, 2)));
}

/// How many coordinates of a point matter: for PlanarXY only x and y.
DELAUNAYFLIP_HOST_DEVICE inline int CountAxes(GeometryKind geometry)
{
  return geometry == GeometryKind::PlanarXY ? 2 : 3;
}

}

#endif
