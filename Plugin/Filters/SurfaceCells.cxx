// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SurfaceCells.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDataSet.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkUnstructuredGrid.h"

#include <array>
#include <cstddef>
#include <utility>

namespace delaunayflip
{
namespace
{

/// The four cell arrays of a vtkPolyData, in the order of its cells.
enum Kind : std::size_t
{
  Verts,
  Lines,
  Polys,
  Strips,
  NumberOfKinds,
  Blanked,
  NoSurface
};

Kind GetKind(int cellType)
{
  switch (cellType)
  {
    case VTK_EMPTY_CELL:
      return Blanked;
    case VTK_VERTEX:
    case VTK_POLY_VERTEX:
      return Verts;
    case VTK_LINE:
    case VTK_POLY_LINE:
      return Lines;
    case VTK_TRIANGLE:
    case VTK_QUAD:
    case VTK_PIXEL:
    case VTK_POLYGON:
      return Polys;
    case VTK_TRIANGLE_STRIP:
      return Strips;
    default:
      return NoSurface;
  }
}

/// Cells of one kind, and where they come from.
struct Cells
{
  vtkNew<vtkCellArray> Array;
  vtkNew<vtkIdList> Sources;
};

vtkSmartPointer<vtkPoints> GetPoints(vtkDataSet* input)
{
  if (auto* pointSet = vtkPointSet::SafeDownCast(input))
  {
    return pointSet->GetPoints();
  }
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(input->GetNumberOfPoints());
  for (vtkIdType i = 0; i < input->GetNumberOfPoints(); ++i)
  {
    double point[3];
    input->GetPoint(i, point);
    points->SetPoint(i, point);
  }
  return points;
}

/// The cells of an unstructured grid of polygons alone are those of the result, as they are.
bool ShareCells(vtkDataSet* input, vtkPolyData* output)
{
  auto* grid = vtkUnstructuredGrid::SafeDownCast(input);
  for (vtkIdType i = 0; grid && i < grid->GetNumberOfCells(); ++i)
  {
    const int type = grid->GetCellType(i);
    if (GetKind(type) != Polys || type == VTK_PIXEL)
    {
      return false;
    }
  }
  if (grid)
  {
    output->SetPolys(grid->GetCells());
    output->GetCellData()->PassData(grid->GetCellData());
  }
  return grid != nullptr;
}

using CellsByKind = std::array<Cells, NumberOfKinds>;

void SortCells(vtkDataSet* input, CellsByKind& cells)
{
  vtkNew<vtkIdList> ids;
  for (vtkIdType i = 0; i < input->GetNumberOfCells(); ++i)
  {
    const int type = input->GetCellType(i);
    const Kind kind = GetKind(type);
    if (kind == Blanked)
    {
      continue;
    }
    input->GetCellPoints(i, ids);
    if (type == VTK_PIXEL) // not around the quad, as all others, but row by row
    {
      std::swap(*ids->GetPointer(2), *ids->GetPointer(3));
    }
    cells[kind].Array->InsertNextCell(ids);
    cells[kind].Sources->InsertNextId(i);
  }
}

void CopyCells(vtkDataSet* input, vtkPolyData* output)
{
  CellsByKind cells;
  SortCells(input, cells);
  output->SetVerts(cells[Verts].Array);
  output->SetLines(cells[Lines].Array);
  output->SetPolys(cells[Polys].Array);
  output->SetStrips(cells[Strips].Array);
  vtkCellData* data = output->GetCellData();
  data->CopyAllOn();
  data->CopyAllocate(input->GetCellData(), input->GetNumberOfCells());
  vtkIdType next = 0;
  for (const Cells& some : cells)
  {
    for (vtkIdType i = 0; i < some.Sources->GetNumberOfIds(); ++i)
    {
      data->CopyData(input->GetCellData(), some.Sources->GetId(i), next++);
    }
  }
}

}

bool HasSurfaceCells(vtkDataSet* input)
{
  for (vtkIdType i = 0; i < input->GetNumberOfCells(); ++i)
  {
    if (GetKind(input->GetCellType(i)) == NoSurface)
    {
      return false;
    }
  }
  return true;
}

vtkSmartPointer<vtkPolyData> ToPolyData(vtkDataSet* input)
{
  auto output = vtkSmartPointer<vtkPolyData>::New();
  output->SetPoints(GetPoints(input));
  output->GetPointData()->PassData(input->GetPointData());
  output->GetFieldData()->PassData(input->GetFieldData());
  if (!ShareCells(input, output))
  {
    CopyCells(input, output);
  }
  return output;
}

}
