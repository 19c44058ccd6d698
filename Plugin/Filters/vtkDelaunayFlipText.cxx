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

#include <cstddef>
#include <string>

vtkStandardNewMacro(vtkDelaunayFlipText);

namespace
{

/// Breaks long lines at blanks, for a view of usual width.
std::string Wrap(const std::string& text)
{
  constexpr std::size_t Width = 60;
  std::string wrapped;
  std::size_t column = 0, blank = std::string::npos;
  for (const char letter : text)
  {
    wrapped += letter;
    column = letter == '\n' ? 0 : column + 1;
    blank = letter == ' ' ? wrapped.size() - 1 : (column == 0 ? std::string::npos : blank);
    if (column > Width && blank != std::string::npos)
    {
      wrapped.replace(blank, 1, "\n    ");
      column = wrapped.size() - blank - 1;
      blank = std::string::npos;
    }
  }
  return wrapped;
}

std::string Describe(vtkFieldData* data)
{
  auto* summary = vtkStringArray::SafeDownCast(data->GetAbstractArray("DelaunayFlip:Summary"));
  return summary ? Wrap(summary->GetValue(0)) : "no statistics: not a mesh of Delaunay Flip";
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
