// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_CUDAERROR_H
#define DELAUNAYFLIP_CUDAERROR_H

#include <cuda_runtime_api.h>

#include <cstdint>

/// @file
/// Errors of the CUDA runtime as exceptions.

namespace delaunayflip
{

/// Throws a BackendUnavailable that says what was tried and why it failed. Clears the runtime's
/// last error, so that no other code sees it.
[[noreturn]] void ThrowCudaError(cudaError_t error, const char* action);

/// Whether a driver is installed, of any version. Never throws.
bool HasCudaDriver();

/// For tests: the `calls`-th call of CallCuda from now on (1: the next) is not made but fails with
/// `error`; 0 cancels this.
void InjectCudaError(std::int64_t calls, cudaError_t error);

/// Counts a call. @returns the error that it must fail with, or cudaSuccess.
cudaError_t BeginCudaCall();

/// Makes a call of the CUDA runtime: of one of its functions with arguments, or of a function that
/// launches a kernel and returns cudaGetLastError().
/// @param action what it does, for the message, e.g. "allocate memory".
/// @throws BackendUnavailable.
template <typename Call, typename... Arguments>
void CallCuda(const char* action, const Call& call, const Arguments&... arguments)
{
  const cudaError_t injected = BeginCudaCall();
  const cudaError_t error = injected == cudaSuccess ? call(arguments...) : injected;
  if (error != cudaSuccess)
  {
    ThrowCudaError(error, action);
  }
}

}

#endif
