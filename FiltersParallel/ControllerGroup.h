// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef ControllerGroup_h
#define ControllerGroup_h

#include "PieceGroup.h"

#include <cstdint>
#include <memory>
#include <vector>

class vtkMultiProcessController;

namespace delaunayflip
{

/// The processes of a controller as ranks. If one of them lacks memory for messages, Make, Exchange
/// and Gather throw on all ranks, with its number: what they need, they allocate before they
/// communicate, and then agree.
class ControllerGroup : public PieceGroup
{
public:
  /// All ranks must call this together. @param controller must live as long as the group.
  static std::unique_ptr<PieceGroup> Make(vtkMultiProcessController* controller);

  int GetRank() const override;
  int GetSize() const override;

  /// Sends only messages that are not empty, from each rank to one other at a time.
  std::vector<Message> Exchange(std::vector<Message> messages) override;

  /// Short messages take one collective operation, longer ones three.
  std::vector<Message> Gather(const Message& message) override;

private:
  /// A message that is short, or the size of one that is not.
  struct Slot
  {
    std::int64_t Size; ///< Or NoMemory: its rank cannot receive.
    char Bytes[56];
  };

  explicit ControllerGroup(vtkMultiProcessController* controller)
    : Controller(controller)
  {
  }

  void ReserveMemory();
  bool GatherSlots(const Message& message, bool hasMemory);
  std::vector<Message> GatherLong(const Message& message);
  void Send(const Message& message, int rank);
  void Receive(Message& message, int rank);

  vtkMultiProcessController* Controller;
  std::vector<Slot> Slots; ///< One per rank.
  std::vector<std::int64_t> Sizes; ///< One per rank.
  std::vector<std::int64_t> AllSizes; ///< Of the messages from each rank to each rank.
};

}

#endif
