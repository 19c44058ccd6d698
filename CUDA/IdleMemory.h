// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_IDLEMEMORY_H
#define DELAUNAYFLIP_IDLEMEMORY_H

#include "FlipError.h"

namespace delaunayflip
{

/// Frees the memory that is kept for later runs of the process, on all GPUs. @returns whether there
/// was any.
bool ReleaseIdleMemory();

/// Calls allocate(), and once more without that memory if it fails. Other runs, on other sets of
/// GPUs or at the same time, may have left it.
/// @throws BackendUnavailable.
template <typename Allocate>
void* AllocateOrRelease(const Allocate& allocate)
{
  try
  {
    return allocate();
  }
  catch (const BackendUnavailable&)
  {
    if (!ReleaseIdleMemory())
    {
      throw;
    }
    return allocate();
  }
}

}

#endif
