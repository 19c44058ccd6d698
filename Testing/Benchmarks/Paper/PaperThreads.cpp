// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FlipError.h"
#include "PaperMethod.h"
#include "ThreadBackend.h"

namespace delaunayflip
{

// Not in an unnamed namespace, because the loop's template would not find it there.
template <typename Step>
void RunPhase(const ThreadBackend& backend, std::int64_t size, const Step& step)
{
  backend.ForEach(size, step);
}

PaperLoop MakePaperLoop(const TriangleMesh& mesh, const PaperOptions& options)
{
  if (options.OnGpu)
  {
#if defined(DELAUNAYFLIP_HAS_CUDA)
    return MakePaperLoopOnGpu(mesh, options);
#else
    throw BackendUnavailable("built without the CUDA backend");
#endif
  }
  const auto runOn = [backend = std::make_shared<const ThreadBackend>(options.NumberOfThreads)](
                       const auto& loop) { return loop(*backend); };
  return options.InDouble ? ChooseLoop<double>(mesh, options, runOn)
                          : ChooseLoop<float>(mesh, options, runOn);
}

}
