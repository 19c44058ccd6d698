// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CudaBackend.cuh"
#include "PaperLoop.h"

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

// Not in the unnamed namespace, because the loop's template would not find them there.
template <typename Step>
void RunPhase(const CudaBackend& backend, std::int64_t size, const Step& step)
{
  const auto blocks = static_cast<unsigned>((size + ThreadsOfBlock - 1) / ThreadsOfBlock);
  if (blocks > 0)
  {
    backend.Launch(
      [&](cudaStream_t stream) { PhaseKernel<<<blocks, ThreadsOfBlock, 0, stream>>>(size, step); });
  }
}

static void WaitFor(const CudaBackend& backend) { backend.Synchronize(); }

template <typename Point, typename Test>
PaperResult RunPaperLoopOnGpu(const PaperMesh<Point>& mesh, const PaperPlan<Test>& plan)
{
  const CudaBackend backend({ -1 }, static_cast<int>(std::thread::hardware_concurrency()));
  const auto scope = backend.MakeCurrent();
  return RunPaperLoop(mesh, plan, backend);
}

template PaperResult RunPaperLoopOnGpu(
  const PaperMesh<PaperPoint2<float>>&, const PaperPlan<OppositeAngleTest<float>>&);
template PaperResult RunPaperLoopOnGpu(
  const PaperMesh<PaperPoint2<double>>&, const PaperPlan<OppositeAngleTest<double>>&);
template PaperResult RunPaperLoopOnGpu(
  const PaperMesh<PaperPoint2<float>>&, const PaperPlan<InCircleTest<float>>&);
template PaperResult RunPaperLoopOnGpu(
  const PaperMesh<PaperPoint2<double>>&, const PaperPlan<InCircleTest<double>>&);
template PaperResult RunPaperLoopOnGpu(
  const PaperMesh<PaperPoint3<float>>&, const PaperPlan<OppositeAngleTest<float>>&);
template PaperResult RunPaperLoopOnGpu(
  const PaperMesh<PaperPoint3<double>>&, const PaperPlan<OppositeAngleTest<double>>&);
}
