// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_MESHMOTION_H
#define DELAUNAYFLIP_MESHMOTION_H

#include "Array.h"
#include "EdgeMesh.h"
#include "FlipLoop.h"
#include "LateRounds.h"
#include "LoadedMesh.h"
#include "PointMotion.h"

#include <cstdint>
#include <memory>
#include <type_traits>
#include <vector>

namespace delaunayflip
{

/// Moves and removes points of a triangulation of points, in rounds of steps and flips.
template <typename Backend>
class MeshMotion
{
public:
  /// Moves all points.
  /// @param mesh must be Delaunay.
  /// @param targets by point, in the memory of the backend.
  /// @param used by point, what MergePlaces returned.
  /// @param segments the edges that segments have become.
  /// @param settle flips until the mesh is Delaunay, and returns the number of flips or
  /// FlipLoop::GaveUp. Its argument says whether edges were added or dropped.
  template <typename Real, typename Settle>
  MotionResult Move(const MovingMesh<Real>& mesh, const PlaneArray& targets,
    const Array<VertexId>& used, const std::vector<EdgeId>& segments, const Backend& backend,
    const Settle& settle)
  {
    MotionResult result;
    auto& motion = this->GetMotion<Real>(backend);
    motion.Begin(mesh, targets, used, segments);
    bool hasOtherEdges = false;
    do
    {
      const bool goesOn = motion.AreFewLate() ? motion.template MakeLateRounds<LateRounds>(mesh)
                                              : motion.MakeRound(mesh);
      if (!goesOn)
      {
        return result;
      }
      result.Flips += motion.CountLateFlips();
      hasOtherEdges = hasOtherEdges || motion.HasChangedHull();
      if (motion.IsDelaunay())
      {
        continue; // with all vertices at their targets
      }
      const std::int64_t flips = settle(motion.HasChangedHull());
      if (flips == FlipLoop::GaveUp)
      {
        return result;
      }
      result.Flips += flips;
    } while (motion.CountLate() > 0);
    motion.End(mesh);
    if (hasOtherEdges)
    {
      result.Edges = motion.FetchPinned(mesh);
    }
    result.Rounds = motion.CountRounds();
    result.IsThere = true;
    return result;
  }

  /// Removes points.
  /// @param ids the mesh's own, which change.
  /// @param segments as for Move; none ends at one of these points.
  /// @param settle as for Move.
  template <typename Real, typename Settle>
  MotionResult Remove(const MovingMesh<Real>& mesh, VertexId* ids, const RemovedPoints& removed,
    const std::vector<EdgeId>& segments, const Backend& backend, const Settle& settle)
  {
    MotionResult result;
    auto& motion = this->GetMotion<Real>(backend);
    result.IsThere = motion.Remove(mesh, ids, removed, segments);
    if (result.IsThere)
    {
      result.Rounds = 1;
      result.Flips = settle(true);
      result.Edges = motion.FetchPinned(mesh);
    }
    return result;
  }

private:
  template <typename Real>
  PointMotion<Real, Backend>& GetMotion(const Backend& backend)
  {
    const auto require = [&](auto& motion) -> auto&
    {
      if (!motion)
      {
        motion = std::make_unique<PointMotion<Real, Backend>>(backend);
      }
      return *motion;
    };
    if constexpr (std::is_same<Real, float>::value)
    {
      return require(this->Floats);
    }
    else
    {
      return require(this->Doubles);
    }
  }

  // The mesh has coordinates of one type. The other pointer stays null.
  std::unique_ptr<PointMotion<float, Backend>> Floats;
  std::unique_ptr<PointMotion<double, Backend>> Doubles;
};

}

#endif
