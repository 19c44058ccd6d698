// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PEAKMEMORY_H
#define DELAUNAYFLIP_PEAKMEMORY_H

#include "DelaunayFlip.h"
#include "GeneratedMeshes.h"

namespace delaunayflip
{

/// The peak resident memory of a whole run beyond its input and output arrays, in bytes; -1 if the
/// system does not report it.
///
/// A forked child shares the input and fills its output array first. It reads its resident size
/// (VmRSS), runs, and reads the peak since the fork (VmHWM). Threads do not survive a fork, so call
/// this before any thread is started.
std::int64_t MeasurePeakMemory(const OwnedMesh<float>& mesh, const FlipOptions& options);

}

#endif
