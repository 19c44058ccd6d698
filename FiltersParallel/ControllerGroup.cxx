// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ControllerGroup.h"

#include "vtkMultiProcessController.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace delaunayflip
{
namespace
{

constexpr int Tag = 5707; // of no other message of VTK or ParaView
constexpr std::size_t LargestPart = std::size_t(1) << 30; // MPI counts with 32 bits

void Require(int isDone)
{
  if (!isDone)
  {
    throw std::runtime_error("a message to or from another rank was lost");
  }
}

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
  std::vector<vtkIdType> sizes(ranks);
  std::transform(messages.begin(), messages.end(), sizes.begin(),
    [](const Message& message) { return static_cast<vtkIdType>(message.size()); });
  std::vector<vtkIdType> all(static_cast<std::size_t>(ranks) * ranks);
  Require(this->Controller->AllGather(sizes.data(), all.data(), ranks));
  std::vector<Message> received(ranks);
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
    received[other].resize(all[static_cast<std::size_t>(other) * ranks + own]);
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
  const int ranks = this->GetSize();
  const auto size = static_cast<vtkIdType>(message.size());
  std::vector<vtkIdType> sizes(ranks);
  Require(this->Controller->AllGather(&size, sizes.data(), 1));
  std::vector<vtkIdType> offsets(ranks + 1);
  for (int rank = 0; rank < ranks; ++rank)
  {
    offsets[rank + 1] = offsets[rank] + sizes[rank];
  }
  if (static_cast<std::size_t>(offsets[ranks]) > LargestPart)
  {
    return this->Exchange(std::vector<Message>(ranks, message));
  }
  Message all(offsets[ranks] + 1); // never empty
  Require(this->Controller->AllGatherV(
    message.empty() ? all.data() : message.data(), all.data(), size, sizes.data(), offsets.data()));
  std::vector<Message> received;
  for (int rank = 0; rank < ranks; ++rank)
  {
    received.emplace_back(all.begin() + offsets[rank], all.begin() + offsets[rank + 1]);
  }
  return received;
}

}
