// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_CUDADEVICE_H
#define DELAUNAYFLIP_CUDADEVICE_H

#include "EngineExport.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

/// @file
/// Finds GPUs, and frees their memory. Every build has these functions. Without the CUDA backend
/// there is no GPU.
///
///     FlipOptions options;
///     if (CountCudaDevices() > 1)
///     {
///       options.Devices = ParseDevices("all"); // they share each mesh, and need NVLink
///     }
///     ReleaseCudaMemory(); // after a run, if another library needs the memory
///     HasCudaDevice() == (CountCudaDevices() > 0); // true

namespace delaunayflip
{

/// The number of triangles from which on BackendKind::Auto uses a GPU. After its first use, an H200
/// is faster than 16 threads of its host from 2,000 to 4,000 triangles on
/// (delaunay-flip-gpu-benchmark --sizes 1000,2000,10000 --cpu-sizes 1000,2000,10000: 0.7 and 0.7,
/// 0.8 and 1.4, 1.1 and 7.3 ms). Below 20,000 triangles it can save only milliseconds, less than
/// the first use of a GPU costs a process.
constexpr std::int64_t SmallestMeshForCuda = 20000;

/// Whether there is a GPU that this build can use. Never throws.
DELAUNAYFLIP_EXPORT bool HasCudaDevice();

/// How many GPUs there are that this build can use. Never throws.
DELAUNAYFLIP_EXPORT int CountCudaDevices();

/// GPUs for FlipOptions::Devices.
/// @param list CUDA's numbers, separated by commas, e.g. "0,1"; or "all", for every GPU. The result
/// is empty for an empty text, and for "all" without a GPU.
/// @throws InvalidOptions for anything else.
DELAUNAYFLIP_EXPORT std::vector<int> ParseDevices(const std::string& list);

/// Frees the memory, on the device and the host, that the CUDA backend keeps between runs. Sessions
/// that exist keep theirs.
DELAUNAYFLIP_EXPORT void ReleaseCudaMemory();

/// The most device memory, in bytes, that a single run has used, among all runs that have ended
/// since the last call. 0 without the backend.
DELAUNAYFLIP_EXPORT std::size_t TakePeakCudaMemory();

}

#endif
