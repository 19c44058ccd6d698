// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_METEREDGROUP_H
#define DELAUNAYFLIP_METEREDGROUP_H

#include "PieceGroup.h"

#include <chrono>
#include <cstdint>
#include <utility>

namespace delaunayflip
{

/// What a rank has sent to others.
struct GroupMeter
{
  std::int64_t BytesSent = 0;
  std::int64_t Exchanges = 0;
  std::int64_t Gathers = 0;
  double Seconds = 0.0; ///< In these, waiting included.
};

/// Another group, with its messages measured.
class MeteredGroup : public PieceGroup
{
public:
  MeteredGroup(PieceGroup& group, GroupMeter& meter)
    : Group(group),
      Meter(meter)
  {
  }

  int GetRank() const override { return this->Group.GetRank(); }
  int GetSize() const override { return this->Group.GetSize(); }
  std::vector<Message> Exchange(std::vector<Message> messages) override
  {
    for (int rank = 0; rank < this->GetSize(); ++rank)
    {
      this->Meter.BytesSent += rank == this->GetRank() ? 0 : Size(messages[rank]);
    }
    ++this->Meter.Exchanges;
    return this->Measure([&]() { return this->Group.Exchange(std::move(messages)); });
  }
  std::vector<Message> Gather(const Message& message) override
  {
    this->Meter.BytesSent += (this->GetSize() - 1) * Size(message);
    ++this->Meter.Gathers;
    return this->Measure([&]() { return this->Group.Gather(message); });
  }
  void Work(const std::function<void()>& work) override { this->Group.Work(work); }

private:
  static std::int64_t Size(const Message& message)
  {
    return static_cast<std::int64_t>(message.size());
  }

  template <typename Call>
  std::vector<Message> Measure(const Call& call)
  {
    const auto start = std::chrono::steady_clock::now();
    std::vector<Message> received = call();
    this->Meter.Seconds +=
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return received;
  }

  PieceGroup& Group;
  GroupMeter& Meter;
};

}

#endif
