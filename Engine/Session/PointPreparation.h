// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_POINTPREPARATION_H
#define DELAUNAYFLIP_POINTPREPARATION_H

#include "EdgeMesh.h"
#include "FlipReport.h"
#include "PointTriangulation.h"
#include "RefinementPlan.h"
#include "SegmentCrossings.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace delaunayflip
{

class LoadedMesh;

/// The places of all points of the caller, and their memory if it is not the caller's.
struct PointPlaces
{
  PlaneArray Points;
  bool OnDevice = false;
  DeviceStream Stream{};
  std::vector<float> Floats;
  std::vector<double> Doubles;
};

/// Copies x and y of some points, from `begin` to before `end`. @param xy has room for all points.
template <typename Real>
void CopyCoordinates(const PlaneArray& points, std::int64_t begin, std::int64_t end, Real* xy)
{
  // PlaneArray::Get would ask for the type again in every call.
  const auto copy = [&](const auto* from)
  {
    for (std::int64_t i = begin; i < end; ++i)
    {
      const auto* place = from + points.Stride * i;
      xy[2 * i] = static_cast<Real>(place[0] + 0.0); // -0.0 becomes 0.0
      xy[2 * i + 1] = static_cast<Real>(place[1] + 0.0);
    }
  };
  if (points.Floats)
  {
    copy(points.Floats);
  }
  else
  {
    copy(points.Doubles);
  }
}

/// Likewise of all points.
template <typename Real>
void CopyCoordinates(const PlaneArray& points, Real* xy)
{
  CopyCoordinates(points, 0, points.Count, xy);
}

/// Requires segments to name points that there are, and hole seeds to be finite.
/// @param seedNumbers how many numbers a hole seed has. @throws InvalidMesh, InvalidOptions.
void CheckSegments(const PointInput& input, int seedNumbers);

/// The number of a segment's ring; -1: none.
std::int32_t GetRing(const PointInput& input, std::int64_t segment);

/// The place of a vertex in x and y, and the points between which it lies, with their shares.
AddedPoint ToAddedPoint(const RefinedVertex& vertex);

/// The caller's points and segments as they are triangulated: without points that are too near to
/// others, with points where segments cross, and with rings that run in one direction.
class PreparedPoints
{
public:
  /// Checks the input. @throws InvalidMesh, InvalidOptions.
  PreparedPoints(const PointInput& input, const PointOptions& options);

  /// Finds points that are too near to others, and splits segments that cross, if that is wanted
  /// and not done. For refinement it splits segments at points within rounding of them.
  /// @throws BackendUnavailable; RunAborted.
  void Prepare(const ProgressObserver& observer);

  /// Leaves out rings without an area: their segments become segments of no ring. Turns those of
  /// the others to one direction.
  /// @param mesh is made of the points, so that it knows which of them are at the same place.
  /// @throws InvalidMesh if one of the others is not closed.
  void PrepareRings(const LoadedMesh& mesh);

  /// Replaces the points of refinement, which come last. The mesh has them.
  /// @param segmentOf by RefinedVertex::Origin, the number of the caller's segment, or -1.
  void SetRefined(std::int64_t count, std::vector<std::int64_t> segmentOf);
  std::int64_t CountRefined() const { return this->Refined; }
  /// How many points the mesh is made of: those of GetInput() and those of refinement.
  std::int64_t CountAll() const { return this->Prepared.Points.Count + this->Refined; }
  AddedPoint Describe(const RefinedVertex& vertex) const;

  /// PointInput::Sizes for all points before refinement.
  std::vector<double> ListSizes() const;

  /// Copies the current places of the caller's points to the host's memory.
  void CopyPlaces(PointPlaces& places) const;

  // These change the caller's points, and drop what Prepare has made.

  /// Adds points behind those of the caller, in their precision. Prepare must follow, unless there
  /// are no segments and no tolerance. From now on this has a copy of all points.
  void Append(const PlaneArray& points);

  /// Moves the points of the caller to other places. Prepare must follow, as for Append.
  /// @param places the new places, in the precision of the points; receives the old ones.
  void Exchange(PointPlaces& places);

  /// Makes a copy of the caller's points that ExchangeSome can change, unless there is one.
  void TakeOver();
  /// Moves some points to other places, after TakeOver. Prepare must follow, as for Append. Does
  /// not throw. @param places the new ones; receives the old ones.
  void ExchangeSome(
    const std::vector<VertexId>& points, std::vector<std::array<double, 2>>& places);

  /// The points that are removed, ascending. Their places are NaN.
  const std::vector<std::int64_t>& GetRemoved() const { return this->Removed; }
  /// @returns those that were removed before.
  std::vector<std::int64_t> SetRemoved(std::vector<std::int64_t> ids)
  {
    return std::exchange(this->Removed, std::move(ids));
  }
  bool IsRemoved(std::int64_t point) const
  {
    return std::binary_search(this->Removed.begin(), this->Removed.end(), point);
  }

  /// Whether a goal asks for refinement.
  bool WantsRefinement() const;

  const PointInput& GetCaller() const { return this->Caller; }
  const PointOptions& GetOptions() const { return this->Options; }

  /// The points to triangulate; behind those of the caller, the added ones.
  const PointInput& GetInput() const { return this->Prepared; }
  /// Returns the points of GetInput() in the host's memory, where it copies them from a GPU.
  PlaneArray CopyToHost();

  const std::vector<Segment>& GetSegments() const { return this->Segments; }
  /// Those at crossings.
  const std::vector<AddedPoint>& GetAdded() const { return this->Added; }
  /// The numbers of the rings that PrepareRings has left out.
  const std::vector<std::int32_t>& GetLeftOutRings() const { return this->LeftOutRings; }
  /// Only what the preparation counts.
  const PointCounts& GetCounts() const { return this->Counts; }

  /// The point that is used instead of one that is too near to it; else the point itself.
  std::int64_t GetNear(std::int64_t point) const
  {
    return this->NearPoint.empty() ? point : this->NearPoint[point];
  }
  bool IsNear(std::int64_t point) const { return this->GetNear(point) != point; }

  /// Does what FlipSession::StoreUsedPoints does.
  void StoreUsedPoints(const LoadedMesh& mesh, std::int64_t* ids) const;

private:
  void Unprepare();
  void FindNearPoints(const ProgressObserver& observer);
  void CopyPoints();
  PlaneArray CopyCaller(std::vector<float>& floats, std::vector<double>& doubles) const;
  template <typename Real>
  void CopyUsed(std::vector<Real>& copy);
  bool MayHaveArea(const std::vector<std::size_t>& ring, const std::vector<std::int64_t>& used);

  PointInput Caller;
  PointOptions Options;
  PointInput Prepared; ///< Its points are the caller's, or one of the copies.
  std::vector<float> CallerFloats; ///< With those that Append has added.
  std::vector<double> CallerDoubles;
  std::vector<float> Floats;
  std::vector<double> Doubles;
  std::vector<std::int64_t> NearPoint; ///< By point, what GetNear returns; empty: not looked for.
  std::vector<AddedPoint> Added;
  std::int64_t Refined = 0; ///< How many points refinement has added.
  std::vector<std::int64_t> SegmentOfOrigin; ///< What SetRefined was given.
  std::vector<Segment> Segments;
  std::vector<std::int32_t> LeftOutRings;
  PointCounts Counts;
  std::vector<std::int64_t> Removed;
  bool IsPrepared = false;
};

}

#endif
