// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PartitionData.h"

#include "MalformedArrays.h"
#include "TupleTransfer.h"

#include "vtkAbstractArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkIdList.h"
#include "vtkNew.h"

#include <numeric>

namespace delaunayflip
{
namespace
{

bool IsSameKind(vtkAbstractArray* a, vtkAbstractArray* b)
{
  return a->GetDataType() == b->GetDataType() &&
    a->GetNumberOfComponents() == b->GetNumberOfComponents();
}

void InsertTuples(vtkIdType first, vtkIdList* sources, vtkAbstractArray* from, vtkAbstractArray* to)
{
  vtkNew<vtkIdList> targets;
  targets->SetNumberOfIds(sources->GetNumberOfIds());
  std::iota(targets->begin(), targets->end(), first);
  to->InsertTuples(targets, sources, from);
}

}

std::string PartitionData::FindName(vtkDataSetAttributes* own, int index) const
{
  vtkAbstractArray* array = own->GetAbstractArray(index);
  std::string name = array->GetName() ? array->GetName() : "\n" + std::to_string(index);
  if (IsWrongGhostArray(array)) // the joined mesh has the ghost types of the other partitions
  {
    name += '\n';
  }
  vtkAbstractArray* known = this->Joined->GetAbstractArray(name.c_str());
  while (known && !IsSameKind(known, array))
  {
    name += '\n'; // no name that anybody gives
    known = this->Joined->GetAbstractArray(name.c_str());
  }
  return name;
}

void PartitionData::Add(vtkDataSetAttributes* own, vtkIdList* places)
{
  vtkNew<vtkIdList> sources;
  sources->SetNumberOfIds(places->GetNumberOfIds());
  std::iota(sources->begin(), sources->end(), 0);
  for (int i = 0; i < own->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = own->GetAbstractArray(i);
    if (array->GetNumberOfTuples() < places->GetNumberOfIds())
    {
      continue;
    }
    const std::string name = this->FindName(own, i);
    if (!this->Joined->HasArray(name.c_str()))
    {
      const auto made = MakeZeros(array, this->Size);
      if (!made)
      {
        continue;
      }
      made->SetName(name.c_str());
      const int index = this->Joined->AddArray(made);
      const int attribute = own->IsArrayAnAttribute(i);
      if (attribute >= 0 && !this->Joined->GetAbstractAttribute(attribute))
      {
        this->Joined->SetActiveAttribute(index, attribute);
      }
    }
    this->Joined->GetAbstractArray(name.c_str())->InsertTuples(places, sources, array);
  }
}

void PartitionData::Store(vtkDataSetAttributes* own, vtkIdType count, vtkDataSetAttributes* flipped,
  vtkIdList* places, vtkDataSetAttributes* result) const
{
  const vtkIdType size = count + places->GetNumberOfIds();
  for (int i = 0; i < own->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = own->GetAbstractArray(i);
    vtkAbstractArray* source = flipped->GetAbstractArray(this->FindName(own, i).c_str());
    const auto made = source ? MakeZeros(array, size) : nullptr;
    if (!made || array->GetNumberOfTuples() < count)
    {
      continue;
    }
    made->CopyInformation(array->GetInformation());
    made->SetName(array->GetName());
    if (count > 0)
    {
      made->InsertTuples(0, count, 0, array);
    }
    InsertTuples(count, places, source, made);
    const int index = result->AddArray(made);
    const int attribute = own->IsArrayAnAttribute(i);
    if (attribute >= 0)
    {
      result->SetActiveAttribute(index, attribute);
    }
  }
  if (count == 0)
  {
    this->AddNewArrays(flipped, places, result);
  }
}

void PartitionData::AddNewArrays(
  vtkDataSetAttributes* flipped, vtkIdList* places, vtkDataSetAttributes* result) const
{
  for (int i = 0; i < flipped->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = flipped->GetAbstractArray(i);
    const char* name = array->GetName();
    if (name && !this->Joined->HasArray(name))
    {
      const auto made = MakeZeros(array, places->GetNumberOfIds());
      InsertTuples(0, places, array, made);
      result->AddArray(made);
    }
  }
}

}
