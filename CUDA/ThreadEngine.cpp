// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "BackendEngine.h"
#include "ThreadBackend.h"
#include "ThreadFlipLoop.h"

namespace delaunayflip
{

std::unique_ptr<FlipEngine> MakeThreadEngine(const TriangleMesh& mesh, const FlipOptions& options)
{
  return std::unique_ptr<FlipEngine>(
    new BackendEngine<ThreadBackend>(mesh, options, ThreadBackend(options.NumberOfThreads)));
}

}
