// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "BackendEngine.h"
#include "CudaBackend.cuh"
#include "CudaFlipLoop.cuh"
#include "FlipError.h"

namespace delaunayflip
{

std::unique_ptr<FlipEngine> MakeCudaEngine(
  const TriangleMesh& mesh, const FlipOptions& options, const BuildProgress& progress)
{
  try
  {
    CudaBackend backend(options.Device, options.NumberOfThreads);
    const std::unique_ptr<DeviceScope> current = backend.MakeCurrent();
    return std::unique_ptr<FlipEngine>(
      new BackendEngine<CudaBackend>(mesh, options, std::move(backend), progress));
  }
  catch (const BeyondDevice& error)
  {
    throw BackendUnavailable(error.what());
  }
}

}
