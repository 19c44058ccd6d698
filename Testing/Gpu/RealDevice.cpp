// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CudaContext.h"
#include "CudaDevice.h"
#include "TestDevice.h"

#include <cuda_runtime_api.h>

/// @file
/// The GPU's memory for the tests of TestDevice.h.

namespace delaunayflip
{

bool HasTestDevice() { return HasCudaDevice(); }

void* AllocateOnTestDevice(std::size_t bytes)
{
  void* memory = nullptr;
  CallCuda("allocate memory of a test", [&] { return cudaMalloc(&memory, bytes); });
  return memory;
}

void FreeOnTestDevice(void* memory) { cudaFree(memory); }

}
