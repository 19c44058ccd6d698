// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_MERGEPOINTS_H
#define DELAUNAYFLIP_MERGEPOINTS_H

#include <vtkType.h>

class vtkPolyData;

namespace delaunayflip
{

/// Merges points with equal coordinates into the first of them, which keeps its point data. The
/// order of the points stays. So do the number and order of cells: a collapsed triangle stays a
/// cell.
/// @returns how many points were removed.
vtkIdType MergeCoincidentPoints(vtkPolyData* mesh);

}

#endif
