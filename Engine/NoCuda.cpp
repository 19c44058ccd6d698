// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Array.h"
#include "CudaDevice.h"
#include "CudaSupport.h"
#include "FlipError.h"
#include "LoadedMesh.h"
#include "LoadedSphere.h"

#include <string>

/// @file
/// Replaces the CUDA backend in a build without it.

namespace delaunayflip
{

namespace
{
[[noreturn]] void Refuse(const char* consequence)
{
  const std::string reason = ExplainNoCuda();
  throw BackendUnavailable("this build has no CUDA backend" + reason + consequence);
}

[[noreturn]] void RefuseRun() { Refuse("; use 'auto' or 'threads'"); }

[[noreturn]] void RefuseArrays() { Refuse(", so it can use no arrays in the memory of a GPU"); }
}

std::unique_ptr<LoadedMesh> LoadOnCuda(
  const TriangleMesh&, const FlipOptions&, const BuildProgress&)
{
  RefuseRun();
}

std::unique_ptr<LoadedMesh> LoadOnCuda(const DeviceMesh&, const FlipOptions&, const BuildProgress&)
{
  RefuseArrays();
}

std::unique_ptr<LoadedMesh> LoadOnCuda(const PointInput&, const FlipOptions&, const BuildProgress&)
{
  RefuseRun();
}

std::unique_ptr<LoadedSphere> LoadSphereOnCuda(const PointInput&, const FlipOptions&)
{
  RefuseRun();
}

std::unique_ptr<SphereDeviceAsker> LoadAskerOnCuda(
  const AskedSphere&, std::int64_t, const FlipOptions&)
{
  RefuseRun();
}

int FindDeviceOf(const void*) { RefuseArrays(); }

void CopyMemory(const void*, std::int64_t, void*, const DeviceStream&) { RefuseArrays(); }

bool HasCudaDevice() { return false; }

int CountCudaDevices() { return 0; }

void ReleaseCudaMemory() {}

std::size_t TakePeakCudaMemory() { return 0; }

}
