// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDelaunayFlipText.h"

#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include <regex>
#include <string>

vtkStandardNewMacro(vtkDelaunayFlipText);

namespace
{

/// Breaks lines longer than 44 characters at blanks, for half of a window.
std::string Wrap(const std::string& text)
{
  static const std::regex blank("(?=[^\\n]{45})([^\\n]{1,44}) ");
  return std::regex_replace(text, blank, "$1\n    ");
}

std::string Describe(vtkFieldData* data)
{
  auto* summary = vtkStringArray::SafeDownCast(data->GetAbstractArray("DelaunayFlip:Summary"));
  if (!summary || summary->GetNumberOfValues() == 0)
  {
    return "no statistics: no triangles, or not a mesh of Delaunay Flip";
  }
  return Wrap(summary->GetValue(0));
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
