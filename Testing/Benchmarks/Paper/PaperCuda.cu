// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CudaBackend.cuh"
#include "PaperMethod.h"

#include <thread>

namespace delaunayflip
{

namespace
{

constexpr int ThreadsOfBlock = 256;

/// One thread per edge, as in the paper.
template <typename Step>
__global__ void PhaseKernel(std::int64_t size, Step step)
{
  const std::int64_t i = std::int64_t(blockIdx.x) * ThreadsOfBlock + threadIdx.x;
  if (i < size)
  {
    step(i);
  }
}

}

// Not in the unnamed namespace, because the loop's template would not find it there.
template <typename Step>
void RunPhase(const CudaBackend& backend, std::int64_t size, const Step& step)
{
  const auto blocks = static_cast<unsigned>((size + ThreadsOfBlock - 1) / ThreadsOfBlock);
  if (blocks > 0)
  {
    CudaBackend::Launch(backend.GetStream(),
      [&](cudaStream_t stream) { PhaseKernel<<<blocks, ThreadsOfBlock, 0, stream>>>(size, step); });
  }
}

PaperLoop MakePaperLoopOnGpu(const TriangleMesh& mesh, const PaperOptions& options)
{
  const auto runOn = [](const auto& loop)
  {
    const CudaBackend backend({ -1 }, static_cast<int>(std::thread::hardware_concurrency()));
    const auto scope = backend.MakeCurrent();
    return loop(backend);
  };
  return options.InDouble ? ChooseLoop<double>(mesh, options, runOn)
                          : ChooseLoop<float>(mesh, options, runOn);
}

}
