// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPVDelaunayFlip.h"

#include "SurfaceCells.h"

#include "vtkCompositeDataSet.h"
#include "vtkDataSet.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

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
  }
  return result;
}

//------------------------------------------------------------------------------
vtkTypeBool vtkPVDelaunayFlip::ProcessRequest(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  // Later requests, and RequestData, see block after block in the place of a composite input.
  if (request->Has(vtkStreamingDemandDrivenPipeline::REQUEST_UPDATE_TIME()))
  {
    this->IsBlock = vtkCompositeDataSet::GetData(inputVector[0], 0) != nullptr;
    this->HasWarned = false;
  }
  return this->Superclass::ProcessRequest(request, inputVector, outputVector);
}

//------------------------------------------------------------------------------
int vtkPVDelaunayFlip::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkDataObject* input = vtkDataObject::GetData(inputVector[0]);
  auto* dataSet = vtkDataSet::SafeDownCast(input);
  if (dataSet && HasSurfaceCells(dataSet))
  {
    return this->FlipSurface(this->GetSurface(dataSet), request, inputVector, outputVector);
  }
  if (!this->IsBlock)
  {
    return this->Superclass::RequestData(request, inputVector, outputVector); // an error
  }
  this->PassBlock(input, outputVector);
  return 1;
}

//------------------------------------------------------------------------------
/// The input as vtkPolyData; the same object while the input is unchanged.
vtkPolyData* vtkPVDelaunayFlip::GetSurface(vtkDataSet* input)
{
  if (auto* surface = vtkPolyData::SafeDownCast(input))
  {
    return surface;
  }
  if (input != this->Source || input->GetMTime() != this->SourceTime)
  {
    this->Surface = ToPolyData(input);
    this->Source = input;
    this->SourceTime = input->GetMTime();
  }
  return this->Surface;
}

//------------------------------------------------------------------------------
int vtkPVDelaunayFlip::FlipSurface(vtkPolyData* surface, vtkInformation* request,
  vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkNew<vtkInformation> meshInformation;
  meshInformation->Copy(inputVector[0]->GetInformationObject(0));
  meshInformation->Set(vtkDataObject::DATA_OBJECT(), surface);
  vtkNew<vtkInformationVector> mesh;
  mesh->Append(meshInformation);
  vtkInformationVector* inputs[] = { mesh, inputVector[1] };
  return this->Superclass::RequestData(request, inputs, outputVector);
}

//------------------------------------------------------------------------------
void vtkPVDelaunayFlip::PassBlock(vtkDataObject* block, vtkInformationVector* outputVector)
{
  if (!this->HasWarned)
  {
    vtkWarningMacro(<< "blocks with cells that are no triangles, polygons or lines pass unchanged; "
                       "the first is a "
                    << block->GetClassName());
    this->HasWarned = true;
  }
  // The executive makes a vtkPolyData again for the next block.
  const auto output = vtkSmartPointer<vtkDataObject>::Take(block->NewInstance());
  output->ShallowCopy(block);
  outputVector->GetInformationObject(0)->Set(vtkDataObject::DATA_OBJECT(), output);
  vtkDataObject::GetData(outputVector, 1)->Initialize();
}
