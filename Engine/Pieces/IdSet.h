// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_IDSET_H
#define DELAUNAYFLIP_IDSET_H

#include <algorithm>
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

  void Add(std::int64_t id)
  {
    this->Words[id / 64] |= std::uint64_t(1) << (id % 64);
    this->Used[id / 4096] |= std::uint64_t(1) << (id / 64 % 64);
  }

  /// All, ascending.
  template <typename Id>
  std::vector<Id> List() const
  {
    std::vector<Id> ids;
    this->ForEachWord(
      [&](std::size_t word)
      {
        ForEachBit(this->Words[word],
          [&](std::size_t bit) { ids.push_back(static_cast<Id>(64 * word + bit)); });
      });
    return ids;
  }

  void Clear()
  {
    this->ForEachWord([this](std::size_t word) { this->Words[word] = 0; });
    std::fill(this->Used.begin(), this->Used.end(), 0);
  }

private:
  /// Calls visit(i) for the words that are not 0.
  template <typename Visit>
  void ForEachWord(const Visit& visit) const
  {
    for (std::size_t i = 0; i < this->Used.size(); ++i)
    {
      ForEachBit(this->Used[i], [&](std::size_t bit) { visit(64 * i + bit); });
    }
  }

  template <typename Visit>
  static void ForEachBit(std::uint64_t bits, const Visit& visit)
  {
    for (; bits != 0; bits &= bits - 1)
    {
      visit(static_cast<std::size_t>(__builtin_ctzll(bits)));
    }
  }

  std::vector<std::uint64_t> Words;
  std::vector<std::uint64_t> Used; ///< By word: whether it is not 0.
};

}

#endif
