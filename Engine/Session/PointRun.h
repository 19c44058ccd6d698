// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_POINTRUN_H
#define DELAUNAYFLIP_POINTRUN_H

#include "FlipReport.h"
#include "LoadedMesh.h"
#include "Outline.h"
#include "PointTriangulation.h"
#include "RefusedSegments.h"
#include "SegmentCrossings.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace delaunayflip
{

/// What a session from points does beside flips: it prepares points and segments, inserts segments,
/// and removes triangles in the end.
class PointRun
{
public:
  /// @throws InvalidMesh, InvalidOptions.
  PointRun(const PointInput& input, const PointOptions& options);

  /// Finds points that are too near to others, and splits segments that cross, if that is wanted
  /// and not done.
  /// @throws BackendUnavailable; RunAborted.
  void Prepare(const ProgressObserver& observer);

  /// Forgets what was inserted and removed: for another mesh of the same points.
  void Reset();

  /// The points to triangulate; behind those of the caller, the added ones.
  const PointInput& GetPoints() const { return this->Prepared; }
  /// The same in the host's memory.
  PlaneArray GetOnHost();

  std::int64_t CountCallerPoints() const { return this->Caller.Points.Count; }
  bool HasSegments() const { return !this->Segments.empty(); }
  bool AreInserted() const { return this->Inserted; }
  /// Whether some are inserted, and an observer has stopped the rest.
  bool WasStopped() const { return this->Taken > 0 && !this->Inserted; }

  /// Inserts the segments into a triangulation. Detect must follow.
  /// @param observer is told the share of the segments that is inserted.
  /// @returns false if the observer stopped it; then another call goes on.
  /// @throws InvalidMesh if a ring with an area is not closed or a segment of it is refused.
  bool Insert(LoadedMesh& mesh, const ProgressObserver& observer);

  /// Removes triangles as the options say.
  void Finish(LoadedMesh& mesh);

  /// Adds what this knows to a report whose other counts are those of the loaded mesh.
  void AddTo(FlipReport& report, LoadedMesh& mesh) const;

  /// The same as FlipSession's.
  void StoreUsedPoints(const LoadedMesh& mesh, std::int64_t* ids) const;
  const std::vector<AddedPoint>& GetAddedPoints() const { return this->Added; }
  std::vector<std::int64_t> ListSegmentEdges(LoadedMesh& mesh) const;

  bool HasRemoved() const { return !this->Kept.Numbers.empty(); }

  /// Copies of `width` values per triangle those of the triangles that are kept.
  template <typename Value>
  void CopyKept(const Value* values, int width, Value* kept) const
  {
    for (std::size_t t = 0; t < this->Kept.Numbers.size(); ++t)
    {
      if (this->Kept.Numbers[t] >= 0)
      {
        std::copy_n(values + width * t, width,
          kept + static_cast<std::int64_t>(width) * this->Kept.Numbers[t]);
      }
    }
  }

  /// Names triangles by the numbers that they have among those that are kept; -1: none.
  void Renumber(std::int32_t* triangles, std::int64_t count) const
  {
    for (std::int64_t i = 0; i < count && this->HasRemoved(); ++i)
    {
      triangles[i] = triangles[i] < 0 ? -1 : this->Kept.Numbers[triangles[i]];
    }
  }

private:
  void FindNearPoints(const ProgressObserver& observer);
  void CopyPoints();
  template <typename Real>
  void CopyCoordinates(std::vector<Real>& copy);
  void PrepareRings(const LoadedMesh& mesh);
  bool MayHaveArea(const std::vector<std::size_t>& ring, const std::vector<std::int64_t>& used);
  void TurnSegments(const std::vector<std::size_t>& ring, const std::vector<std::int64_t>& used);
  void ExplainRefused(LoadedMesh& mesh);
  Defect FindRingsWithoutArea() const;
  void Take(const InsertedSegments& made);
  Defect DescribeLoss() const;

  PointInput Caller;
  PointOptions Options;
  PointInput Prepared; ///< Its points are the caller's, or one of the copies.
  std::vector<float> Floats;
  std::vector<double> Doubles;
  std::vector<std::int64_t> NearPoint; ///< By point: itself, or the one that it is too near to.
  std::vector<AddedPoint> Added;
  std::vector<Segment> Segments;
  std::vector<std::int32_t> LeftOutRings; ///< Their numbers: all places are on one line.
  PointCounts Counts;
  bool IsPrepared = false;
  bool Inserted = false;
  std::size_t Taken = 0; ///< Segments that are inserted or refused.
  std::int64_t Flips = 0; ///< That inserted segments.
  std::vector<SegmentEdge> Edges;
  std::vector<bool> Seen; ///< By edge, up to the largest number, whether it is one of these.
  std::vector<RefusedSegment> Refused;
  KeptTriangles Kept;
  Defect Loss; ///< If none of the points that matter is left.
};

}

#endif
