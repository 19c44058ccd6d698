// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CudaError.h"

#include "FlipError.h"

#include <atomic>
#include <string>

namespace delaunayflip
{

namespace
{
std::atomic<std::int64_t> NumberOfCalls{ 0 };
std::atomic<std::int64_t> FailingCall{ -1 };
std::atomic<cudaError_t> InjectedError{ cudaSuccess };

/// Advice about errors that users may encounter.
std::string Advise(cudaError_t error)
{
  switch (error)
  {
    case cudaErrorMemoryAllocation:
      return "; the mesh is too large for the free memory of the GPU, unless it is flipped in "
             "pieces";
    case cudaErrorNoDevice:
      return "; does this machine have an NVIDIA GPU?";
    case cudaErrorInvalidDevice:
      return "; CUDA numbers the GPUs of a machine from 0";
    case cudaErrorInsufficientDriver:
      return HasCudaDriver() ? "; update NVIDIA's driver" : "; no NVIDIA driver is installed";
    case cudaErrorNoKernelImageForDevice:
      return "; this build has no code for this GPU, set CMAKE_CUDA_ARCHITECTURES";
    default:
      return "";
  }
}
}

bool HasCudaDriver()
{
  int version = 0;
  return cudaDriverGetVersion(&version) == cudaSuccess && version > 0;
}

void ThrowCudaError(cudaError_t error, const char* action)
{
  cudaGetLastError();
  throw BackendUnavailable(
    std::string("CUDA could not ") + action + ": " + cudaGetErrorString(error) + Advise(error));
}

void InjectCudaError(std::int64_t calls, cudaError_t error)
{
  InjectedError = error;
  FailingCall = calls > 0 ? NumberOfCalls + calls : -1;
}

cudaError_t BeginCudaCall()
{
  return ++NumberOfCalls == FailingCall ? InjectedError.load() : cudaSuccess;
}

}
