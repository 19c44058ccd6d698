// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef LiveTexts_h
#define LiveTexts_h

#include "LiveState.h"

#include "vtkType.h"

#include <string>

namespace delaunayflip
{

/// What the keys of a live view do.
extern const char* const KeyHelp;

/// What a live view tells of its mesh.
struct LiveStatus
{
  vtkDelaunayFlip* Filter;
  LiveState State;
  bool IsRunning;
  int Frame;
  vtkIdType Triangles;
  double SmallestAngle; ///< Degrees; NaN where unknown.
};

/// In two or three lines; a failure takes as many as it needs.
std::string DescribeStatus(const LiveStatus& status);

}

#endif
