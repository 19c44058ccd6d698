// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PieceFlip.h"
#include "PreparedPieces.h"

namespace delaunayflip
{

PiecesReport FlipInPieces(const TriangleMesh& mesh, const FlipOptions& options,
  const MutableTriangleArray& triangles, const ProgressObserver& progress)
{
  try
  {
    return PreparedPieces(mesh, options, triangles, progress).Run(progress, nullptr);
  }
  catch (const RunAborted&) // before the first flip
  {
    return PreparedPieces::Abort(mesh, triangles, options.NumberOfThreads);
  }
}

}
