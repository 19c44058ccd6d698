// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "TupleTransfer.h"

#include "vtkAbstractArray.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"
#include "vtkVariant.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>

namespace delaunayflip
{
namespace
{

class Writer
{
public:
  void Put(std::int64_t number)
  {
    const char* bytes = reinterpret_cast<const char*>(&number);
    this->Data.insert(this->Data.end(), bytes, bytes + sizeof(number));
  }
  void Put(const std::string& text)
  {
    this->Put(static_cast<std::int64_t>(text.size()));
    this->Data.insert(this->Data.end(), text.begin(), text.end());
  }

  Message Data;
};

class Reader
{
public:
  explicit Reader(const Message& data)
    : Data(data)
  {
  }
  bool IsAtEnd() const { return this->At >= this->Data.size(); }
  std::int64_t GetNumber()
  {
    std::int64_t number = 0;
    std::memcpy(&number, this->Data.data() + this->At, sizeof(number));
    this->At += sizeof(number);
    return number;
  }
  std::string GetText()
  {
    const std::int64_t size = this->GetNumber();
    this->At += size;
    return std::string(this->Data.data() + this->At - size, size);
  }

private:
  const Message& Data;
  std::size_t At = 0;
};

/// How many bytes the values of an array of a standard layout take.
std::int64_t CountBytes(vtkDataArray* array)
{
  return array->GetDataType() == VTK_BIT ? (array->GetNumberOfValues() + 7) / 8
                                         : array->GetNumberOfValues() * array->GetDataTypeSize();
}

vtkSmartPointer<vtkAbstractArray> MakeArray(int type, const std::string& name, int components)
{
  auto array = vtkSmartPointer<vtkAbstractArray>::Take(vtkAbstractArray::CreateArray(type));
  if (array)
  {
    array->SetName(name.empty() ? nullptr : name.c_str());
    array->SetNumberOfComponents(components);
  }
  return array;
}

/// The values of some tuples, in an array of the standard layout.
vtkSmartPointer<vtkAbstractArray> TakeTuples(vtkAbstractArray* array, vtkIdList* ids)
{
  const char* name = array->GetName();
  const auto taken =
    MakeArray(array->GetDataType(), name ? name : "", array->GetNumberOfComponents());
  if (taken)
  {
    taken->SetNumberOfTuples(ids->GetNumberOfIds());
    for (vtkIdType i = 0; i < ids->GetNumberOfIds(); ++i)
    {
      taken->SetTuple(i, ids->GetId(i), array);
    }
  }
  return taken;
}

void WriteValues(vtkAbstractArray* array, Writer& writer)
{
  if (auto* numbers = vtkArrayDownCast<vtkDataArray>(array))
  {
    const auto* bytes = static_cast<const char*>(numbers->GetVoidPointer(0));
    writer.Put(std::string(bytes, CountBytes(numbers)));
    return;
  }
  Writer texts;
  for (vtkIdType i = 0; i < array->GetNumberOfValues(); ++i)
  {
    texts.Put(array->GetVariantValue(i).ToString());
  }
  writer.Put(std::string(texts.Data.begin(), texts.Data.end()));
}

void ReadValues(const std::string& values, vtkAbstractArray* array)
{
  if (auto* numbers = vtkArrayDownCast<vtkDataArray>(array))
  {
    std::copy(values.begin(), values.end(), static_cast<char*>(numbers->GetVoidPointer(0)));
    return;
  }
  const Message message(values.begin(), values.end());
  Reader reader(message);
  for (vtkIdType i = 0; i < array->GetNumberOfValues(); ++i)
  {
    array->SetVariantValue(i, vtkVariant(reader.GetText()));
  }
}

/// The tuples of all arrays that another rank asks for.
Message PackTuples(const std::vector<std::int64_t>& wanted, vtkDataSetAttributes* given)
{
  Writer writer;
  vtkNew<vtkIdList> ids;
  for (const std::int64_t id : wanted)
  {
    ids->InsertNextId(id);
  }
  for (int i = 0; i < given->GetNumberOfArrays() && !wanted.empty(); ++i)
  {
    vtkAbstractArray* array = given->GetAbstractArray(i);
    const vtkIdType last = *std::max_element(wanted.begin(), wanted.end());
    const auto taken = last < array->GetNumberOfTuples() ? TakeTuples(array, ids) : nullptr;
    if (taken)
    {
      writer.Put(std::string(taken->GetName() ? taken->GetName() : ""));
      writer.Put(taken->GetDataType());
      writer.Put(taken->GetNumberOfComponents());
      writer.Put(given->IsArrayAnAttribute(i));
      WriteValues(taken, writer);
    }
  }
  return std::move(writer.Data);
}

void AddZeros(vtkDataSetAttributes* given, vtkIdType size, vtkDataSetAttributes* result)
{
  for (int i = 0; i < given->GetNumberOfArrays(); ++i)
  {
    const auto zeros = MakeZeros(given->GetAbstractArray(i), size);
    if (zeros)
    {
      result->AddArray(zeros);
    }
  }
}

/// Puts the tuples that came from one rank to their places.
class TuplePlacer
{
public:
  TuplePlacer(vtkDataSetAttributes* result, bool takesAll, vtkIdType size)
    : Result(result),
      TakesAll(takesAll),
      Size(size)
  {
  }

