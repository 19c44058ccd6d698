// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef ShownMesh_h
#define ShownMesh_h

#include "vtkSmartPointer.h"

class vtkAlgorithm;
class vtkDataObject;
class vtkDelaunayFlip;
class vtkPolyData;

namespace delaunayflip
{

/// Updates the first input of an algorithm and returns it; null if there is none.
vtkDataObject* UpdateInput(vtkAlgorithm* filter);

bool IsComposite(vtkDataObject* data);

/// The faces of a mesh, or of all blocks of a composite one, as triangles with their cell data: a
/// copy that shares arrays where it can.
vtkSmartPointer<vtkPolyData> MakeFaces(vtkDataObject* data);

/// The same of the mesh of a filter's live run as it is now, without an update; null if there is no
/// run.
vtkSmartPointer<vtkPolyData> CopyRun(vtkDelaunayFlip* filter);

}

#endif
