// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_EDGECLAIMS_H
#define DELAUNAYFLIP_EDGECLAIMS_H

#include "Atomics.h"
#include "EdgeTable.h"
#include "HostDevice.h"

#include <cstdint>

namespace delaunayflip
{

/// The claims of an iteration on the edges that flips would make. Two flips that share no triangle
/// may make the same edge; then the one with the smaller priority holds the claim.
///
/// A hash table of words (tag of the edge, smallest priority). If two edges with neighbouring
/// places have the same tag, which happens to one pair in billions, they count as one edge, which
/// delays one of them by an iteration. All words are Empty between iterations, because the holder
/// of a claim releases it.
struct EdgeClaims
{
  static constexpr std::uint64_t Empty = ~std::uint64_t(0);

  std::uint64_t* Words;
  std::uint32_t Size;

  /// The number of words for a mesh: winners share no triangle, so at most a third of the edges
  /// win.
  static std::int64_t GetSize(std::int64_t edges) { return edges / 2 + 64; }

  DELAUNAYFLIP_HOST_DEVICE void Claim(VertexId a, VertexId b, std::uint32_t priority) const
  {
    const std::uint64_t word = MakeWord(a, b, priority);
    std::uint32_t slot = this->FirstSlot(word);
    for (;;)
    {
      std::uint64_t seen = AtomicLoad(&this->Words[slot]);
      if (seen == Empty)
      {
        seen = AtomicCompareExchange(&this->Words[slot], Empty, word);
      }
      if (seen == Empty)
      {
        return;
      }
      if (seen >> 32 == word >> 32)
      {
        AtomicMin(&this->Words[slot], word);
        return;
      }
      slot = this->Next(slot);
    }
  }

  /// Whether an edge that was claimed is held by this priority.
  DELAUNAYFLIP_HOST_DEVICE bool Holds(VertexId a, VertexId b, std::uint32_t priority) const
  {
    const std::uint64_t word = MakeWord(a, b, priority);
    std::uint32_t slot = this->FirstSlot(word);
    while (AtomicLoad(&this->Words[slot]) >> 32 != word >> 32)
    {
      slot = this->Next(slot);
    }
    return AtomicLoad(&this->Words[slot]) == word;
  }

  /// Releases a claim that is held. Others may be released at the same time.
  DELAUNAYFLIP_HOST_DEVICE void Release(VertexId a, VertexId b, std::uint32_t priority) const
  {
    const std::uint64_t word = MakeWord(a, b, priority);
    std::uint32_t slot = this->FirstSlot(word);
    while (AtomicLoad(&this->Words[slot]) != word)
    {
      slot = this->Next(slot);
    }
    AtomicStore(&this->Words[slot], Empty);
  }

private:
  DELAUNAYFLIP_HOST_DEVICE static std::uint64_t MakeWord(
    VertexId a, VertexId b, std::uint32_t priority)
  {
    const std::uint64_t key = EdgeKey(a, b);
    const std::uint32_t tag =
      Scatter(static_cast<std::uint32_t>(key) + Scatter(static_cast<std::uint32_t>(key >> 32)));
    // The largest tag with the largest priority would equal Empty.
    return (std::uint64_t(tag & 0x7FFFFFFFu) << 32) | priority;
  }

  DELAUNAYFLIP_HOST_DEVICE std::uint32_t FirstSlot(std::uint64_t word) const
  {
    return static_cast<std::uint32_t>(((word >> 32) * this->Size) >> 31);
  }
  DELAUNAYFLIP_HOST_DEVICE std::uint32_t Next(std::uint32_t slot) const
  {
    return slot + 1 < this->Size ? slot + 1 : 0;
  }
};

}

#endif
