// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef FlipRun_h
#define FlipRun_h

#include "EngineExport.h"
#include "PolyDataBridge.h"
#include "UpdateRun.h"

#include <memory>

namespace delaunayflip
{

/// What an update of a vtkDelaunayFlip asks for. The second input has the constraints.
struct DELAUNAYFLIP_EXPORT FlipRequest : UpdateRequest
{
  bool HasWork() const override;

  /// If only points have been moved since the last update, the new run is a warm start: it begins
  /// with the triangles of the last run and the edges that were fixed in it. Other new runs begin
  /// with the triangles of the input.
  bool ContinueOrStart(std::unique_ptr<UpdateRun>& run) const override;

  BridgeSettings Settings;
  FlipOptions Options;
  bool WantsFlipCounts = false; ///< The output gets a cell array of flip counts.
  bool WantsAngles = false; ///< The output gets cell arrays of smallest angles.
};

}

#endif
