// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_CUDADEVICE_H
#define DELAUNAYFLIP_CUDADEVICE_H

#include "EngineExport.h"

#include <cstddef>
#include <cstdint>

/// @file
/// Questions about the GPU, and its memory. Part of every build: without the CUDA backend there is
/// no GPU.

namespace delaunayflip
{

/// From this many triangles on BackendKind::Auto uses a GPU. Once in use, an H200 overtakes 16
/// threads of its host between 2,000 and 4,000 triangles (delaunay-flip-gpu-benchmark --sizes
/// 1000,2000,10000 --cpu-sizes 1000,2000,10000: 0.7 to 0.7, 0.8 to 1.4, 1.1 to 7.3 ms). Below
/// 20,000 triangles only milliseconds can be saved, and the first use of a GPU costs a process
/// more.
constexpr std::int64_t SmallestMeshForCuda = 20000;

/// Whether there is a GPU that this build can use. Never throws.
DELAUNAYFLIP_EXPORT bool HasCudaDevice();

/// Frees the memory that the CUDA backend keeps between runs, on the device and the host. Runs
/// under way keep theirs.
DELAUNAYFLIP_EXPORT void ReleaseCudaMemory();

/// The peak of device memory, in bytes, that any run has used since the last call, of the runs that
/// have ended. 0 without the backend, and where the device has no memory pools.
DELAUNAYFLIP_EXPORT std::size_t TakePeakCudaMemory();

}

#endif
