// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef ShownMesh_h
#define ShownMesh_h

#include "vtkSmartPointer.h"

class vtkAlgorithm;
class vtkDataObject;
class vtkPolyData;

namespace delaunayflip
{

/// What an algorithm gets at its first port, up to date; null where that is nothing.
vtkDataObject* UpdateInput(vtkAlgorithm* filter);

bool IsComposite(vtkDataObject* data);

/// The faces of a mesh, or of all blocks of a composite one, as triangles: a copy that shares what
/// it can, with the cell data of its cells.
vtkSmartPointer<vtkPolyData> MakeFaces(vtkDataObject* data);

}

#endif
