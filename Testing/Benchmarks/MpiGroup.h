// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_MPIGROUP_H
#define DELAUNAYFLIP_MPIGROUP_H

#include "PieceGroup.h"

#include <cstdint>
#include <functional>

namespace delaunayflip
{

/// The processes of an mpirun. One object per process, from the beginning of the program to its
/// end. Messages have at most 2^31 - 1 bytes together.
class MpiGroup : public PieceGroup
{
public:
  MpiGroup(int& argc, char**& argv);
  ~MpiGroup() override;
  MpiGroup(const MpiGroup&) = delete;
  MpiGroup& operator=(const MpiGroup&) = delete;

  int GetRank() const override;
  int GetSize() const override;
  std::vector<Message> Exchange(std::vector<Message> messages) override;
  std::vector<Message> Gather(const Message& message) override;

  /// Returns when all processes have called it.
  void Wait();
  double Sum(double value);
  /// Calls change(value) in one process after the other, with what the one before has returned.
  /// @returns what the last one has returned.
  std::uint64_t PassOn(
    std::uint64_t value, const std::function<std::uint64_t(std::uint64_t)>& change);
  /// Ends all processes, e.g. after an exception in one of them.
  void Abort();
};

}

#endif
