// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_POINTRUN_H
#define DELAUNAYFLIP_POINTRUN_H

#include "LoadedRun.h"
#include "PointPreparation.h"
#include "PointReport.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace delaunayflip
{

/// The run of points in the plane. Its stages are listed in ListStages.
class PointRun final : public LoadedRun
{
public:
  /// @throws as FlipSession's constructor.
  PointRun(const PointInput& input, const PointOptions& options, const ProgressObserver& progress);

  void StoreTriangles(const MutableTriangleArray& triangles) override;
  void StoreOrderedTriangles(const MutableTriangleArray& triangles) override;
  void StoreFlipCounts(std::int32_t* counts) override;
  bool StoreTrianglesOnDevice(const MutableTriangleArray& triangles, const DeviceStream& stream,
    std::int32_t* written) override;
  bool StoreFlipCountsOnDevice(std::int32_t* counts, const DeviceStream& stream) override;

  void StoreNeighbors(std::int32_t* neighbors) override;
  bool StoreNeighborsOnDevice(std::int32_t* neighbors, const DeviceStream& stream) override;
  void StoreUsedPoints(std::int64_t* ids) override;
  std::vector<std::int64_t> ListSegmentEdges() override;

  /// See FlipSession. (PointRefinement.cpp)
  const std::vector<AddedPoint>& GetAddedPoints() override;
  void StoreAddedPoints(const AddedPointArrays& arrays) override;
  std::vector<std::int64_t> ListSegmentsOfEdges() override;
  void StoreRegions(std::int32_t* labels) override;

  /// See FlipSession. (PointInsertion.cpp)
  bool Insert(const PlaneArray& points, const ProgressObserver& progress) override;

  /// See FlipSession. (PointMoves.cpp)
  bool Move(const PointMove& move, const ProgressObserver& progress) override;
  bool Remove(
    const std::int64_t* ids, std::int64_t count, const ProgressObserver& progress) override;
  bool Compact(const ProgressObserver& progress) override;

  /// See FlipSession. (PointAnswers.cpp)
  bool Ask(const PlaceQuery& query, const ProgressObserver& progress) override;

private:
  /// Stands for the number of a batch in the journal: all points were triangulated, at their
  /// current places.
  static constexpr std::int64_t AllPoints = -1;

  void ListStages();
  void Triangulate();
  bool GivesUpFlips();
  void DropIterations(std::size_t left);
  void ReplaceSlowFlips();
  void DivideAndConquer(LoadedMesh& mesh);
  bool InsertSegments();
  void InsertUpTo(std::size_t end, LoadedMesh& mesh, const ProgressObserver& observer);
  void Take(const InsertedSegments& made);
  void ExplainRefused(LoadedMesh& mesh);
  void CutOff();
  void RemoveTriangles(LoadedMesh& mesh);
  bool IsDelaunay() const;
  bool AreFew(std::int64_t points) const;
  bool CanInsertInPlace(const PlaneArray& points);
  bool InsertInPlace(std::int64_t count);
  MotionResult InsertBatch(LoadedMesh& mesh, std::size_t batch) const;
  void ReadPlaces(const PointMove& move);
  bool GoToPlaces(std::vector<std::int64_t> removed, const ProgressObserver& progress);
  using InPlaceChange = std::function<bool(const BuildProgress&)>;
  bool Follow(std::vector<std::int64_t> removed, const InPlaceChange& change,
    const std::function<void()>& goBack, const ProgressObserver& progress);
  bool MoveInPlace(const BuildProgress& progress);
  bool RemoveInPlace(const std::vector<VertexId>& ids);
  template <typename Change>
  bool ChangeInPlace(const Change& change);
  void RecordMotion(const MotionResult& motion);
  void RepeatAll(LoadedMesh& mesh);
  bool MaySegmentsStay();
  void ListPins(LoadedMesh& mesh);
  void JudgeTriangles(LoadedMesh& mesh);
  bool JudgeAgain(const MotionResult& motion);
  void LabelRegions();
  void LabelRegions(LoadedMesh& mesh);
  RefinementPlan PlanRefinement(LoadedMesh& mesh) override;
  void TakeRefinement(LoadedMesh& mesh) override;
  void CountRefinedPoints(const RefinementResult& made, const std::vector<std::uint32_t>& originOf);
  void VisitAdded(const std::function<void(std::int64_t, const AddedPoint&)>& visit);
  AskResult Answer(const PlaceQuery& query, const ProgressObserver& progress);

  std::unique_ptr<LoadedMesh> LoadOn(BackendKind backend) override;
  void Reset() override;
  void ListDefects() override;
  std::int64_t GetBatch() const override;

  PreparedPoints Points;
  /// Where batches of inserted points end. The mesh was loaded with the points before the first of
  /// these numbers; batch i is the points from number i to number i + 1. Empty: it was loaded with
  /// all points.
  std::vector<std::int64_t> BatchEnds;
  PointPlaces Places; ///< The next places, or the last ones. Kept so that moves reuse the memory.
  PointResult Result; ///< What was done to the loaded mesh beside flips.
  std::vector<AddedPoint> Added; ///< What GetAddedPoints returns if there are points of refinement.
  bool AreFlipsSlow = false; ///< Whether divide and conquer takes over.
};

}

#endif
