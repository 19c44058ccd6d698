// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "RankMessages.h"

#include "DataArrays.h"

#include "vtkDataArray.h"
#include "vtkVariant.h"

#include <algorithm>

namespace delaunayflip
{
namespace
{

/// How many bytes the values of an array of a standard layout take.
std::int64_t CountBytes(vtkDataArray* array)
{
  return array->GetDataType() == VTK_BIT ? (array->GetNumberOfValues() + 7) / 8
                                         : array->GetNumberOfValues() * array->GetDataTypeSize();
}

/// Writes tuples of all arrays that have them.
void PutTuples(vtkDataSetAttributes* data, vtkIdList* ids, Message& message)
{
  const vtkIdType count = ids->GetNumberOfIds();
  const vtkIdType last = count > 0 ? *std::max_element(ids->begin(), ids->end()) : 0;
  for (int i = 0; i < data->GetNumberOfArrays() && count > 0; ++i)
  {
    vtkAbstractArray* array = data->GetAbstractArray(i);
    const auto taken = last < array->GetNumberOfTuples() ? MakeZeros(array, count) : nullptr;
    if (!taken)
    {
      continue;
    }
    taken->InsertTuples(MakeRange(0, count), ids, array);
    Put(message, std::string(taken->GetName() ? taken->GetName() : ""));
    Put(message, taken->GetDataType());
    Put(message, taken->GetNumberOfComponents());
    Put(message, data->IsArrayAnAttribute(i));
    if (auto* numbers = vtkArrayDownCast<vtkDataArray>(taken))
    {
      const auto* bytes = static_cast<const char*>(numbers->GetVoidPointer(0));
      message.insert(message.end(), bytes, bytes + CountBytes(numbers));
      continue;
    }
    for (vtkIdType value = 0; value < taken->GetNumberOfValues(); ++value)
    {
      Put(message, std::string(taken->GetVariantValue(value).ToString()));
    }
  }
}

/// Reads an array of `count` tuples. @param attribute receives what it is, or -1.
vtkSmartPointer<vtkAbstractArray> GetTuples(MessageReader& reader, vtkIdType count, int& attribute)
{
  const std::string name = reader.GetText();
  const auto array =
    vtkSmartPointer<vtkAbstractArray>::Take(vtkAbstractArray::CreateArray(reader.Get<int>()));
  array->SetName(name.empty() ? nullptr : name.c_str());
  array->SetNumberOfComponents(reader.Get<int>());
  array->SetNumberOfTuples(count);
  attribute = reader.Get<int>();
  if (auto* numbers = vtkArrayDownCast<vtkDataArray>(array))
  {
    reader.Read(static_cast<char*>(numbers->GetVoidPointer(0)), CountBytes(numbers));
    return array;
  }
  for (vtkIdType value = 0; value < array->GetNumberOfValues(); ++value)
  {
    array->SetVariantValue(value, vtkVariant(reader.GetText()));
  }
  return array;
}

}

MessageReader GatherAll(const Message& message, PieceGroup& group)
{
  Message all;
  for (const Message& one : group.Gather(message))
  {
    all.insert(all.end(), one.begin(), one.end());
  }
  return MessageReader(std::move(all));
}

bool IsOnAnyRank(bool flag, PieceGroup& group)
{
  const std::vector<Message> flags = group.Gather(Message(1, flag ? 1 : 0));
  return std::any_of(
    flags.begin(), flags.end(), [](const Message& one) { return one.front() != 0; });
}

void BringTuples(const std::vector<PieceOrigin>& origins, vtkDataSetAttributes* given,
  const std::function<vtkIdType(std::int64_t)>& tupleOf, PieceGroup& group,
  vtkDataSetAttributes* result)
{
  std::vector<Message> requests(group.GetSize()), answers;
  std::vector<vtkNew<vtkIdList>> places(group.GetSize()); // in the result
  const auto size = static_cast<vtkIdType>(origins.size());
  for (vtkIdType i = 0; i < size; ++i)
  {
    Put(requests[origins[i].Rank], origins[i].Id);
    places[origins[i].Rank]->InsertNextId(i);
  }
  for (Message& message : group.Exchange(std::move(requests)))
  {
    MessageReader wanted(std::move(message));
    vtkNew<vtkIdList> ids;
    while (!wanted.IsAtEnd())
    {
      ids->InsertNextId(tupleOf(wanted.Get<std::int64_t>()));
    }
    answers.emplace_back();
    PutTuples(given, ids, answers.back());
  }
  std::vector<Message> received = group.Exchange(std::move(answers));
  for (int i = 0; i < given->GetNumberOfArrays(); ++i)
  {
    if (const auto zeros = MakeZeros(given->GetAbstractArray(i), size))
    {
      result->AddArray(zeros);
    }
  }
  for (int rank = 0; rank < group.GetSize(); ++rank)
  {
    MessageReader reader(std::move(received[rank]));
    const vtkIdType count = places[rank]->GetNumberOfIds();
    while (!reader.IsAtEnd())
    {
      int attribute = -1;
      const auto values = GetTuples(reader, count, attribute);
      const char* name = values->GetName() ? values->GetName() : "";
      vtkSmartPointer<vtkAbstractArray> target = result->GetAbstractArray(name);
      if (!target && given->GetNumberOfArrays() == 0 && *name)
      {
        target = MakeZeros(values, size);
        AddArrayAs(attribute, target, result);
      }
      if (target && IsSameKind(target, values))
      {
        target->InsertTuples(places[rank], MakeRange(0, count), values);
      }
    }
  }
}

}
