// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_XMLWRITER_H
#define DELAUNAYFLIP_XMLWRITER_H

#include <vtkSmartPointer.h>

class vtkAbstractArray;
class vtkPolyData;
class vtkXMLPolyDataWriter;

namespace delaunayflip
{

/// Whether VTK can write and read an array of this type as global or pedigree ids.
bool CanBeXmlIds(vtkAbstractArray* array);

/// A writer that VTK's own error handling does not crash: on a full disk it deletes arrays that it
/// has not made, through pointers that it has not set.
vtkSmartPointer<vtkXMLPolyDataWriter> MakeXmlWriter();

/// Gives the writer a mesh that VTK can write and read back: ids of types that it crashes on become
/// ordinary arrays, and the ranges that it stores with arrays become finite.
void SetXmlInput(vtkXMLPolyDataWriter* writer, vtkPolyData* mesh);

}

#endif
