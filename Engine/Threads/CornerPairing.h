// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_CORNERPAIRING_H
#define DELAUNAYFLIP_CORNERPAIRING_H

#include "Array.h"
#include "EdgeMesh.h"
#include "EdgeTable.h"
#include "ThreadBackend.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <vector>

/// @file
/// Finds which corners face the same edge, on threads. Corners are distributed to buckets of
/// vertices, by the smaller vertex of their edge. A thread pairs the corners of a bucket in a table
/// of its own that fits into a cache. The shared table of all edges (EdgeTable.h) is needed only to
/// search for edges later.

namespace delaunayflip
{

class CornerPairing
{
public:
  CornerPairing(EdgeMesh& mesh, const ThreadBackend& backend)
    : Triangles(mesh.Triangles.Data()),
      Backend(backend)
  {
  }

  /// Sets HalfEdges to the other corners, as SetRoles expects.
  /// @param corners by their buckets. Their order in one does not affect the result.
  /// @param starts where buckets begin in these, and the end.
  PairSums Run(const Array<CornerId>& corners, const std::vector<std::uint32_t>& starts) const
  {
    return this->Backend.SumRanges<PairSums>(
      static_cast<std::int64_t>(starts.size()) - 1,
      [&](std::int64_t begin, std::int64_t end)
      {
        PairSums sums;
        std::uint32_t largest = 0;
        for (std::int64_t bucket = begin; bucket < end; ++bucket)
        {
          largest = std::max(largest, starts[bucket + 1] - starts[bucket]);
        }
        Scratch scratch(largest, this->Backend);
        for (std::int64_t bucket = begin; bucket < end; ++bucket)
        {
          this->PairBucket(
            corners.Data() + starts[bucket], starts[bucket + 1] - starts[bucket], scratch, sums);
        }
        return sums;
      },
      BucketsPerTask);
  }

private:
  static constexpr std::int64_t BucketsPerTask = 4;
  /// Corners between the request for a triangle and its use.
  static constexpr std::uint32_t PrefetchDistance = 32;
  static constexpr std::uint64_t Empty = EdgeTableView::Empty;
  /// A corner of an edge is counted in the upper half of a word.
  static constexpr std::uint64_t OneCorner = std::uint64_t(1) << 32;

  /// A table for the edges of `corners` corners, and their places in it.
  struct Scratch
  {
    Scratch(std::uint32_t corners, const ThreadBackend& backend)
      : Keys(backend.MakeArray<std::uint64_t>(GetCapacity(corners))),
        Words(backend.MakeArray<std::uint64_t>(GetCapacity(corners))),
        Places(backend.MakeArray<std::uint32_t>(corners))
    {
    }

    /// A power of two, so large that half of it stays free even if no two corners share an edge.
    static std::uint32_t GetCapacity(std::uint32_t corners)
    {
      std::uint32_t capacity = 2;
      while (capacity < 2 * corners)
      {
        capacity *= 2;
      }
      return capacity;
    }

    Array<std::uint64_t> Keys;
    Array<std::uint64_t> Words; ///< Number of corners, and the exclusive or of their ids.
    Array<std::uint32_t> Places;
  };

  void PairBucket(
    const CornerId* corners, std::uint32_t size, Scratch& scratch, PairSums& sums) const
  {
    this->EnterCorners(corners, size, scratch, sums);
    for (std::uint32_t i = 0; i < size; ++i)
    {
      const std::uint64_t word = scratch.Words[scratch.Places[i]];
      const auto other = static_cast<CornerId>(word) ^ corners[i];
      const std::uint64_t count = word / OneCorner;
      const CornerId special = count == 1 ? NoCorner : ManyCorners;
      this->Triangles[TriangleOf(corners[i])].HalfEdges[SlotOf(corners[i])] =
        count == 2 ? other : special;
    }
  }

  void EnterCorners(
    const CornerId* corners, std::uint32_t size, Scratch& scratch, PairSums& sums) const
  {
    const std::uint32_t capacity = Scratch::GetCapacity(size);
    std::uint64_t* keys = scratch.Keys.Data();
    static_assert(Empty == ~std::uint64_t(0), "all bytes 0xFF");
    std::memset(keys, 0xFF, capacity * sizeof(std::uint64_t));
    for (std::uint32_t i = 0; i < size; ++i)
    {
      Prefetch(&this->Triangles[TriangleOf(corners[std::min(i + PrefetchDistance, size - 1)])]);
      const CornerId corner = corners[i];
      const std::uint64_t key = KeyOpposite(this->Triangles[TriangleOf(corner)], SlotOf(corner));
      // Places follow from the upper half of a product.
      std::uint32_t place =
        static_cast<std::uint32_t>((((key * 0x9e3779b97f4a7c15u) >> 32) * capacity) >> 32);
      std::uint64_t seen = keys[place];
      // This makes two tests in one branch, because whether an edge is new cannot be predicted.
      while (std::min(seen ^ key, seen ^ Empty) != 0)
      {
        place = (place + 1) & (capacity - 1);
        seen = keys[place];
      }
      const bool isNew = seen == Empty;
      const bool isEdge = IsKeyOfEdge(key);
      const std::uint64_t word = scratch.Words[place] & (std::uint64_t(isNew) - 1);
      keys[place] = key;
      scratch.Words[place] = (word ^ corner) + OneCorner;
      scratch.Places[i] = place;
      sums.Edges += static_cast<int>(isNew) & static_cast<int>(isEdge);
      sums.NonManifold += static_cast<int>(word / OneCorner == 2) & static_cast<int>(isEdge);
    }
  }

  TriangleRecord* Triangles;
  const ThreadBackend& Backend;
};

}

#endif
