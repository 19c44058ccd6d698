// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ShownMesh.h"

#include "vtkAlgorithm.h"
#include "vtkAlgorithmOutput.h"
#include "vtkAppendPolyData.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkDelaunayFlip.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkTriangleFilter.h"

#include <exception>

namespace delaunayflip
{

namespace
{

/// Whether every cell is a triangle, as in outputs of the filter without lines or verts.
bool HasOnlyTriangles(vtkPolyData* mesh)
{
  const vtkIdType triangles = mesh->GetNumberOfPolys();
  return mesh->GetNumberOfCells() == triangles &&
    mesh->GetPolys()->IsHomogeneous() == (triangles > 0 ? 3 : 0);
}

/// A mesh without its verts and lines. That vtkTriangleFilter leaves them out cannot be relied on:
/// with VTK 9.6 a line stays.
vtkSmartPointer<vtkPolyData> TakeSurface(vtkPolyData* mesh)
{
  const vtkIdType before = mesh->GetNumberOfVerts() + mesh->GetNumberOfLines();
  const vtkIdType count = mesh->GetNumberOfPolys() + mesh->GetNumberOfStrips();
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  surface->SetPoints(mesh->GetPoints());
  surface->GetPointData()->ShallowCopy(mesh->GetPointData());
  surface->SetPolys(mesh->GetPolys());
  surface->SetStrips(mesh->GetStrips());
  surface->GetCellData()->CopyAllOn();
  surface->GetCellData()->CopyAllocate(mesh->GetCellData(), count);
  surface->GetCellData()->CopyData(mesh->GetCellData(), 0, count, before);
  return surface;
}

vtkSmartPointer<vtkPolyData> AppendBlocks(vtkCompositeDataSet* blocks)
{
  vtkNew<vtkAppendPolyData> append;
  vtkSmartPointer<vtkCompositeDataIterator> block;
  block.TakeReference(blocks->NewIterator());
  for (block->InitTraversal(); !block->IsDoneWithTraversal(); block->GoToNextItem())
  {
    if (auto* mesh = vtkPolyData::SafeDownCast(block->GetCurrentDataObject()))
    {
      append->AddInputData(mesh);
    }
  }
  if (append->GetNumberOfInputConnections(0) > 0)
  {
    append->Update();
  }
  return append->GetOutput();
}

}

vtkDataObject* UpdateInput(vtkAlgorithm* filter)
{
  if (filter->GetNumberOfInputConnections(0) == 0)
  {
    return nullptr;
  }
  vtkAlgorithmOutput* connection = filter->GetInputConnection(0, 0);
  connection->GetProducer()->Update(connection->GetIndex());
  return filter->GetInputDataObject(0, 0);
}

bool IsComposite(vtkDataObject* data) { return vtkCompositeDataSet::SafeDownCast(data) != nullptr; }

vtkSmartPointer<vtkPolyData> MakeFaces(vtkDataObject* data)
{
  vtkSmartPointer<vtkPolyData> mesh = vtkPolyData::SafeDownCast(data);
  if (auto* blocks = vtkCompositeDataSet::SafeDownCast(data))
  {
    mesh = AppendBlocks(blocks);
  }
  auto faces = vtkSmartPointer<vtkPolyData>::New();
  if (mesh && HasOnlyTriangles(mesh))
  {
    faces->ShallowCopy(mesh);
  }
  else if (mesh)
  {
    vtkNew<vtkTriangleFilter> split;
    split->SetInputData(TakeSurface(mesh));
    split->Update();
    faces->ShallowCopy(split->GetOutput());
  }
  // Else VTK would shade by them, and those of flipped triangles would be of other triangles.
  faces->GetCellData()->SetActiveAttribute(-1, vtkDataSetAttributes::NORMALS);
  return faces;
}

/// An exception leaves no mesh; the filter's next update meets the same problem and reports it.
vtkSmartPointer<vtkPolyData> CopyRun(vtkDelaunayFlip* filter)
{
  try
  {
    vtkNew<vtkPolyData> mesh;
    return filter && filter->StoreMesh(mesh) ? MakeFaces(mesh) : nullptr;
  }
  catch (const std::exception&)
  {
    return nullptr;
  }
}

}
