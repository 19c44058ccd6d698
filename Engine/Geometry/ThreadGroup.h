// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_THREADGROUP_H
#define DELAUNAYFLIP_THREADGROUP_H

#include "HostDevice.h"

#include <cstdint>

namespace delaunayflip
{

/// Threads that work together and can wait for each other: some thread blocks of a GPU, or one
/// thread of the CPU. A small work of many passes takes less time in one group than by a launch per
/// pass.
struct ThreadGroup
{
  std::uint32_t Rank; ///< The number of the calling thread, from 0.
  std::uint32_t Size; ///< How many threads there are.
  std::uint32_t BlockSize; ///< How many of them are in one block.

  /// Whether the calling thread is in the first block.
  DELAUNAYFLIP_HOST_DEVICE bool IsInFirstBlock() const { return this->Rank < this->BlockSize; }

  /// The threads of the first block, which wait for each other in less time. The others must end.
  DELAUNAYFLIP_HOST_DEVICE ThreadGroup GetFirstBlock() const
  {
    return { this->Rank, this->BlockSize, this->BlockSize };
  }

  /// Waits until all threads of the group are here. They see what the others have written.
  DELAUNAYFLIP_HOST_DEVICE void Sync() const
  {
#if DELAUNAYFLIP_ON_DEVICE
#if __CUDA_ARCH__ >= 900
    if (this->Size > this->BlockSize)
    {
      __cluster_barrier_arrive();
      __cluster_barrier_wait();
      return;
    }
#endif
    __syncthreads();
#endif
  }
};

}

#endif
