// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDelaunayFlipText.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include <cmath>
#include <cstddef>
#include <cstdio>
#include <limits>
#include <string>

vtkStandardNewMacro(vtkDelaunayFlipText);

namespace
{

vtkAbstractArray* FindArray(vtkFieldData* data, const std::string& name)
{
  return data->GetAbstractArray(("DelaunayFlip:" + name).c_str());
}

/// The last value of an array; NaN if there is none.
double GetLast(vtkFieldData* data, const std::string& name)
{
  auto* array = vtkDataArray::SafeDownCast(FindArray(data, name));
  const vtkIdType count = array ? array->GetNumberOfTuples() : 0;
  return count > 0 ? array->GetTuple1(count - 1) : std::numeric_limits<double>::quiet_NaN();
}

/// 1234567 -> "1,234,567"; NaN, which means no iteration -> "0".
std::string Group(double number)
{
  std::string text = std::isnan(number) ? "0" : std::to_string(std::llround(number));
  for (auto i = static_cast<std::ptrdiff_t>(text.size()) - 3; i > 0; i -= 3)
  {
    text.insert(static_cast<std::size_t>(i), ",");
  }
  return text;
}

std::string Describe(vtkFieldData* data)
{
  auto* reason = vtkStringArray::SafeDownCast(FindArray(data, "StopReason"));
  if (!reason)
  {
    return "no statistics: not a mesh of Delaunay Flip";
  }
  char angle[64] = "";
  const double degrees = GetLast(data, "MinimumAngle");
  if (!std::isnan(degrees))
  {
    std::snprintf(angle, sizeof(angle), "\nsmallest angle %.2f degrees", degrees);
  }
  return "iteration " + Group(GetLast(data, "Iteration")) + ", " + reason->GetValue(0) + "\n" +
    Group(GetLast(data, "TotalFlips")) + " flips, " + Group(GetLast(data, "NonDelaunayEdges")) +
    " bad edges left" + angle;
}

}

int vtkDelaunayFlipText::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  return 1;
}

int vtkDelaunayFlipText::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkNew<vtkStringArray> text;
  text->SetName("Text");
  text->InsertNextValue(Describe(vtkPolyData::GetData(inputVector[0])->GetFieldData()));
  vtkTable::GetData(outputVector)->AddColumn(text);
  return 1;
}
