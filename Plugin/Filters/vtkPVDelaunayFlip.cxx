// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPVDelaunayFlip.h"

#include "DataArrays.h"
#include "FlipError.h"

#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkFieldData.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"
#include "vtkVersionMacros.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

using namespace delaunayflip;

namespace
{

/// The four cell arrays of a vtkPolyData, in the order of its cells.
enum Kind : unsigned char
{
  Verts,
  Lines,
  Polys,
  Strips,
  Blanked,
  NoSurface
};

Kind GetKind(int cellType)
{
  // Of VTK_EMPTY_CELL, vertices, lines, triangle, strip, polygon, pixel and quad: 0 to 9.
  constexpr Kind kinds[] = { Blanked, Verts, Verts, Lines, Lines, Polys, Strips, Polys, Polys,
    Polys };
  static_assert(
    VTK_QUAD + 1 == sizeof(kinds) / sizeof(kinds[0]), "the numbers of VTK's cell types");
  return cellType >= VTK_EMPTY_CELL && cellType <= VTK_QUAD ? kinds[cellType] : NoSurface;
}

vtkSmartPointer<vtkPoints> GetPoints(vtkDataSet* input)
{
  if (auto* pointSet = vtkPointSet::SafeDownCast(input))
  {
    return pointSet->GetPoints();
  }
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataTypeToDouble();
  for (vtkIdType i = 0; i < input->GetNumberOfPoints(); ++i)
  {
    points->InsertNextPoint(input->GetPoint(i));
  }
  return points;
}

/// Before any of the offsets is used.
void RequireValidCells(vtkUnstructuredGrid* grid)
{
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 6, 0)
  vtkDataArray* types = grid->GetCellTypes(); // which may be one constant
#else
  vtkDataArray* types = grid->GetCellTypesArray();
#endif
  vtkCellArray* cells = grid->GetCells();
  if (!cells->IsValid() || !types || types->GetNumberOfValues() < cells->GetNumberOfCells())
  {
    throw InvalidMesh(
      "The offsets, the connectivity and the types of the cells contradict each other.", -1, -1);
  }
}

/// The points of a cell, around it.
void ReadCell(vtkDataSet* input, vtkIdType cell, vtkIdList* ids)
{
  input->GetCellPoints(cell, ids);
  if (input->GetCellType(cell) != VTK_PIXEL)
  {
    return;
  }
  if (ids->GetNumberOfIds() != 4)
  {
    throw InvalidMesh("Cell " + std::to_string(cell) + " is a pixel, but has " +
        std::to_string(ids->GetNumberOfIds()) + " points, not 4.",
      cell, -1);
  }
  std::swap(*ids->GetPointer(2), *ids->GetPointer(3)); // which are row by row
}

/// Arrays that are too short to be copied become empty, so that the filter warns of them.
void CopyCellData(vtkDataSet* input, vtkIdList* sources, vtkCellData* output)
{
  vtkCellData* given = input->GetCellData();
  const auto whole = TakeWholeArrays(given, input->GetNumberOfCells());
  JoinTuples(whole, nullptr, sources, output);
  for (int i = given->GetNumberOfArrays() - 1; i >= 0; --i)
  {
    vtkAbstractArray* array = given->GetAbstractArray(i);
    if (array->GetNumberOfTuples() < input->GetNumberOfCells())
    {
      const auto empty = vtkSmartPointer<vtkAbstractArray>::Take(array->NewInstance());
      empty->SetName(array->GetName());
      output->AddArray(empty);
    }
  }
}

/// Converts a dataset. Points keep their ids and data. Cells keep their data, in the order
/// vertices, lines, polygons, strips. Blanked cells are left out.
/// @returns null if there is a cell that a vtkPolyData cannot hold.
/// @throws InvalidMesh.
vtkSmartPointer<vtkPolyData> ToPolyData(vtkDataSet* input)
{
  auto* grid = vtkUnstructuredGrid::SafeDownCast(input);
  const bool hasCells = grid && grid->GetCells();
  if (hasCells)
  {
    RequireValidCells(grid);
  }
  std::vector<Kind> kinds(input->GetNumberOfCells());
  std::array<vtkNew<vtkCellArray>, Blanked> cells;
  if (hasCells && !grid->GetCells()->IsStorage64Bit())
  {
    cells[Polys]->Use32BitStorage();
  }
  for (std::size_t i = 0; i < kinds.size(); ++i)
  {
    kinds[i] = GetKind(input->GetCellType(static_cast<vtkIdType>(i)));
  }
  if (std::find(kinds.begin(), kinds.end(), NoSurface) != kinds.end())
  {
    return nullptr;
  }
  vtkNew<vtkIdList> ids, sources;
  for (std::size_t kind = 0; kind < cells.size(); ++kind)
  {
    for (vtkIdType i = 0; i < input->GetNumberOfCells(); ++i)
    {
      if (kinds[i] == kind)
      {
        ReadCell(input, i, ids);
        cells[kind]->InsertNextCell(ids);
        sources->InsertNextId(i);
      }
    }
  }
  auto output = vtkSmartPointer<vtkPolyData>::New();
  output->SetPoints(GetPoints(input));
  output->GetPointData()->PassData(input->GetPointData());
  output->GetFieldData()->PassData(input->GetFieldData());
  output->SetVerts(cells[Verts]);
  output->SetLines(cells[Lines]);
  output->SetPolys(cells[Polys]);
  output->SetStrips(cells[Strips]);
  CopyCellData(input, sources, output->GetCellData());
  return output;
}

}

vtkStandardNewMacro(vtkPVDelaunayFlip);

vtkPVDelaunayFlip::vtkPVDelaunayFlip() { this->InputType = "vtkDataSet"; }

//------------------------------------------------------------------------------
/// The input as vtkPolyData; the same object as long as the input is unchanged.
vtkSmartPointer<vtkPolyData> vtkPVDelaunayFlip::GetMesh(vtkDataObject* input)
{
  if (auto* surface = vtkPolyData::SafeDownCast(input))
  {
    return surface;
  }
  auto* dataSet = vtkDataSet::SafeDownCast(input);
  if (dataSet && (dataSet != this->Source || input->GetMTime() != this->SourceTime))
  {
    this->Surface = ToPolyData(dataSet);
    this->Source = dataSet;
    this->SourceTime = input->GetMTime();
  }
  return dataSet ? this->Surface : nullptr;
}
