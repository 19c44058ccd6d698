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
    if (!KeepsUse(targets, used, backend))
    {
      return result;
    }
    auto& motion = this->GetMotion<Real>(backend);
    motion.Begin(mesh, targets, segments);
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
      ClearCandidates(mesh.Edges, backend);
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
      ClearCandidates(mesh.Edges, backend);
    }
    return result;
  }

  // The functions below are public because device lambdas require it.

  /// Whether the points that are not used stay so. Each of them must be at the place of the same
  /// used point as before, or not be finite, as before.
  static bool KeepsUse(
    const PlaneArray& targets, const Array<VertexId>& used, const Backend& backend)
  {
    const VertexId* usedPoint = used.Data();
    return backend.template Sum<std::int64_t>(static_cast<std::int64_t>(used.Size()),
             [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i, std::int64_t & sum)
             {
               const VertexId own = usedPoint[i];
               const double x = targets.Get(i, 0), y = targets.Get(i, 1);
               bool isKept = own == i || (own == NoVertex && !(IsFinite(x) && IsFinite(y)));
               if (!isKept && own != NoVertex)
               {
                 isKept = x == targets.Get(own, 0) && y == targets.Get(own, 1);
               }
               sum += isKept ? 0 : 1;
             }) == 0;
  }

  /// Makes candidates good edges. A loop on a device reads states and does not write them, so the
  /// next loop would judge these edges again.
  static void ClearCandidates(EdgeMesh& mesh, const Backend& backend)
  {
    if constexpr (!Backend::IsOnHost)
    {
      EdgeState* states = mesh.States.Data();
      backend.ForEach(mesh.NumberOfEdges,
        [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t edge)
        {
          const bool isFixed = states[edge] == EdgeState::Fixed;
          states[edge] = isFixed ? EdgeState::Fixed : EdgeState::Good;
        });
    }
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
