// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ControllerGroup.h"

#include "vtkCommunicator.h"
#include "vtkMultiProcessController.h"

#include <algorithm>
#include <new>
#include <stdexcept>
#include <string>
#include <utility>

namespace delaunayflip
{
namespace
{

constexpr int Tag = 5707; // of no other message of VTK or ParaView
constexpr std::size_t LargestPart = std::size_t(1) << 30; // MPI counts with 32 bits

constexpr std::int64_t NoMemory = -1;

[[noreturn]] void ThrowNoMemory(int rank)
{
  throw std::runtime_error("rank " + std::to_string(rank) + ": not enough memory");
}

void Require(int isDone)
{
  if (!isDone)
  {
    throw std::runtime_error("a message to or from another rank was lost");
  }
}

/// Calls allocate() on this rank, and waits for the others.
/// @throws on every rank if one lacks memory.
template <typename Allocate>
void AllocateTogether(vtkMultiProcessController* controller, const Allocate& allocate)
{
  const int ranks = controller->GetNumberOfProcesses();
  int failed = ranks;
  try
  {
    allocate();
  }
  catch (const std::bad_alloc&)
  {
    failed = controller->GetLocalProcessId();
  }
  int first = ranks;
  Require(controller->AllReduce(&failed, &first, 1, vtkCommunicator::MIN_OP));
  if (first < ranks)
  {
    ThrowNoMemory(first);
  }
}

}

std::unique_ptr<PieceGroup> ControllerGroup::Make(vtkMultiProcessController* controller)
{
  std::unique_ptr<ControllerGroup> group(new (std::nothrow) ControllerGroup(controller));
  AllocateTogether(controller,
    [&]()
    {
      if (!group)
      {
        throw std::bad_alloc();
      }
      group->ReserveMemory();
    });
  return group;
}

void ControllerGroup::ReserveMemory()
{
  const auto ranks = static_cast<std::size_t>(this->GetSize());
  this->Slots.resize(ranks);
  this->Sizes.resize(ranks);
  this->AllSizes.resize(ranks * ranks);
}

int ControllerGroup::GetRank() const { return this->Controller->GetLocalProcessId(); }
int ControllerGroup::GetSize() const { return this->Controller->GetNumberOfProcesses(); }

void ControllerGroup::Send(const Message& message, int rank)
{
  for (std::size_t at = 0; at < message.size(); at += LargestPart)
  {
    const auto size = static_cast<vtkIdType>(std::min(LargestPart, message.size() - at));
    Require(this->Controller->Send(message.data() + at, size, rank, Tag));
  }
}

void ControllerGroup::Receive(Message& message, int rank)
{
  for (std::size_t at = 0; at < message.size(); at += LargestPart)
  {
    const auto size = static_cast<vtkIdType>(std::min(LargestPart, message.size() - at));
    Require(this->Controller->Receive(message.data() + at, size, rank, Tag));
  }
}

std::vector<Message> ControllerGroup::Exchange(std::vector<Message> messages)
{
  const int ranks = this->GetSize();
  const int own = this->GetRank();
  std::transform(messages.begin(), messages.end(), this->Sizes.begin(),
    [](const Message& message) { return static_cast<std::int64_t>(message.size()); });
  Require(this->Controller->AllGather(this->Sizes.data(), this->AllSizes.data(), ranks));
  std::vector<Message> received;
  AllocateTogether(this->Controller,
    [&]()
    {
      received.resize(ranks);
      for (int rank = 0; rank < ranks; ++rank)
      {
        received[rank].resize(
          rank == own ? 0 : this->AllSizes[static_cast<std::size_t>(rank) * ranks + own]);
      }
    });
  received[own] = std::move(messages[own]);
  int steps = 1;
  while (steps < ranks)
  {
    steps *= 2;
  }
  // In every step the ranks are paired. The lower one of a pair sends first, so none waits in vain.
  for (int step = 1; step < steps; ++step)
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

std::vector<Message> ControllerGroup::Gather(const Message& message)
{
  std::vector<Message> received;
  bool hasMemory = true;
  try
  {
    received.resize(this->Slots.size());
    for (Message& one : received)
    {
      one.reserve(sizeof(Slot::Bytes));
    }
  }
  catch (const std::bad_alloc&)
  {
    hasMemory = false; // as the others learn at once
  }
  if (!this->GatherSlots(message, hasMemory))
  {
    return this->GatherLong(message);
  }
  for (std::size_t rank = 0; rank < received.size(); ++rank)
  {
    const Slot& slot = this->Slots[rank];
    received[rank].assign(slot.Bytes, slot.Bytes + slot.Size);
  }
  return received;
}

/// Fills the slots of all ranks. @returns whether all messages are short.
bool ControllerGroup::GatherSlots(const Message& message, bool hasMemory)
{
  Slot own{ hasMemory ? static_cast<std::int64_t>(message.size()) : NoMemory, {} };
  std::copy_n(message.begin(), std::min(message.size(), sizeof(own.Bytes)), own.Bytes);
  Require(this->Controller->AllGather(reinterpret_cast<const char*>(&own),
    reinterpret_cast<char*>(this->Slots.data()), static_cast<vtkIdType>(sizeof(own))));
  const auto failed = std::find_if(
    this->Slots.begin(), this->Slots.end(), [](const Slot& one) { return one.Size == NoMemory; });
  if (failed != this->Slots.end())
  {
    ThrowNoMemory(static_cast<int>(failed - this->Slots.begin()));
  }
  return std::all_of(this->Slots.begin(), this->Slots.end(),
    [](const Slot& one) { return one.Size <= static_cast<std::int64_t>(sizeof(one.Bytes)); });
}

/// Gathers messages whose sizes are in the slots.
std::vector<Message> ControllerGroup::GatherLong(const Message& message)
{
  const std::size_t ranks = this->Slots.size();
  std::vector<vtkIdType> sizes, offsets;
  std::vector<Message> received, copies;
  Message all;
  AllocateTogether(this->Controller,
    [&]()
    {
      offsets.push_back(0);
      for (const Slot& slot : this->Slots)
      {
        sizes.push_back(slot.Size);
        offsets.push_back(offsets.back() + slot.Size);
        received.emplace_back(slot.Size);
      }
      const bool areTooLong = static_cast<std::size_t>(offsets.back()) > LargestPart;
      copies.assign(areTooLong ? ranks : 0, message);
      all.resize(areTooLong ? 0 : offsets.back());
    });
  if (!copies.empty())
  {
    return this->Exchange(std::move(copies));
  }
  Require(this->Controller->AllGatherV(message.empty() ? all.data() : message.data(), all.data(),
    static_cast<vtkIdType>(message.size()), sizes.data(), offsets.data()));
  for (std::size_t rank = 0; rank < ranks; ++rank)
  {
    std::copy_n(all.begin() + offsets[rank], sizes[rank], received[rank].begin());
  }
  return received;
}

}
