// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDelaunayFlipChart.h"

#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkTable.h"

vtkStandardNewMacro(vtkDelaunayFlipChart);

namespace
{

constexpr const char* Counts[] = { "Flipped", "Excluded", "Blocked", "NonDelaunay", "Tested" };

void AddColumn(vtkTable* input, const char* name, bool withZeros, vtkTable* output)
{
  vtkDataArray* column = vtkDataArray::SafeDownCast(input->GetColumnByName(name));
  if (!column)
  {
    return;
  }
  vtkNew<vtkDoubleArray> values;
  values->SetName(name);
  const vtkIdType rows = column->GetNumberOfTuples();
  for (vtkIdType i = 0; i < rows; ++i)
  {
    const double value = column->GetTuple1(i);
    values->InsertNextValue(value != 0.0 || withZeros ? value : vtkMath::Nan());
  }
  if (rows == 1)
  {
    values->InsertNextValue(values->GetValue(0)); // VTK reports an error for a line with one point
  }
  output->AddColumn(values);
}

}

int vtkDelaunayFlipChart::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkTable* input = vtkTable::GetData(inputVector[0]);
  vtkTable* output = vtkTable::GetData(outputVector);
  AddColumn(input, "Iteration", true, output);
  for (const char* name : Counts)
  {
    AddColumn(input, name, !this->LogScale, output);
  }
  AddColumn(input, "MinimumAngle", true, output);
  return 1;
}