  /// @param places the tuples' places in the result, in the order in which they were asked for.
  void Place(const Message& message, const std::vector<vtkIdType>& places)
  {
    Reader reader(message);
    while (!reader.IsAtEnd())
    {
      const std::string name = reader.GetText();
      const int type = static_cast<int>(reader.GetNumber());
      const int components = static_cast<int>(reader.GetNumber());
      const int attribute = static_cast<int>(reader.GetNumber());
      const auto values = MakeArray(type, name, components);
      values->SetNumberOfTuples(static_cast<vtkIdType>(places.size()));
      ReadValues(reader.GetText(), values);
      vtkAbstractArray* target = this->FindTarget(values, attribute);
      for (std::size_t i = 0; target && i < places.size(); ++i)
      {
        target->SetTuple(places[i], static_cast<vtkIdType>(i), values);
      }
    }
  }

private:
  vtkAbstractArray* FindTarget(vtkAbstractArray* values, int attribute)
  {
    const char* name = values->GetName();
    vtkAbstractArray* target = this->Result->GetAbstractArray(name ? name : "");
    const bool fits = target && target->GetDataType() == values->GetDataType() &&
      target->GetNumberOfComponents() == values->GetNumberOfComponents();
    if (target || !this->TakesAll || !name)
    {
      return fits ? target : nullptr;
    }
    const auto made = MakeZeros(values, this->Size);
    const int index = this->Result->AddArray(made);
    if (attribute >= 0)
    {
      this->Result->SetActiveAttribute(index, attribute);
    }
    return made;
  }

  vtkDataSetAttributes* Result;
  bool TakesAll;
  vtkIdType Size;
};

std::vector<Message> PackRequests(
  const std::vector<PieceOrigin>& origins, int ranks, std::vector<std::vector<vtkIdType>>& places)
{
  std::vector<Writer> writers(ranks);
  places.resize(ranks);
  for (std::size_t i = 0; i < origins.size(); ++i)
  {
    writers[origins[i].Rank].Put(origins[i].Id);
    places[origins[i].Rank].push_back(static_cast<vtkIdType>(i));
  }
  std::vector<Message> requests;
  for (Writer& writer : writers)
  {
    requests.push_back(std::move(writer.Data));
  }
  return requests;
}

}

vtkSmartPointer<vtkAbstractArray> MakeZeros(vtkAbstractArray* like, vtkIdType size)
{
  const char* name = like->GetName();
  const auto array =
    MakeArray(like->GetDataType(), name ? name : "", like->GetNumberOfComponents());
  if (array)
  {
    array->SetNumberOfTuples(size);
  }
  if (auto* numbers = vtkArrayDownCast<vtkDataArray>(array))
  {
    numbers->Fill(0.0);
  }
  return array;
}

void BringTuples(const std::vector<PieceOrigin>& origins, vtkDataSetAttributes* given,
  const std::function<vtkIdType(std::int64_t)>& tupleOf, PieceGroup& group,
  vtkDataSetAttributes* result)
{
  std::vector<std::vector<vtkIdType>> places;
  const std::vector<Message> wanted =
    group.Exchange(PackRequests(origins, group.GetSize(), places));
  std::vector<Message> answers;
  DoTogether(group,
    [&]()
    {
      for (const Message& message : wanted)
      {
        std::vector<std::int64_t> ids(message.size() / sizeof(std::int64_t));
        std::copy_n(message.data(), message.size(), reinterpret_cast<char*>(ids.data()));
        std::transform(ids.begin(), ids.end(), ids.begin(), tupleOf);
        answers.push_back(PackTuples(ids, given));
      }
    });
  const std::vector<Message> received = group.Exchange(std::move(answers));
  DoTogether(group,
    [&]()
    {
      const auto size = static_cast<vtkIdType>(origins.size());
      AddZeros(given, size, result);
      TuplePlacer placer(result, given->GetNumberOfArrays() == 0, size);
      for (int rank = 0; rank < group.GetSize(); ++rank)
      {
        placer.Place(received[rank], places[rank]);
      }
    });
}

}
