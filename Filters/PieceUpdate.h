// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef PieceUpdate_h
#define PieceUpdate_h

#include "FlipRun.h"
#include "PieceGroup.h"
#include "UpdateReport.h"

#include "vtkSmartPointer.h"

#include <functional>

class vtkPolyData;

namespace delaunayflip
{

/// What an update of one rank asks for.
struct PieceRequest
{
  std::function<vtkSmartPointer<vtkPolyData>()> GetInput; ///< May throw; never returns null.
  vtkPolyData* Constraints; ///< Or null.
  PolyDataBridge::Settings Settings;
  FlipOptions Options;
  FlipRun::Extras Wanted;
  ProgressObserver Progress;
};

/// The report of the whole mesh, and what to warn of besides its defects.
struct PieceUpdate
{
  UpdateReport Report;
  std::int64_t AmbiguousPoints = 0;
};

/// Flips a mesh of which every rank of the group has a piece, and writes this rank's piece. All
/// ranks must call this together.
/// @throws on every rank if one fails: InvalidMesh, InvalidOptions, RunAborted and so on.
PieceUpdate FlipPieces(const PieceRequest& request, PieceGroup& group, vtkPolyData* output);

}

#endif
