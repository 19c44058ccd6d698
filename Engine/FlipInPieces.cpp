// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PieceFlip.h"
#include "PreparedPieces.h"
#include "ThreadBackend.h"

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
    CopyTriangles(mesh.Triangles, triangles, ThreadBackend(options.NumberOfThreads));
    PiecesReport report;
    report.Points = mesh.Points.Count;
    report.Triangles = mesh.Triangles.Count;
    report.StopReason = StopReasonKind::Aborted;
    return report;
  }
}

}
