// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_LIVEVIEWSUPPORT_H
#define DELAUNAYFLIP_LIVEVIEWSUPPORT_H

#include "vtkDelaunayFlipPoints.h"
#include "vtkPointSet.h"

#include <memory>

/// @file
/// What both parts of vtkDelaunayFlipLiveView need.

namespace delaunayflip
{

constexpr int FontSize = 14;

/// The points that a filter triangulates. Null if its input is a mesh.
inline vtkPointSet* FindPoints(vtkDelaunayFlipAlgorithm* filter)
{
  const bool makesTriangles = vtkDelaunayFlipPoints::SafeDownCast(filter) != nullptr;
  return makesTriangles ? vtkPointSet::SafeDownCast(filter->GetInputDataObject(0, 0)) : nullptr;
}

/// Sets a flag until the end of a scope, also if an observer ends it by an exception.
inline auto Raise(bool& flag)
{
  const auto lower = [](bool* raised) { *raised = false; };
  flag = true;
  return std::unique_ptr<bool, decltype(lower)>(&flag, lower);
}

}

#endif
