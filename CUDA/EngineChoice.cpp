// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "EngineChoice.h"

#include "CudaDevice.h"
#include "FlipError.h"

namespace delaunayflip
{

EngineChoice MakeEngine(const TriangleMesh& mesh, const FlipOptions& options)
{
  EngineChoice choice;
  if (options.Backend == BackendKind::CUDA)
  {
    choice.Engine = MakeCudaEngine(mesh, options);
    return choice;
  }
  if (options.Backend == BackendKind::Auto && mesh.Triangles.Count >= SmallestMeshForCuda &&
    HasCudaDevice())
  {
    try
    {
      choice.Engine = MakeCudaEngine(mesh, options);
      return choice;
    }
    catch (const BackendUnavailable& error)
    {
      choice.Fallback = error.what();
    }
  }
  choice.Engine = MakeThreadEngine(mesh, options);
  return choice;
}

}
