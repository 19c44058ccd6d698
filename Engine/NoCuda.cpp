// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Array.h"
#include "CudaDevice.h"
#include "FlipError.h"
#include "LoadedMesh.h"

/// @file
/// Replaces the CUDA backend in a build without it.

namespace delaunayflip
{

namespace
{
constexpr const char* NoArrays =
  "this build has no CUDA backend, so it can use no arrays in the memory of a GPU";
}

std::unique_ptr<LoadedMesh> LoadOnCuda(
  const TriangleMesh&, const FlipOptions&, const BuildProgress&)
{
  throw BackendUnavailable("this build has no CUDA backend; use 'auto' or 'threads'");
}

std::unique_ptr<LoadedMesh> LoadOnCuda(const DeviceMesh&, const FlipOptions&, const BuildProgress&)
{
  throw BackendUnavailable(NoArrays);
}

std::unique_ptr<LoadedMesh> LoadOnCuda(const PointInput&, const FlipOptions&, const BuildProgress&)
{
  throw BackendUnavailable("this build has no CUDA backend; use 'auto' or 'threads'");
}

int FindDeviceOf(const void*) { throw BackendUnavailable(NoArrays); }

void CopyMemory(const void*, std::int64_t, void*, const DeviceStream&)
{
  throw BackendUnavailable(NoArrays);
}

bool HasCudaDevice() { return false; }

int CountCudaDevices() { return 0; }

void ReleaseCudaMemory() {}

std::size_t TakePeakCudaMemory() { return 0; }

}
