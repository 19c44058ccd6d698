// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_MERGEPOINTS_H
#define DELAUNAYFLIP_MERGEPOINTS_H

#include <vtkType.h>

class vtkPolyData;

namespace delaunayflip
{

/// Merges points with equal coordinates. The first of them stays, with its point data; the order of
/// the points stays too. Cells keep their number and order; a triangle that collapses stays a cell.
/// @returns how many points were removed.
vtkIdType MergeCoincidentPoints(vtkPolyData* mesh);

}

#endif
