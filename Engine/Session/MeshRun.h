// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_MESHRUN_H
#define DELAUNAYFLIP_MESHRUN_H

#include "CallerMesh.h"
#include "ConstraintInsertion.h"
#include "LoadedRun.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace delaunayflip
{

/// What refinement has made of a mesh.
struct RefinedCallerMesh
{
  std::vector<AddedPoint> Points;
  std::vector<TriangleId> Sources; ///< By triangle, its source. Empty before the first round.
  Defect Unrefined; ///< Triangles that do not reach the goals.
  bool HasReachedLimit = false;
};

/// Places to which the points of a mesh have moved, in one precision or the other.
struct MovedPoints
{
  std::vector<float> Floats;
  std::vector<double> Doubles;

  PointArray View() const
  {
    constexpr std::size_t Components = 3;
    return this->Floats.empty()
      ? PointArray(this->Doubles.data(), std::int64_t(this->Doubles.size() / Components))
      : PointArray(this->Floats.data(), std::int64_t(this->Floats.size() / Components));
  }
};

/// The run of a mesh in one piece. Its stages are listed in ListStages.
class MeshRun final : public LoadedRun
{
public:
  /// @throws as FlipSession's constructor.
  MeshRun(const CallerMesh& mesh, const FlipOptions& options, const ProgressObserver& progress);

  void StoreTriangles(const MutableTriangleArray& triangles) override;
  void StoreFlipCounts(std::int32_t* counts) override;
  bool StoreTrianglesOnDevice(const MutableTriangleArray& triangles, const DeviceStream& stream,
    std::int32_t* written) override;
  bool StoreFlipCountsOnDevice(std::int32_t* counts, const DeviceStream& stream) override;
  const std::vector<AddedPoint>& GetAddedPoints() override { return this->Refined.Points; }
  void StoreSources(std::int32_t* sources) override;
  void StoreRegions(std::int32_t* labels) override;
  bool Move(const PointMove& move, const ProgressObserver& progress) override;

private:
  void ListStages();
  void GoOnAt(MovedPoints points);
  void InsertConstraints();
  std::unique_ptr<LoadedMesh> LoadOn(BackendKind backend) override;
  void Reset() override;
  void ListDefects() override;
  void MeasureKeptEdges() override;

  // (MeshRefinement.cpp)
  RefinementPlan PlanRefinement(LoadedMesh& mesh) override;
  void TakeRefinement(LoadedMesh& mesh) override;
  void AddRefinedPoints(const RefinementResult& made);
  void LabelRegions();
  void NumberRegions(RefinementPlan& plan) const;
  std::int64_t CountConstraints(const RefinementResult& made) const;

  CallerMesh Mesh;
  ConstraintInsertion Insertion; ///< Owns the arrays of Start if it has inserted constraints.
  CallerMesh Start; ///< The caller's mesh, with its constraints inserted.
  std::size_t AfterLoad = 0; ///< The number of the stage after that which loads the mesh.
  MovedPoints Moved; ///< Has the caller's points after a move.
  /// Whether points have moved. Since then flips are counted anew, without those of Insertion.
  bool HasMoved = false;
  RefinedCallerMesh Refined;
  std::vector<std::int32_t> Regions; ///< What FindSeededRegions returns, if there are seeds.
};

}

#endif
