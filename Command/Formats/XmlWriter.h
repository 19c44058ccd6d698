// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_XMLWRITER_H
#define DELAUNAYFLIP_XMLWRITER_H

#include <vtkType.h>

class vtkAbstractArray;
class vtkPolyData;
class vtkXMLPolyDataWriter;

namespace delaunayflip
{

/// Whether VTK can write and read an array of this type as global or pedigree ids.
bool CanBeXmlIds(vtkAbstractArray* array);

/// Gives the writer the mesh, without what VTK crashes on or writes so that it cannot read it:
/// ids of other types become ordinary arrays, and ranges, which VTK stores with arrays, finite.
void SetXmlInput(vtkXMLPolyDataWriter* writer, vtkPolyData* mesh);

}

#endif
