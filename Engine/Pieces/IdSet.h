// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_IDSET_H
#define DELAUNAYFLIP_IDSET_H

#include <cstddef>
#include <cstdint>
#include <vector>

namespace delaunayflip
{

/// A set of ids, listed in their order without a sort: a bit per id, and one per 64 of these, so
/// that the others cost nothing.
class IdSet
{
public:
  /// Makes room for ids below a number.
  void Resize(std::size_t ids)
  {
    this->Words.resize(ids / 64 + 1);
    this->Used.resize(this->Words.size() / 64 + 1);
  }

  bool Has(std::int64_t id) const { return (this->Words[id / 64] >> (id % 64) & 1) != 0; }

  /// @returns whether it is new.
  bool Add(std::int64_t id)
  {
    const std::uint64_t bit = std::uint64_t(1) << (id % 64);
    std::uint64_t& word = this->Words[id / 64];
    const bool isNew = (word & bit) == 0;
    word |= bit;
    this->Used[id / 4096] |= std::uint64_t(1) << (id / 64 % 64);
    return isNew;
  }

  /// Removes all. @returns them, ascending.
  template <typename Id>
  std::vector<Id> Take()
  {
    std::vector<Id> ids;
    TakeBits(this->Used, 0, this->Used.size(),
      [&](std::size_t word)
      {
        TakeBits(
          this->Words, word, word + 1, [&](std::size_t id) { ids.push_back(static_cast<Id>(id)); });
      });
    return ids;
  }

private:
  /// Calls take(i) for every bit i of some words, and clears it.
  template <typename TakeBit>
  static void TakeBits(
    std::vector<std::uint64_t>& words, std::size_t begin, std::size_t end, const TakeBit& take)
  {
    for (std::size_t i = begin; i < end; ++i)
    {
      for (std::uint64_t bits = words[i]; bits != 0; bits &= bits - 1)
      {
        take(64 * i + FindLowestBit(bits));
      }
      words[i] = 0;
    }
  }

  static std::size_t FindLowestBit(std::uint64_t bits)
  {
    return static_cast<std::size_t>(__builtin_ctzll(bits));
  }

  std::vector<std::uint64_t> Words;
  std::vector<std::uint64_t> Used; ///< By word: whether it is not 0.
};

}

#endif
