// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_POINTSET_H
#define DELAUNAYFLIP_POINTSET_H

#include "Array.h"
#include "Atomics.h"
#include "ThreadBackend.h"

#include <cstdint>

namespace delaunayflip
{

/// Some points of a mesh: a bit for each point.
class PointSet
{
public:
  /// Empty.
  /// @param points of the mesh.
  PointSet(std::int64_t points, const ThreadBackend& backend);

  /// Several threads may add at once.
  void Add(std::int64_t point)
  {
    std::uint32_t* word = this->Words.Data() + point / WordBits;
    const std::uint32_t bit = GetBit(point);
    if ((AtomicLoad(word) & bit) == 0) // most have been added already
    {
      AtomicSet(word, bit);
    }
  }

  bool Has(std::int64_t point) const
  {
    return (this->Words.Data()[point / WordBits] & GetBit(point)) != 0;
  }

  /// Whether a point of a triangle is in the set.
  bool Touches(const TriangleArray& triangles, std::int64_t t) const
  {
    return this->Has(triangles.Get(t, 0)) || this->Has(triangles.Get(t, 1)) ||
      this->Has(triangles.Get(t, 2));
  }

  /// Numbers the points that have been added, in the order of their ids.
  /// @throws MeshTooLarge if a number would not fit into 32 bits.
  void Number(const ThreadBackend& backend);

  // After Number:
  std::int64_t GetSize() const { return this->Size; }
  /// The number of a point of the set.
  std::int32_t GetNumber(std::int64_t point) const
  {
    const std::uint32_t before = this->Words.Data()[point / WordBits] & (GetBit(point) - 1);
    return static_cast<std::int32_t>(
      this->Firsts.Data()[point / WordBits] + __builtin_popcount(before));
  }

  /// Calls visit(point, number) for all points of the set, in several threads.
  template <typename Visit>
  void ForEach(const ThreadBackend& backend, const Visit& visit) const
  {
    backend.ForEach(static_cast<std::int64_t>(this->Words.Size()),
      [&](std::int64_t word)
      {
        std::int32_t number = static_cast<std::int32_t>(this->Firsts.Data()[word]);
        for (std::uint32_t bits = this->Words.Data()[word]; bits != 0; bits &= bits - 1)
        {
          visit(word * WordBits + __builtin_ctz(bits), number++);
        }
      });
  }

private:
  static constexpr std::int64_t WordBits = 32;
  static std::uint32_t GetBit(std::int64_t point) { return std::uint32_t(1) << (point % WordBits); }

  Array<std::uint32_t> Words;
  Array<std::uint32_t> Firsts; ///< By word: the number of its first point.
  std::int64_t Size = 0;
};

}

#endif
