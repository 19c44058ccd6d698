// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef MalformedArrays_h
#define MalformedArrays_h

#include "FlipReport.h"
#include "Notes.h"

#include "vtkSmartPointer.h"

#include <string>
#include <vector>

class vtkCellData;
class vtkPointData;
class vtkPolyData;

namespace delaunayflip
{

/// The cell arrays of a mesh that have a tuple for every cell. If cells are split, others would be
/// read past their end.
vtkSmartPointer<vtkCellData> TakeWholeArrays(vtkPolyData* mesh);

/// The point arrays of a mesh that have a tuple for every point: those that stay if points are
/// added.
vtkSmartPointer<vtkPointData> TakeWholePointArrays(vtkPolyData* mesh);

/// Defects to warn of: point and cell arrays with too few tuples, and ghost arrays of a wrong type.
/// @param cellsStay whether all cells keep their positions, so that all cell arrays pass.
void AddMalformedArrays(vtkPolyData* mesh, bool cellsStay, std::vector<Defect>& defects);

/// Adds the warning of a partition, or of the piece of a rank, if it has point or cell arrays with
/// too few tuples, which are left out there.
/// @param where names the partition.
void AddShortArrays(vtkPolyData* mesh, const std::string& where, std::vector<Note>& notes);

}

#endif
