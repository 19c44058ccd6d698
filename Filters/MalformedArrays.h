// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef MalformedArrays_h
#define MalformedArrays_h

#include "FlipReport.h"

#include "vtkSmartPointer.h"

#include <vector>

class vtkCellData;
class vtkPolyData;

namespace delaunayflip
{

/// The cell arrays of a mesh that have a tuple for every cell. The others would be read past their
/// end where cells are split.
vtkSmartPointer<vtkCellData> TakeWholeArrays(vtkPolyData* mesh);

/// What to warn of: arrays of points and cells with too few tuples, and ghosts of a wrong type.
/// @param cellsStay whether no cell changes its place, so that all cell arrays pass.
void AddMalformedArrays(vtkPolyData* mesh, bool cellsStay, std::vector<Defect>& defects);

}

#endif
