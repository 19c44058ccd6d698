// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_CORNERPAIRING_H
#define DELAUNAYFLIP_CORNERPAIRING_H

#include "Array.h"
#include "Atomics.h"
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

/// Writes the roles of a triangle's corners into Flips. HalfEdges hold the edges' other corners:
/// NoCorner for a boundary edge, and for a non-manifold one ManyCorners, which becomes NoCorner.
/// @returns the number of edges that the triangle leads.
struct OtherCornerStep
{
  TriangleRecord* Triangles;

  int operator()(std::int64_t t) const
  {
    TriangleRecord& triangle = this->Triangles[t];
    std::uint32_t roles = 0;
    for (int slot = 0; slot < 3; ++slot)
    {
      const CornerId other = triangle.HalfEdges[slot];
      static_assert(static_cast<int>(CornerRole::Follower) == 0 &&
          static_cast<int>(CornerRole::Leader) == 1 && static_cast<int>(CornerRole::Alone) == 2 &&
          static_cast<int>(CornerRole::OneOfMany) == 3,
        "without branches, the two special ids being larger than any corner");
      const std::uint32_t role = (MakeCorner(static_cast<TriangleId>(t), slot) < other ? 1 : 0) +
        (other == NoCorner ? 1 : 0) + (other == ManyCorners ? 2 : 0);
      roles |= role << (2 * slot);
      triangle.HalfEdges[slot] = other == ManyCorners ? NoCorner : other;
    }
    triangle.Flips |= roles;
    return CountLeaders(triangle);
  }
};

class CornerPairing
{
public:
  CornerPairing(EdgeMesh& mesh, std::int64_t vertices, const ThreadBackend& backend)
    : Triangles(mesh.Triangles.Data()),
      NumberOfTriangles(mesh.NumberOfTriangles),
      Backend(backend)
  {
    while ((vertices >> this->BucketBits) >= MostBuckets)
    {
      ++this->BucketBits;
    }
    this->Starts.assign((vertices >> this->BucketBits) + 2, 0);
    this->CountCorners();
  }

  /// Whether no bucket has so many corners that one thread would still work on it long after the
  /// others: one vertex may have most of the edges.
  bool IsEven(std::uint32_t mostCorners = 1u << 20) const
  {
    return this->GetLargest(0, this->CountBuckets()) <= mostCorners;
  }

  /// Sets HalfEdges to the other corners, as OtherCornerStep expects.
  PairSums Run()
  {
    this->DistributeCorners();
    return this->Backend.SumRanges<PairSums>(
      this->CountBuckets(),
      [this](std::int64_t begin, std::int64_t end)
      {
        PairSums sums;
        Scratch scratch(this->GetLargest(begin, end), this->Backend);
        for (std::int64_t bucket = begin; bucket < end; ++bucket)
        {
          this->PairBucket(bucket, scratch, sums);
        }
        return sums;
      },
      BucketsPerTask);
  }

private:
  static constexpr std::int64_t MostBuckets = 4096;
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

  std::int64_t CountBuckets() const { return static_cast<std::int64_t>(this->Starts.size()) - 1; }

  std::uint32_t GetBucket(const TriangleRecord& triangle, int slot) const
  {
    return std::min(triangle.Vertices[NextSlot(slot)], triangle.Vertices[PreviousSlot(slot)]) >>
      this->BucketBits;
  }

  void CountCorners()
  {
    constexpr std::int64_t Grain = ThreadBackend::DefaultGrain;
    this->CountsOfRange.resize((this->NumberOfTriangles + Grain - 1) / Grain);
    this->Backend.ForRange(this->NumberOfTriangles,
      [this](std::int64_t begin, std::int64_t end)
      {
        std::vector<std::uint32_t>& counts = this->CountsOfRange[begin / Grain];
        counts.assign(this->Starts.size() - 1, 0);
        for (std::int64_t t = begin; t < end; ++t)
        {
          for (int slot = 0; slot < 3; ++slot)
          {
            ++counts[this->GetBucket(this->Triangles[t], slot)];
          }
        }
        for (std::size_t bucket = 0; bucket < counts.size(); ++bucket)
        {
          AtomicAdd(&this->Starts[bucket + 1], counts[bucket]);
        }
      });
    for (std::size_t bucket = 1; bucket < this->Starts.size(); ++bucket)
    {
      this->Starts[bucket] += this->Starts[bucket - 1];
    }
  }

  /// Lists the corners of every bucket. Their order does not affect the result.
  void DistributeCorners()
  {
    this->Corners = this->Backend.MakeArray<CornerId>(this->Starts.back());
    std::vector<std::uint32_t> ends(this->Starts.begin(), this->Starts.end() - 1);
    this->Backend.ForRange(this->NumberOfTriangles,
      [&](std::int64_t begin, std::int64_t end)
      {
        std::vector<std::uint32_t>& next = this->CountsOfRange[begin / ThreadBackend::DefaultGrain];
        for (std::size_t bucket = 0; bucket < next.size(); ++bucket)
        {
          next[bucket] = AtomicAdd(&ends[bucket], next[bucket]);
        }
        for (std::int64_t t = begin; t < end; ++t)
        {
          for (int slot = 0; slot < 3; ++slot)
          {
            this->Corners[next[this->GetBucket(this->Triangles[t], slot)]++] =
              MakeCorner(static_cast<TriangleId>(t), slot);
          }
        }
      });
  }

  std::uint32_t GetLargest(std::int64_t firstBucket, std::int64_t lastBucket) const
  {
    std::uint32_t largest = 0;
    for (std::int64_t bucket = firstBucket; bucket < lastBucket; ++bucket)
    {
      largest = std::max(largest, this->Starts[bucket + 1] - this->Starts[bucket]);
    }
    return largest;
  }

  void PairBucket(std::int64_t bucket, Scratch& scratch, PairSums& sums) const
  {
    const CornerId* corners = this->Corners.Data() + this->Starts[bucket];
    const std::uint32_t size = this->Starts[bucket + 1] - this->Starts[bucket];
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
      // Both tests in one branch, because whether an edge is new cannot be predicted.
      while (std::min(seen ^ key, seen ^ Empty) != 0)
      {
        place = (place + 1) & (capacity - 1);
        seen = keys[place];
      }
      const bool isNew = seen == Empty;
      const bool isEdge = key >> 32 != static_cast<std::uint32_t>(key);
      const std::uint64_t word = scratch.Words[place] & (std::uint64_t(isNew) - 1);
      keys[place] = key;
      scratch.Words[place] = (word ^ corner) + OneCorner;
      scratch.Places[i] = place;
      sums.Edges += static_cast<int>(isNew) & static_cast<int>(isEdge);
      sums.NonManifold += static_cast<int>(word / OneCorner == 2) & static_cast<int>(isEdge);
    }
  }

  TriangleRecord* Triangles;
  std::int64_t NumberOfTriangles;
  const ThreadBackend& Backend;
  int BucketBits = 9;
  std::vector<std::uint32_t> Starts; ///< Where buckets begin in Corners, and the end.
  std::vector<std::vector<std::uint32_t>>
    CountsOfRange; ///< How many corners of each range buckets get.
  Array<CornerId> Corners;
};

}

#endif
