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
};

/// The statistics in two or three lines; a failure in as many as its reason needs.
std::string DescribeStatus(const LiveStatus& status);

}

#endif
