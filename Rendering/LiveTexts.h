// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef LiveTexts_h
#define LiveTexts_h

#include "LiveState.h"

#include "vtkType.h"

#include <string>

namespace delaunayflip
{

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
