// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_THREADGROUP_H
#define DELAUNAYFLIP_THREADGROUP_H

#include "HostDevice.h"

#include <cstdint>

namespace delaunayflip
{

/// Threads that work together and can wait for each other: a thread block of a GPU, or one thread
/// of the CPU. A small work of many passes takes less time in one group than by a launch per pass.
struct ThreadGroup
{
  std::uint32_t Rank; ///< The number of the calling thread, from 0.
  std::uint32_t Size; ///< How many threads there are.

  /// Waits until all threads of the group are here. They see what the others have written.
  DELAUNAYFLIP_HOST_DEVICE void Sync() const
  {
#if DELAUNAYFLIP_ON_DEVICE
    __syncthreads();
#endif
  }
};

}

#endif
