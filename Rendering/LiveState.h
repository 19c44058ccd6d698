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

/// An outcome of MakeStep().
struct LiveStep
{
  LiveState State;
  bool IsWithheld; ///< Whether the step did not put its mesh out.
};

/// Makes the filter do one step. On request it does not put the mesh out, if it can do without; an
/// update follows the last step, so that the output is then the final mesh.
LiveStep MakeStep(vtkDelaunayFlip* filter, bool withholdsMesh);

/// Whether a step with this outcome ends a run. An abort only pauses it.
bool IsEnd(LiveState state);

}

#endif
