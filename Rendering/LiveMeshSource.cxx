// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LiveMeshSource.h"

#include "ColorScales.h"

#include "vtkCellData.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>

namespace delaunayflip
{

vtkStandardNewMacro(LiveMeshSource);

namespace
{

/// What is drawn until other colours are written into the mapper's buffer.
vtkSmartPointer<vtkUnsignedCharArray> MakeColors(vtkIdType count)
{
  auto colors = vtkSmartPointer<vtkUnsignedCharArray>::New();
  colors->SetName(LiveMeshSource::ColorName);
  colors->SetNumberOfComponents(4);
  colors->SetNumberOfTuples(count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    std::copy(PlainBytes.begin(), PlainBytes.end(), colors->GetPointer(4 * i));
  }
  return colors;
}

}

LiveMeshSource::LiveMeshSource() { this->SetNumberOfInputPorts(0); }

LiveMeshSource::~LiveMeshSource() = default;

int LiveMeshSource::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  vtkPolyData* output = vtkPolyData::GetData(outputVector);
  const vtkSmartPointer<vtkPolyData> mesh = this->GetMesh ? this->GetMesh() : nullptr;
  if (mesh)
  {
    vtkDataArray* last = this->Last ? this->Last->GetCellData()->GetArray(ColorName) : nullptr;
    const vtkIdType count = mesh->GetNumberOfCells();
    const bool fits = last && last->GetNumberOfTuples() == count;
    const vtkSmartPointer<vtkDataArray> colors = fits ? last : MakeColors(count);
    this->Last = vtkSmartPointer<vtkPolyData>::New();
    this->Last->ShallowCopy(mesh);
    this->Last->GetCellData()->AddArray(colors);
  }
  if (this->Last)
  {
    output->ShallowCopy(this->Last);
  }
  return 1;
}

}
