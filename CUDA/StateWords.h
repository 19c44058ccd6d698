// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_STATEWORDS_H
#define DELAUNAYFLIP_STATEWORDS_H

#include "EdgeMesh.h"

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
inline std::uint64_t MatchStates(std::uint64_t states, StateRange wanted)
{
  const std::uint64_t atLeastFirst =
    states + (0x80 - static_cast<std::uint64_t>(wanted.First)) * EveryByte;
  const std::uint64_t aboveLast =
    states + (0x7F - static_cast<std::uint64_t>(wanted.Last)) * EveryByte;
  return atLeastFirst & ~aboveLast & (0x80 * EveryByte);
}

}

#endif
