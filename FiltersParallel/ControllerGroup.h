// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef ControllerGroup_h
#define ControllerGroup_h

#include "PieceGroup.h"

class vtkMultiProcessController;

namespace delaunayflip
{

/// The processes of a controller as ranks. The controller must live as long as the group.
class ControllerGroup : public PieceGroup
{
public:
  explicit ControllerGroup(vtkMultiProcessController* controller)
    : Controller(controller)
  {
  }

  int GetRank() const override;
  int GetSize() const override;

  /// Sends only messages that are not empty, from each rank to one other at a time.
  std::vector<Message> Exchange(std::vector<Message> messages) override;

  std::vector<Message> Gather(const Message& message) override;

private:
  void Send(const Message& message, int rank);
  void Receive(Message& message, int rank);

  vtkMultiProcessController* Controller;
};

}

#endif
