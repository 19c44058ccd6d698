// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_GROUPWORK_H
#define DELAUNAYFLIP_GROUPWORK_H

#include "Atomics.h"
#include "HostDevice.h"
#include "ThreadGroup.h"

#include <cstdint>

/// @file
/// What the threads of a group do together. All of them must call these functions.

namespace delaunayflip
{

/// Calls work(i) for i = 0 .. count - 1, shared by the group.
template <typename Work>
DELAUNAYFLIP_HOST_DEVICE void ShareInGroup(
  const ThreadGroup& group, std::int64_t count, const Work& work)
{
  for (std::int64_t i = group.Rank; i < count; i += group.Size)
  {
    work(static_cast<std::uint32_t>(i));
  }
}

/// Likewise, and waits for the group.
template <typename Work>
DELAUNAYFLIP_HOST_DEVICE void ForEachInGroup(
  const ThreadGroup& group, std::int64_t count, const Work& work)
{
  ShareInGroup(group, count, work);
  group.Sync();
}

/// Counts a value, and lists it if there is room. One thread may call it. @returns whether there
/// is.
template <typename Value>
DELAUNAYFLIP_HOST_DEVICE bool Append(
  Value* list, std::uint32_t* count, std::uint32_t most, const Value& value)
{
  const std::uint32_t place = AtomicAdd(count, 1u);
  const bool hasRoom = place < most;
  if (hasRoom)
  {
    list[place] = value;
  }
  return hasRoom;
}

/// One thread may call this, too.
DELAUNAYFLIP_HOST_DEVICE inline void CountIf(bool is, std::uint32_t* count)
{
  if (is)
  {
    AtomicAdd(count, 1u);
  }
}

}

#endif
