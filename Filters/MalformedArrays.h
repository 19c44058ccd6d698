// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef MalformedArrays_h
#define MalformedArrays_h

#include "FlipReport.h"
#include "Notes.h"

#include "vtkSmartPointer.h"

#include <string>
#include <vector>

class vtkAbstractArray;
class vtkCellData;
class vtkPointData;
class vtkPolyData;
class vtkUnsignedCharArray;

namespace delaunayflip
{

/// The cell arrays of a mesh that have a tuple for every cell. If cells are split, others would be
/// read past their end.
vtkSmartPointer<vtkCellData> TakeWholeArrays(vtkPolyData* mesh);

/// The point arrays of a mesh that have a tuple for every point: those that stay if points are
/// added.
vtkSmartPointer<vtkPointData> TakeWholePointArrays(vtkPolyData* mesh);

/// Whether an array is named as ghost types are, but has not one number of type unsigned char for
/// each tuple. Such an array is ignored.
bool IsWrongGhostArray(vtkAbstractArray* array);

/// The ghost types of the cells, of which there may be too few; null if there are none that are not
/// ignored.
vtkSmartPointer<vtkUnsignedCharArray> FindGhosts(vtkPolyData* mesh);

/// Defects to warn of: point and cell arrays with too few tuples, and ghost arrays that are
/// ignored.
/// @param cellsStay whether all cells keep their positions, so that all cell arrays pass.
void AddMalformedArrays(vtkPolyData* mesh, bool cellsStay, std::vector<Defect>& defects);

/// Adds the warning of a partition, or of the piece of a rank. Arrays with too few tuples are left
/// out there.
/// @param where names the partition.
void AddMalformedArrays(vtkPolyData* mesh, const std::string& where, std::vector<Note>& notes);

}

#endif
