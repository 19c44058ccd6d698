// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_OTHERGROUP_H
#define DELAUNAYFLIP_OTHERGROUP_H

#include "PieceGroup.h"

#include <functional>
#include <utility>
#include <vector>

namespace delaunayflip
{

/// Another group, of which derived classes change a part.
class OtherGroup : public PieceGroup
{
public:
  explicit OtherGroup(PieceGroup& group)
    : Group(group)
  {
  }

  int GetRank() const override { return this->Group.GetRank(); }
  int GetSize() const override { return this->Group.GetSize(); }
  std::vector<Message> Exchange(std::vector<Message> messages) override
  {
    return this->Group.Exchange(std::move(messages));
  }
  std::vector<Message> Gather(const Message& message) override
  {
    return this->Group.Gather(message);
  }
  void Work(const std::function<void()>& work) override { this->Group.Work(work); }

private:
  PieceGroup& Group;
};

}

#endif
