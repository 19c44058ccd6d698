// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "RankMessages.h"

#include "DataArrays.h"

#include "vtkCommunicator.h"
#include "vtkDataArray.h"
#include "vtkMultiProcessController.h"
#include "vtkVariant.h"

#include <algorithm>
#include <array>
#include <new>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

namespace delaunayflip
{
namespace
{

constexpr int Tag = 5707; // no other message of VTK or ParaView has it
constexpr std::size_t LargestPart = std::size_t(1) << 30; // MPI counts with 32 bits

void Require(int isDone)
{
  if (!isDone)
  {
    throw std::runtime_error("a message to or from another rank was lost");
  }
}

class ControllerGroup : public PieceGroup
{
public:
  explicit ControllerGroup(vtkMultiProcessController* controller)
    : Controller(controller)
  {
  }

  int GetRank() const override { return this->Controller->GetLocalProcessId(); }
  int GetSize() const override { return this->Controller->GetNumberOfProcesses(); }

  /// Sends only messages that are not empty, from each rank to one other at a time.
  std::vector<Message> Exchange(std::vector<Message> messages) override
  {
    const int ranks = this->GetSize();
    const int own = this->GetRank();
    this->RequireTables();
    std::transform(messages.begin(), messages.end(), this->Sizes.begin(),
      [](const Message& message) { return static_cast<vtkIdType>(message.size()); });
    Require(this->Controller->AllGather(this->Sizes.data(), this->AllSizes.data(), ranks));
    std::vector<Message> received;
    this->AllocateTogether(
      [&]()
      {
        received.resize(ranks);
        for (int rank = 0; rank < ranks; ++rank)
        {
          if (rank != own)
          {
            received[rank].resize(this->AllSizes[static_cast<std::size_t>(rank) * ranks + own]);
          }
        }
      });
    received[own] = std::move(messages[own]);
    // In every step the ranks are paired. The lower one of a pair sends first, so none waits in
    // vain. In steps from the next power of two on, none has a partner.
    for (int step = 1; step < 2 * ranks; ++step)
    {
      const int other = own ^ step;
      if (other >= ranks)
      {
        continue;
      }
      if (own < other)
      {
        this->Send(messages[other], other);
        this->Receive(received[other], other);
      }
      else
      {
        this->Receive(received[other], other);
        this->Send(messages[other], other);
      }
    }
    return received;
  }

  std::vector<Message> Gather(const Message& message) override
  {
    const int ranks = this->GetSize();
    const auto own = static_cast<vtkIdType>(message.size());
    this->RequireTables();
    std::vector<vtkIdType>& sizes = this->Sizes;
    std::vector<vtkIdType>& offsets = this->Offsets;
    Require(this->Controller->AllGather(&own, sizes.data(), 1));
    std::partial_sum(sizes.begin(), sizes.end() - 1, offsets.begin() + 1);
    const auto total = static_cast<std::size_t>(offsets.back() + sizes.back());
    if (total > LargestPart)
    {
      std::vector<Message> copies;
      this->AllocateTogether([&]() { copies.assign(ranks, message); });
      return this->Exchange(std::move(copies));
    }
    Message all;
    std::vector<Message> received;
    this->AllocateTogether(
      [&]()
      {
        all.resize(total + 1); // so that it has an address
        received.resize(ranks);
        for (int rank = 0; rank < ranks; ++rank)
        {
          received[rank].resize(sizes[rank]);
        }
      });
    Require(this->Controller->AllGatherV(message.empty() ? all.data() : message.data(), all.data(),
      own, sizes.data(), offsets.data()));
    for (int rank = 0; rank < ranks; ++rank)
    {
      std::copy_n(all.data() + offsets[rank], sizes[rank], received[rank].data());
    }
    return received;
  }

private:
  /// Makes the tables at the first call, which is that of all ranks.
  void RequireTables()
  {
    if (!this->Sizes.empty())
    {
      return;
    }
    this->AllocateTogether(
      [&]()
      {
        const auto ranks = static_cast<std::size_t>(this->GetSize());
        this->Offsets.resize(ranks);
        this->AllSizes.resize(ranks * ranks);
        this->Sizes.resize(ranks); // last, because it tells whether there are tables
      });
  }

  void Send(const Message& message, int rank)
  {
    for (std::size_t at = 0; at < message.size(); at += LargestPart)
    {
      const auto size = static_cast<vtkIdType>(std::min(LargestPart, message.size() - at));
      Require(this->Controller->Send(message.data() + at, size, rank, Tag));
    }
  }

  /// @param message has the size of what is received.
  void Receive(Message& message, int rank)
  {
    for (std::size_t at = 0; at < message.size(); at += LargestPart)
    {
      const auto size = static_cast<vtkIdType>(std::min(LargestPart, message.size() - at));
      Require(this->Controller->Receive(message.data() + at, size, rank, Tag));
    }
  }

