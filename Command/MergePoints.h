// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_MERGEPOINTS_H
#define DELAUNAYFLIP_MERGEPOINTS_H

#include <vtkType.h>

class vtkPolyData;

namespace delaunayflip
{

/// Joins points of equal coordinates, with the point data of the first of them, in the order of
/// first appearance. Cells keep their number and order: a triangle that collapses stays as one.
/// @returns how many points were left out.
vtkIdType MergeCoincidentPoints(vtkPolyData* mesh);

}

#endif
