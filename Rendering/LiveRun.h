// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef LiveRun_h
#define LiveRun_h

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <string>
#include <utility>

class vtkDataObject;
class vtkDelaunayFlip;
class vtkPolyData;

/// @file
/// The run that a live view shows: its steps, its mesh, and its state in words.

namespace delaunayflip
{

/// Gives a variable another value for as long as it lives.
template <typename T>
class ScopedValue
{
public:
  ScopedValue(T& variable, T value)
    : Variable(variable),
      Before(std::exchange(variable, value))
  {
  }
  ~ScopedValue() { this->Variable = this->Before; }
  ScopedValue(const ScopedValue&) = delete;
  ScopedValue& operator=(const ScopedValue&) = delete;

private:
  T& Variable;
  T Before;
};

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

bool IsComposite(vtkDataObject* data);

/// A mesh, or all blocks of a composite one as one mesh.
vtkSmartPointer<vtkPolyData> JoinBlocks(vtkDataObject* data);

/// The line that explains the keys of a live view.
extern const char* const KeyHelp;

/// What the statistics of a live view are about.
struct LiveStatus
{
  vtkDelaunayFlip* Filter;
  LiveState State;
  bool IsRunning;
  int Frame;
  vtkIdType Triangles;
  double SmallestAngle; ///< In degrees; NaN if unknown.
  std::string Drawing; ///< How it is drawn; may be empty.
};

/// The statistics in two or three lines; a failure, and how the mesh is drawn, in as many as their
/// reasons need.
std::string DescribeStatus(const LiveStatus& status);

}

#endif
