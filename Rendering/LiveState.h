// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef LiveState_h
#define LiveState_h

class vtkDelaunayFlip;

namespace delaunayflip
{

/// The state of the mesh in a live view.
enum class LiveState
{
  NotStarted,
  UnderWay, ///< Another step may change it.
  Aborted, ///< The same, but the filter was asked to stop.
  Converged,
  Limited, ///< The iteration limit was reached.
  Failed, ///< The filter failed; the mesh is that of the step before.
  Unchanged, ///< The filter had nothing to do. Only returned by MakeStep().
};

/// Makes the filter do one step, and returns the outcome.
LiveState MakeStep(vtkDelaunayFlip* filter);

/// Whether a step with this outcome ends a run. An abort only pauses it.
bool IsEnd(LiveState state);

}

#endif
