// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CudaDevice.h"
#include "FlipEngine.h"
#include "FlipError.h"

/// @file
/// Replaces the CUDA backend in a build without it.

namespace delaunayflip
{

std::unique_ptr<FlipEngine> MakeCudaEngine(
  const TriangleMesh&, const FlipOptions&, const BuildProgress&)
{
  throw BackendUnavailable("this build has no CUDA backend; use 'auto' or 'threads'");
}

bool HasCudaDevice() { return false; }

void ReleaseCudaMemory() {}

std::size_t TakePeakCudaMemory() { return 0; }

}
