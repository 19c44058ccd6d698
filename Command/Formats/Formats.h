// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_FORMATS_H
#define DELAUNAYFLIP_FORMATS_H

#include "CommandError.h"
#include "InputFile.h"
#include "MeshFiles.h"

#include <vtkCellArray.h>
#include <vtkCellArrayIterator.h>

class vtkAbstractArray;

/// @file
/// The reader and the writer of each format. They throw CommandError (BadFile); readers name the
/// file, writers do not. The readers and writers of VtkFiles.cpp are VTK's, with checks. This
/// header has what all of them need.

namespace delaunayflip
{

FileMesh ReadLegacy(const InputFile& file);
FileMesh ReadXml(const InputFile& file);
FileMesh ReadPly(const InputFile& file);
FileMesh ReadObj(const InputFile& file);
FileMesh ReadPoints(const InputFile& file);

/// Points in the same place become one, because a .stl repeats them for every triangle. A triangle
/// that collapses stays a triangle.
FileMesh ReadStl(const InputFile& file);

void WriteLegacy(vtkPolyData* mesh, const std::string& path);
void WriteXml(vtkPolyData* mesh, const std::string& path);
void WriteStl(vtkPolyData* mesh, const std::string& path);
void WritePly(vtkPolyData* mesh, const std::string& path);
void WriteObj(vtkPolyData* mesh, const std::string& path);

/// The arrays of the points that a .ply and an .obj hold.
std::vector<vtkAbstractArray*> ArraysOfPly(vtkPolyData* mesh);
std::vector<vtkAbstractArray*> ArraysOfObj(vtkPolyData* mesh);

/// Calls `visit(size, points)` for every cell.
template <typename Function>
void ForEachCell(vtkCellArray* cells, const Function& visit)
{
  const auto cell = vtk::TakeSmartPointer(cells->NewIterator());
  for (cell->GoToFirstCell(); !cell->IsDoneWithTraversal(); cell->GoToNextCell())
  {
    vtkIdType size = 0;
    const vtkIdType* points = nullptr;
    cell->GetCurrentCell(size, points);
    visit(size, points);
  }
}

}

#endif
