// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_LOOPVIEW_CUH
#define DELAUNAYFLIP_LOOPVIEW_CUH

#include "DeviceWorklist.cuh"
#include "EdgeBits.h"
#include "EdgeGuard.h"
#include "EdgeMesh.h"
#include "IterationSums.h"
#include "Team.cuh"

namespace delaunayflip
{

/// The edges of a chunk of FlipLoop's schedule.
struct DeviceChunk
{
  EdgeId FirstEdge, LastEdge;
};

/// What the loop's kernels read and write.
template <typename Rule>
struct LoopView
{
  EdgeMeshView Mesh; ///< Its States are the initial ones.
  Rule Decision;
  EdgeGuardView Guard;
  EdgeBits Bits;
  int Splits; ///< 2^Splits warps share a unit.
  int Parts; ///< How many GPUs iterate on the whole mesh together.
  EdgeId FirstEdge, LastEdge; ///< Of this GPU.
  DeviceChunk* Chunks;
  int FirstChunk, LastChunk; ///< Of this GPU.
  TeamState* Teams; ///< Zero before a launch.
  IterationSums* Sums; ///< One per iteration and one more; zero before a launch.
  int* IterationsDone; ///< Iterations of this launch.

  __device__ WarpWorklist GetWorklist() const
  {
    return { this->FirstEdge, this->LastEdge, this->Splits };
  }
  __device__ BlockWorklist GetWorklist(const DeviceChunk& chunk) const
  {
    return { chunk.FirstEdge, chunk.LastEdge };
  }
};

template <typename Worklist, typename Rule>
__device__ bool HasGuard(const LoopView<Rule>& loop)
{
  return Worklist::MayGuard && loop.Guard.Active;
}

}

#endif
