// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_STATEWORDS_H
#define DELAUNAYFLIP_STATEWORDS_H

#include "EdgeMesh.h"

#include <cstdint>

#if defined(__SSE2__) && !defined(__SANITIZE_THREAD__)
#define DELAUNAYFLIP_STATES_BY_SSE2
#include <emmintrin.h>
#endif

/// @file
/// The states of 64 edges at once, as a set of bits.

namespace delaunayflip
{

constexpr std::int64_t StatesPerSet = 64;

#if defined(DELAUNAYFLIP_STATES_BY_SSE2)

/// Which of 64 states are wanted. Other threads may change states meanwhile whose bits the caller
/// ignores.
inline std::uint64_t MatchStates(const EdgeState* states, StateRange wanted)
{
  const __m128i first = _mm_set1_epi8(static_cast<char>(wanted.First));
  const __m128i range = _mm_set1_epi8(
    static_cast<char>(static_cast<int>(wanted.Last) - static_cast<int>(wanted.First)));
  std::uint64_t set = 0;
  for (int i = 0; i < 4; ++i)
  {
    const __m128i above =
      _mm_sub_epi8(_mm_loadu_si128(reinterpret_cast<const __m128i*>(states) + i), first);
    const __m128i matches = _mm_cmpeq_epi8(_mm_min_epu8(above, range), above);
    set |= static_cast<std::uint64_t>(static_cast<unsigned>(_mm_movemask_epi8(matches)))
      << (16 * i);
  }
  return set;
}

#else

/// The same, by the bytes of machine words.
inline std::uint64_t MatchStates(const EdgeState* states, StateRange wanted)
{
  using Word __attribute__((may_alias)) = std::uint64_t;
  constexpr std::uint64_t EveryByte = 0x0101010101010101u;
  const std::uint64_t first = (0x80 - static_cast<std::uint64_t>(wanted.First)) * EveryByte;
  const std::uint64_t last = (0x7F - static_cast<std::uint64_t>(wanted.Last)) * EveryByte;
  std::uint64_t set = 0;
  for (int i = 0; i < 8; ++i)
  {
    const std::uint64_t word =
      __atomic_load_n(reinterpret_cast<const Word*>(states) + i, __ATOMIC_RELAXED);
    // States are below 16, so bytes do not carry into each other, and their top bits have the
    // answer.
    const std::uint64_t matches = (word + first) & ~(word + last) & (0x80 * EveryByte);
    // The product gathers bit 0 of the eight bytes in the last byte.
    set |= (((matches >> 7) * 0x0102040810204080u) >> 56) << (8 * i);
  }
  return set;
}

#endif

}

#endif
