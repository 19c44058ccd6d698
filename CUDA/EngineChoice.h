// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_ENGINECHOICE_H
#define DELAUNAYFLIP_ENGINECHOICE_H

#include "FlipEngine.h"
#include "FlipOptions.h"
#include "TriangleMesh.h"

#include <memory>
#include <string>

namespace delaunayflip
{

struct EngineChoice
{
  std::unique_ptr<FlipEngine> Engine;
  std::string Fallback; ///< Why the CPU stands in for a GPU that is there; else empty.
};

/// Prepares a mesh on the backend of the options. BackendKind::Auto takes the GPU where there is
/// one and the mesh is large enough for it, and the CPU where the GPU fails.
/// @throws BackendUnavailable for BackendKind::CUDA.
EngineChoice MakeEngine(const TriangleMesh& mesh, const FlipOptions& options);

}

#endif
