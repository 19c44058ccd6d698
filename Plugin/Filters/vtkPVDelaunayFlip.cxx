// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPVDelaunayFlip.h"

#include "SurfaceCells.h"

#include "vtkDataSet.h"
#include "vtkInformation.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

using namespace delaunayflip;

vtkStandardNewMacro(vtkPVDelaunayFlip);

vtkPVDelaunayFlip::vtkPVDelaunayFlip() = default;
vtkPVDelaunayFlip::~vtkPVDelaunayFlip() = default;

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
