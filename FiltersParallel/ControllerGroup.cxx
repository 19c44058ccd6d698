// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ControllerGroup.h"

#include "vtkCommunicator.h"
#include "vtkMultiProcessController.h"

#include <algorithm>
#include <cstdint>
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
    std::vector<Message> received(ranks);
    std::vector<std::int64_t> sizes(ranks);
    std::vector<std::int64_t> all(sizes.size() * sizes.size()); // from each rank to each rank
    std::transform(messages.begin(), messages.end(), sizes.begin(),
      [](const Message& message) { return static_cast<std::int64_t>(message.size()); });
    Require(this->Controller->AllGather(sizes.data(), all.data(), ranks));
    this->AllocateTogether(
      [&]()
      {
        for (int rank = 0; rank < ranks; ++rank)
        {
          received[rank].resize(
            rank == own ? 0 : all[static_cast<std::size_t>(rank) * ranks + own]);
        }
      });
    received[own] = std::move(messages[own]);
    int steps = 1;
    while (steps < ranks)
    {
      steps *= 2;
    }
    // In every step the ranks are paired. The lower one of a pair sends first, so none waits in
    // vain.
    for (int step = 1; step < steps; ++step)
    {
      const int other = own ^ step;
      for (const bool sends : { own<other, own> other })
      {
        if (other < ranks)
        {
          this->Pass(sends ? messages[other] : received[other], sends, other);
        }
      }
    }
    return received;
  }

  /// Short messages take one collective operation, longer ones three.
  std::vector<Message> Gather(const Message& message) override
  {
    struct Slot
    {
      std::int64_t Size;
      char Bytes[56]; ///< Of a message that is short.
    };
    const std::size_t ranks = static_cast<std::size_t>(this->GetSize());
    std::vector<Slot> slots(ranks);
    std::vector<Message> received(ranks);
    Slot own{ static_cast<std::int64_t>(message.size()), {} };
    std::copy_n(message.begin(), std::min(message.size(), sizeof(own.Bytes)), own.Bytes);
    Require(this->Controller->AllGather(reinterpret_cast<const char*>(&own),
      reinterpret_cast<char*>(slots.data()), static_cast<vtkIdType>(sizeof(own))));
    std::vector<vtkIdType> sizes, offsets;
    vtkIdType total = 0, longest = 0;
    for (const Slot& slot : slots)
    {
      sizes.push_back(slot.Size);
      offsets.push_back(total);
      total += slot.Size;
      longest = std::max<vtkIdType>(longest, slot.Size);
    }
    if (static_cast<std::size_t>(longest) <= sizeof(own.Bytes))
    {
      for (std::size_t rank = 0; rank < ranks; ++rank)
      {
        received[rank].assign(slots[rank].Bytes, slots[rank].Bytes + slots[rank].Size);
      }
      return received;
    }
    if (static_cast<std::size_t>(total) > LargestPart)
    {
      return this->Exchange(std::vector<Message>(ranks, message));
    }
    Message all;
    this->AllocateTogether([&]() { all.resize(total); });
    Require(this->Controller->AllGatherV(message.empty() ? all.data() : message.data(), all.data(),
      static_cast<vtkIdType>(message.size()), sizes.data(), offsets.data()));
    for (std::size_t rank = 0; rank < ranks; ++rank)
    {
      received[rank].assign(all.begin() + offsets[rank], all.begin() + offsets[rank] + sizes[rank]);
    }
    return received;
  }

private:
  /// Sends a message to a rank, or receives one of known size from it.
  void Pass(Message& message, bool sends, int rank)
  {
    for (std::size_t at = 0; at < message.size(); at += LargestPart)
    {
      char* bytes = message.data() + at;
      const auto size = static_cast<vtkIdType>(std::min(LargestPart, message.size() - at));
      Require(sends ? this->Controller->Send(bytes, size, rank, Tag)
                    : this->Controller->Receive(bytes, size, rank, Tag));
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
};

}

std::unique_ptr<PieceGroup> MakeControllerGroup(vtkMultiProcessController* controller)
{
  return std::unique_ptr<PieceGroup>(new ControllerGroup(controller));
}

}
