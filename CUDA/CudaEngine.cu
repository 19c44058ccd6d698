// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "BackendEngine.h"
#include "CudaBackend.cuh"
#include "CudaFlipLoop.cuh"
#include "FlipError.h"

namespace delaunayflip
{

namespace
{
/// The loop makes its device current itself; this does so for the rest.
class CudaEngine : public BackendEngine<CudaBackend>
{
public:
  CudaEngine(const TriangleMesh& mesh, const FlipOptions& options, CudaBackend backend, int device)
    : BackendEngine(mesh, options, std::move(backend)),
      Device(device)
  {
  }

  void StoreTriangles(const MutableTriangleArray& triangles) const override
  {
    const CurrentDevice device(this->Device);
    BackendEngine::StoreTriangles(triangles);
  }

  void StoreFlipCounts(std::int32_t* counts) const override
  {
    const CurrentDevice device(this->Device);
    BackendEngine::StoreFlipCounts(counts);
  }

  void Audit() const override
  {
    const CurrentDevice device(this->Device);
    BackendEngine::Audit();
  }

private:
  int Device;
};
}

std::unique_ptr<FlipEngine> MakeCudaEngine(const TriangleMesh& mesh, const FlipOptions& options)
{
  try
  {
    CudaBackend backend(options.Device, options.NumberOfThreads);
    const int number = backend.GetContext().Device;
    const CurrentDevice device(number);
    return std::unique_ptr<FlipEngine>(new CudaEngine(mesh, options, std::move(backend), number));
  }
  catch (const BeyondDevice& error)
  {
    throw BackendUnavailable(error.what());
  }
}

}
