// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPVDelaunayFlip.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"
#include "vtkVersionMacros.h"

#include <array>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

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

/// Cells of one kind, and the ids that they had in the input.
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

using CellsByKind = std::array<Cells, NumberOfKinds>;

void SortCells(vtkDataSet* input, CellsByKind& cells)
{
  auto* grid = vtkUnstructuredGrid::SafeDownCast(input);
  if (grid && grid->GetCells() && !grid->GetCells()->IsStorage64Bit())
  {
    cells[Polys].Array->Use32BitStorage();
  }
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
    if (type == VTK_PIXEL)
    {
      if (ids->GetNumberOfIds() != 4)
      {
        throw std::invalid_argument("Cell " + std::to_string(i) + " is a pixel, but has " +
          std::to_string(ids->GetNumberOfIds()) + " points, not 4.");
      }
      std::swap(*ids->GetPointer(2), *ids->GetPointer(3)); // from row by row to around the quad
    }
    cells[kind].Array->InsertNextCell(ids);
    cells[kind].Sources->InsertNextId(i);
  }
}

/// Arrays that are too short to be copied become empty, so that the filter warns of them.
void CopyCellData(vtkDataSet* input, const CellsByKind& cells, vtkCellData* output)
{
  vtkNew<vtkCellData> source;
  source->ShallowCopy(input->GetCellData());
  std::vector<vtkSmartPointer<vtkAbstractArray>> shortArrays;
  for (int i = source->GetNumberOfArrays() - 1; i >= 0; --i)
  {
    vtkAbstractArray* array = source->GetAbstractArray(i);
    if (array->GetNumberOfTuples() < input->GetNumberOfCells())
    {
      shortArrays.emplace_back(array);
      source->RemoveArray(i);
    }
  }
  output->CopyAllOn();
  output->CopyAllocate(source, input->GetNumberOfCells());
  vtkIdType next = 0;
  for (const Cells& some : cells)
  {
    for (vtkIdType i = 0; i < some.Sources->GetNumberOfIds(); ++i)
    {
      output->CopyData(source, some.Sources->GetId(i), next++);
    }
  }
  for (const auto& array : shortArrays)
  {
    const auto empty = vtkSmartPointer<vtkAbstractArray>::Take(array->NewInstance());
    empty->SetName(array->GetName());
    output->AddArray(empty);
  }
}

/// Whether a vtkPolyData can hold all cells of a dataset: vertices, lines, triangles, quads,
/// pixels, polygons and strips. True for a dataset without cells.
/// @throws std::invalid_argument if the arrays of its cells contradict each other.
bool HasSurfaceCells(vtkDataSet* input)
{
  auto* grid = vtkUnstructuredGrid::SafeDownCast(input);
  if (grid && grid->GetCells()) // whose arrays are checked before any of its offsets is used
  {
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 6, 0)
    vtkDataArray* types = grid->GetCellTypes(); // which may be one constant
#else
    vtkDataArray* types = grid->GetCellTypesArray();
#endif
    vtkCellArray* cells = grid->GetCells();
    if (!cells->IsValid() || !types || types->GetNumberOfValues() < cells->GetNumberOfCells())
    {
      throw std::invalid_argument(
        "The offsets, the connectivity and the types of the cells contradict each other.");
    }
  }
  for (vtkIdType i = 0; i < input->GetNumberOfCells(); ++i)
  {
    if (GetKind(input->GetCellType(i)) == NoSurface)
    {
      return false;
    }
  }
  return true;
}

/// Converts a dataset. Points keep their ids and data. Cells keep their data, in the order
/// vertices, lines, polygons, strips. Blanked cells are left out.
/// @param input a dataset for which HasSurfaceCells is true.
/// @throws std::invalid_argument if a pixel does not have four points.
vtkSmartPointer<vtkPolyData> ToPolyData(vtkDataSet* input)
{
  auto output = vtkSmartPointer<vtkPolyData>::New();
  output->SetPoints(GetPoints(input));
  output->GetPointData()->PassData(input->GetPointData());
  output->GetFieldData()->PassData(input->GetFieldData());
  CellsByKind cells;
  SortCells(input, cells);
  output->SetVerts(cells[Verts].Array);
  output->SetLines(cells[Lines].Array);
  output->SetPolys(cells[Polys].Array);
  output->SetStrips(cells[Strips].Array);
  CopyCellData(input, cells, output->GetCellData());
  return output;
}

}

vtkStandardNewMacro(vtkPVDelaunayFlip);

//------------------------------------------------------------------------------
int vtkPVDelaunayFlip::FillInputPortInformation(int port, vtkInformation* info)
{
  const int result = this->Superclass::FillInputPortInformation(port, info);
  if (port == 0)
  {
    info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataSet");
    info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  }
  return result;
}

//------------------------------------------------------------------------------
/// The input as vtkPolyData; the same object as long as the input is unchanged.
vtkSmartPointer<vtkPolyData> vtkPVDelaunayFlip::GetMesh(vtkDataObject* input)
{
  if (auto* surface = vtkPolyData::SafeDownCast(input))
  {
    return surface;
  }
  auto* dataSet = vtkDataSet::SafeDownCast(input);
  if (!dataSet || !HasSurfaceCells(dataSet))
  {
    return nullptr;
  }
  if (dataSet != this->Source || input->GetMTime() != this->SourceTime)
  {
    this->Surface = ToPolyData(dataSet);
    this->Source = dataSet;
    this->SourceTime = input->GetMTime();
  }
  return this->Surface;
}
