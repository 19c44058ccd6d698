// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_SPHERERUN_H
#define DELAUNAYFLIP_SPHERERUN_H

#include "DelaunayFlip.h"
#include "SessionRun.h"
#include "SphereStart.h"

#include <cstdint>
#include <vector>

namespace delaunayflip
{

/// Makes the convex hull of points, seen as a triangulation on a sphere. It is made of two other
/// sessions, one of the projected points in the plane and one of the closed mesh on the sphere.
/// Advance does all, whatever the number of iterations.
///
/// After the flips in the plane everything is judged by exact signs of the points as given. Points
/// where the projection has folded the mesh over are left out, and inserted at the end. Edges that
/// flips cannot make convex end at points that are inside of the hull: without these all begins
/// again. So it does without points within a plane or an edge of the hull, because which of these
/// have triangles would depend on the start.
class SphereRun final : public SessionRun
{
public:
  /// @throws InvalidOptions for what there is only in the plane.
  SphereRun(const PointInput& input, const PointOptions& options, const ProgressObserver& progress);

  bool Advance(std::int64_t iterations, const FlipObserver& observer,
    const ProgressObserver& progress) override;
  const FlipReport& GetReport() override { return this->Report; }
  void StoreTriangles(const MutableTriangleArray& triangles) override;
  void StoreFlipCounts(std::int32_t* counts) override;
  void StoreNeighbors(std::int32_t* neighbors) override;
  void StoreUsedPoints(std::int64_t* ids) override;
  std::vector<std::int64_t> ListSegmentEdges() override { return {}; }
  std::vector<std::int64_t> ListSegmentsOfEdges() override { return {}; }
  void StoreRegions(std::int32_t* labels) override;
  // These throw InvalidOptions.
  void StoreSources(std::int32_t* sources) override;
  bool Insert(const PlaneArray& points, const ProgressObserver& progress) override;
  bool Move(const PointMove& move, const ProgressObserver& progress) override;
  bool Remove(
    const std::int64_t* ids, std::int64_t count, const ProgressObserver& progress) override;
  bool Compact(const ProgressObserver& progress) override;
  bool Ask(const PlaceQuery& query, const ProgressObserver& progress) override;

private:
  enum class PointState : char
  {
    Used,
    NotFinite,
    Repeated, ///< Another one at its place is used.
    LeftOut, ///< The projection does not suit it. It is inserted at the end.
    Inside
  };

  void Run();
  void ReadPoints();
  bool Start();
  void StartInPlane(std::int32_t pole);
  bool StartFromSimplex();
  void MarkRepeated();
  bool ChooseCenter(const std::vector<std::int32_t>& simplex);
  void Flip();
  bool LeaveOut(const std::vector<std::int32_t>& points, PointState state);
  bool InsertLeftOut();
  void Complete();
  void OpenMesh();
  void ListUnused();
  std::vector<std::int32_t> ListActive() const;
  ProgressObserver TellHalf();
  void Reset() override;

  const PointInput Input;
  const PointOptions Options;
  SpacePoints Points;
  std::vector<PointState> States; ///< By point.
  std::vector<std::int32_t> UsedPoint; ///< By point: the one at its place.
  std::vector<std::int32_t> Triangles, Neighbors, FlipCounts;
  PlanePoint Center{ 0.0, 0.0, 0.0 }; ///< From where triangles are seen.
  double Done = 0.0; ///< The share of the work.
  int Starts = 0;
  FlipReport Planar; ///< Sums over the flips in the plane.
};

}

#endif
