// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef SurfaceCells_h
#define SurfaceCells_h

#include "vtkSmartPointer.h"

class vtkDataSet;
class vtkPolyData;

namespace delaunayflip
{

/// Whether a vtkPolyData can hold all cells of a dataset: vertices, lines, triangles, quads,
/// pixels, polygons and strips. True for a dataset without cells.
/// @throws std::invalid_argument if the arrays of its cells contradict each other.
bool HasSurfaceCells(vtkDataSet* input);

/// Converts a dataset. Points keep their ids and data. Cells keep their data, in the order
/// vertices, lines, polygons, strips. Blanked cells are left out.
/// @param input a dataset for which HasSurfaceCells is true.
/// @throws std::invalid_argument if a pixel does not have four points.
vtkSmartPointer<vtkPolyData> ToPolyData(vtkDataSet* input);

}

#endif
