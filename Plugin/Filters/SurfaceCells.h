// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef SurfaceCells_h
#define SurfaceCells_h

#include "vtkSmartPointer.h"

class vtkDataSet;
class vtkPolyData;

namespace delaunayflip
{

/// Whether all cells of a dataset are those of a vtkPolyData: vertices, lines, triangles, quads,
/// pixels, polygons and strips. Also for one without cells.
/// @throws std::invalid_argument when the arrays of its cells contradict each other.
bool HasSurfaceCells(vtkDataSet* input);

/// The same points under the same ids, with the same data, and the same cells: vertices, lines,
/// polygons and strips, in this order, each with its data. Blanked cells are left out.
/// @param input A dataset that HasSurfaceCells.
/// @throws std::invalid_argument when a pixel has not four points.
vtkSmartPointer<vtkPolyData> ToPolyData(vtkDataSet* input);

}

#endif
