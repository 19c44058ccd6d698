// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_SEGMENTLINES_H
#define DELAUNAYFLIP_SEGMENTLINES_H

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <string>

namespace delaunayflip
{

/// The lines and polygons of a mesh, with all its points, as vtkDelaunayFlipPoints takes them:
/// breaklines as lines, and rings as polygons. Lines that end at the same places, two each, are
/// joined to rings.
/// @throws CommandError (BadFile) with `path` where there are none, or one is no ring.
vtkSmartPointer<vtkPolyData> MakeSegments(
  vtkPolyData* mesh, const std::string& path, bool areBreaklines);

/// Makes floats doubles, as they become where another file has doubles. Those at a point of the
/// input, rounded, become that point.
void TakeExactPlaces(vtkPolyData* mesh, vtkPolyData* input);

/// Puts coordinates in the place of numbers of points in a message of vtkDelaunayFlipPoints, which
/// count the points of the input first, then those of segments that are at none of their places.
/// @param areAngles whether x and y are longitudes and latitudes.
std::string NamePlaces(
  const std::string& message, vtkPolyData* input, vtkPolyData* segments, bool areAngles);

}

#endif
