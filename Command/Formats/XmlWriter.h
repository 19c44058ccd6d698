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

/// Gives the writer a mesh that VTK can write and read back: ids of types that it crashes on become
/// ordinary arrays, and the ranges that it stores with arrays become finite.
void SetXmlInput(vtkXMLPolyDataWriter* writer, vtkPolyData* mesh);

}

#endif
