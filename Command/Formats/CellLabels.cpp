// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CellLabels.h"

#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkStringArray.h>

#include <algorithm>
#include <functional>

namespace delaunayflip
{

namespace
{

std::string NameOfTexts(const std::string& array) { return array + "Names"; }

}

CellLabels::CellLabels(const char* array)
  : Array(array)
{
}

void CellLabels::Set(const std::string& text)
{
  const auto known = this->Numbers.find(text);
  if (known == this->Numbers.end())
  {
    this->SetNew(text);
  }
  else
  {
    this->Current = known->second;
  }
}

void CellLabels::SetNew(const std::string& text)
{
  this->Current = static_cast<int>(this->Texts.size());
  this->Texts.push_back(text);
  this->Numbers.try_emplace(text, this->Current);
}

void CellLabels::AddCell(std::size_t kind) { this->OfCells[kind].push_back(this->Current); }

void CellLabels::Store(FileMesh& file) const
{
  if (this->Texts.empty())
  {
    return;
  }
  const vtkNew<vtkIntArray> numbers;
  numbers->SetName(this->Array.c_str());
  const vtkNew<vtkStringArray> texts;
  texts->SetName(NameOfTexts(this->Array).c_str());
  for (const std::string& text : this->Texts)
  {
    texts->InsertNextValue(text);
  }
  const auto unlabelled = static_cast<int>(this->Texts.size());
  bool hasUnlabelled = false;
  for (const std::vector<int>& cells : this->OfCells)
  {
    for (const int number : cells)
    {
      hasUnlabelled = hasUnlabelled || number < 0;
      numbers->InsertNextValue(number < 0 ? unlabelled : number);
    }
  }
  if (hasUnlabelled)
  {
    texts->InsertNextValue("");
  }
  if (numbers->GetNumberOfValues() == 0)
  {
    return;
  }
  file.Mesh->GetCellData()->AddArray(numbers);
  file.Mesh->GetFieldData()->AddArray(texts);
  const std::vector<int>& ofFaces = this->OfCells[2];
  if (std::adjacent_find(ofFaces.begin(), ofFaces.end(), std::not_equal_to<>()) != ofFaces.end())
  {
    file.Labels.push_back(this->Array);
  }
}

StoredLabels::StoredLabels(vtkPolyData* mesh, const std::string& array)
{
  vtkDataArray* const numbers = mesh->GetCellData()->GetArray(array.c_str());
  auto* const texts = vtkStringArray::SafeDownCast(
    mesh->GetFieldData()->GetAbstractArray(NameOfTexts(array).c_str()));
  if (!numbers || !texts || !vtkIntArray::SafeDownCast(numbers) ||
    numbers->GetNumberOfComponents() != 1 ||
    numbers->GetNumberOfTuples() < mesh->GetNumberOfCells())
  {
    return;
  }
  const double* const range = numbers->GetRange(0);
  const bool fits = range[0] >= 0.0 && range[1] < static_cast<double>(texts->GetNumberOfValues());
  if (fits)
  {
    this->Numbers = numbers;
    this->Texts = texts;
  }
}

}
