// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CallerMesh.h"
#include "ConstraintInsertion.h"
#include "DividedRun.h"
#include "FlipError.h"
#include "InputChecks.h"
#include "MeshInPieces.h"
#include "PieceFlip.h"
#include "ThreadBackend.h"

#include <cstdint>
#include <string>

namespace delaunayflip
{

namespace
{
constexpr int MostPieces = 255;

void CheckPieces(int pieces)
{
  if (pieces < 1 || pieces > MostPieces)
  {
    throw InvalidOptions("a mesh cannot be divided into " + std::to_string(pieces) +
      " pieces, only into 1 to " + std::to_string(MostPieces));
  }
}

/// @returns whether there was time for it.
bool InsertConstraints(const TriangleMesh& mesh, const FlipOptions& options,
  const ProgressObserver& progress, ConstraintInsertion& insertion)
{
  try
  {
    if (CallerMesh(mesh).HasConstraintsToInsert())
    {
      CheckMeshSize(mesh.Triangles.Count, mesh.Points.Count);
      insertion = ConstraintInsertion(mesh, options,
        [&](double share)
        { return !progress || progress(ConstraintInsertion::ShareOfRun * share); });
    }
    return true;
  }
  catch (const RunAborted&)
  {
    return false;
  }
}

PiecesReport MakeAbortedReport(const TriangleMesh& mesh)
{
  PiecesReport report;
  report.Points = mesh.Points.Count;
  report.Triangles = mesh.Triangles.Count;
  report.StopReason = StopReasonKind::Aborted;
  return report;
}
}

PiecesReport FlipInPieces(const TriangleMesh& mesh, const FlipOptions& options,
  const PieceDivision& division, const MutableTriangleArray& triangles,
  const ProgressObserver& progress)
{
  CheckPieces(division.Pieces);
  CheckOptions(options);
  ConstraintInsertion insertion;
  if (!InsertConstraints(mesh, options, progress, insertion))
  {
    CopyTriangles(mesh.Triangles, triangles, ThreadBackend(options.NumberOfThreads));
    return MakeAbortedReport(mesh);
  }
  const double begin = insertion.GetShare();
  const ProgressObserver observer = [&](double share)
  { return !progress || progress(begin + (1.0 - begin) * share); };
  const FlipOptions firstOptions = insertion.GetOptions(options);
  MeshInPieces divided(insertion.GetMesh(mesh), triangles, firstOptions, division.Pieces);
  PiecesReport report = DividedRun(divided, firstOptions, division, observer).Run();
  insertion.AddTo(report);
  return report;
}

}
