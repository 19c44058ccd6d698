// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef LiveState_h
#define LiveState_h

class vtkDelaunayFlip;

namespace delaunayflip
{

/// Of the mesh in a live view.
enum class LiveState
{
  NotStarted,
  UnderWay, ///< Another step may change it.
  Aborted, ///< The same, but the filter was told to stop.
  Converged,
  Limited, ///< By the iteration limit.
  Failed, ///< It is that of the step before.
  Unchanged, ///< The filter had nothing to do; only what MakeStep() returns.
};

/// Lets a filter make a step, and tells what came out.
LiveState MakeStep(vtkDelaunayFlip* filter);

/// Whether a step that came out like this ends a run; an abort only pauses it.
bool IsEnd(LiveState state);

}

#endif
