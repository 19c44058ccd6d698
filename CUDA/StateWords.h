// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_STATEWORDS_H
#define DELAUNAYFLIP_STATEWORDS_H

#include "EdgeMesh.h"
#include "HostDevice.h"

#include <cstdint>

/// @file
/// The states of eight edges at once, as the bytes of a machine word.

namespace delaunayflip
{

constexpr std::int64_t StatesPerWord = 8;
constexpr std::uint64_t EveryByte = 0x0101010101010101u;

/// The states that a step wants, first to last.
struct StateRange
{
  EdgeState First;
  EdgeState Last;
};

/// The top bit of every byte tells whether that state is wanted. States are below 16, so bytes do
/// not carry.
DELAUNAYFLIP_HOST_DEVICE inline std::uint64_t MatchStates(std::uint64_t states, StateRange wanted)
{
  const std::uint64_t atLeastFirst =
    states + (0x80 - static_cast<std::uint64_t>(wanted.First)) * EveryByte;
  const std::uint64_t aboveLast =
    states + (0x7F - static_cast<std::uint64_t>(wanted.Last)) * EveryByte;
  return atLeastFirst & ~aboveLast & (0x80 * EveryByte);
}

/// The bytes of a word whose edges, from `first` on, belong to [begin, end).
DELAUNAYFLIP_HOST_DEVICE inline std::uint64_t MaskOfRange(
  std::int64_t first, std::int64_t begin, std::int64_t end)
{
  const std::uint64_t all = ~std::uint64_t(0);
  const std::int64_t before = begin - first;
  const std::int64_t behind = first + StatesPerWord - end;
  if (before >= StatesPerWord || behind >= StatesPerWord)
  {
    return 0;
  }
  return (before > 0 ? all << (8 * before) : all) & (behind > 0 ? all >> (8 * behind) : all);
}

}

#endif