  /// Calls allocate() on this rank, and waits for the others.
  /// @throws on every rank if one lacks memory.
  template <typename Allocate>
  void AllocateTogether(const Allocate& allocate)
  {
    const int ranks = this->GetSize();
    int failed = ranks, first = ranks;
    try
    {
      allocate();
    }
    catch (const std::bad_alloc&)
    {
      failed = this->GetRank();
    }
    Require(this->Controller->AllReduce(&failed, &first, 1, vtkCommunicator::MIN_OP));
    if (first < ranks)
    {
      throw std::runtime_error("rank " + std::to_string(first) + ": not enough memory");
    }
  }

  vtkMultiProcessController* Controller;
  // Kept, because a rank that lacked memory for them before it communicates would leave the others
  // waiting.
  std::vector<vtkIdType> Sizes, Offsets; ///< By rank.
  std::vector<vtkIdType> AllSizes; ///< From each rank to each rank.
};

}

std::unique_ptr<PieceGroup> MakeControllerGroup(vtkMultiProcessController* controller)
{
  return std::unique_ptr<PieceGroup>(new ControllerGroup(controller));
}

//------------------------------------------------------------------------------
namespace
{

/// How many bytes the values of an array of a standard layout take.
std::int64_t CountBytes(vtkDataArray* array)
{
  if (array->GetDataType() == VTK_BIT)
  {
    return (array->GetNumberOfValues() + 7) / 8;
  }
  return array->GetNumberOfValues() * array->GetDataTypeSize();
}

/// Writes a value of an array that is not of numbers, but may have some, each of its own type.
void PutValue(const vtkVariant& value, Message& message)
{
  const bool isReal = value.IsFloat() || value.IsDouble();
  const bool isNumber = value.IsNumeric();
  Put(message, std::array<int, 3>{ static_cast<int>(value.GetType()), isReal, isNumber });
  if (isReal)
  {
    Put(message, value.ToDouble());
  }
  else if (isNumber)
  {
    Put(message, static_cast<std::int64_t>(value.ToTypeInt64()));
  }
  else
  {
    Put(message, std::string(value.ToString()));
  }
}

/// Reads such a value. Others than numbers and texts are texts, and one that is nothing stays so.
vtkVariant GetValue(MessageReader& reader)
{
  const auto [type, isReal, isNumber] = reader.Get<std::array<int, 3>>();
  if (isReal)
  {
    return vtkVariant(vtkVariant(reader.Get<double>()), type);
  }
  if (isNumber)
  {
    return vtkVariant(vtkVariant(static_cast<vtkTypeInt64>(reader.Get<std::int64_t>())), type);
  }
  const auto text = reader.Get<std::string>();
  return type == VTK_VOID ? vtkVariant() : vtkVariant(text);
}

/// Writes tuples of all arrays.
void PutTuples(vtkDataSetAttributes* data, vtkIdList* ids, Message& message)
{
  const vtkIdType count = ids->GetNumberOfIds();
  vtkNew<vtkDataSetAttributes> taken;
  AddTuples(data, ids, MakeRange(0, count), count, taken);
  for (int i = 0; i < taken->GetNumberOfArrays() && count > 0; ++i)
  {
    vtkAbstractArray* array = taken->GetAbstractArray(i);
    Put(message, GetName(array));
    Put(message,
      std::array<int, 3>{
        array->GetDataType(), array->GetNumberOfComponents(), FindAttributes(taken, array) });
    if (auto* numbers = vtkArrayDownCast<vtkDataArray>(array))
    {
      const auto* bytes = static_cast<const char*>(numbers->GetVoidPointer(0));
      message.insert(message.end(), bytes, bytes + CountBytes(numbers));
      continue;
    }
    for (vtkIdType value = 0; value < array->GetNumberOfValues(); ++value)
    {
      PutValue(array->GetVariantValue(value), message);
    }
  }
}

/// Reads arrays of `count` tuples.
vtkSmartPointer<vtkDataSetAttributes> GetTuples(Message message, vtkIdType count)
{
  MessageReader reader(std::move(message));
  auto data = vtkSmartPointer<vtkDataSetAttributes>::New();
  while (!reader.IsAtEnd())
  {
    const auto name = reader.Get<std::string>();
    const auto [type, components, attributes] = reader.Get<std::array<int, 3>>();
    const auto array = vtkSmartPointer<vtkAbstractArray>::Take(vtkAbstractArray::CreateArray(type));
    SetName(name, array);
    array->SetNumberOfComponents(components);
    array->SetNumberOfTuples(count);
    if (auto* numbers = vtkArrayDownCast<vtkDataArray>(array))
    {
      reader.Read(static_cast<char*>(numbers->GetVoidPointer(0)), CountBytes(numbers));
    }
    else
    {
      for (vtkIdType value = 0; value < array->GetNumberOfValues(); ++value)
      {
        array->SetVariantValue(value, GetValue(reader));
      }
    }
    AddAttributes(data, data->AddArray(array), attributes);
  }
  return data;
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
  const std::vector<Message> flags = group.Gather(Message(1, static_cast<char>(flag)));
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
  AddTuples(given, vtkNew<vtkIdList>(), vtkNew<vtkIdList>(), size, result);
  for (int rank = 0; rank < group.GetSize(); ++rank)
  {
    const vtkIdType count = places[rank]->GetNumberOfIds();
    AddTuples(
      GetTuples(std::move(received[rank]), count), MakeRange(0, count), places[rank], size, result);
  }
}

}
