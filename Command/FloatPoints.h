// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_FLOATPOINTS_H
#define DELAUNAYFLIP_FLOATPOINTS_H

#include <vtkType.h>

#include <string>

class vtkPolyData;

namespace delaunayflip
{

/// Counts the points that no polygon or strip has.
vtkIdType CountUnusedPoints(vtkPolyData* mesh);

/// Says in words what the points of polygons and strips lose as float: how far they move, and how
/// many fall on others. Empty if they lose nothing.
std::string DescribeRoundingToFloat(vtkPolyData* mesh);

/// @throws CommandError if a finite coordinate of such a point would become infinite as float.
void RequireFloatRange(vtkPolyData* mesh);

}

#endif
