// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_THREADBACKEND_H
#define DELAUNAYFLIP_THREADBACKEND_H

#include "Array.h"
#include "TriangleMesh.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace delaunayflip
{

/// Bits of the keys that backends sort by.
constexpr int SortKeyBits = 22;

/// Number of the first item of every piece of a range, and of all items (ForEachNumbered).
struct ThreadNumbering
{
  std::vector<std::int64_t> FirstOfPiece;
  std::int64_t Total = 0;
};

/// "For every item do this" on threads of the CPU. The one place that knows the thread library
/// (oneTBB; std::thread under ThreadSanitizer, which cannot see into the packaged oneTBB).
///
/// A backend is what the algorithms are templates of: ForEach, Sum, Count with ForEachNumbered,
/// SortIndices, and arrays in its own memory. Work is cut into pieces whose borders depend on the
/// problem alone, so no result depends on the number of threads.
class ThreadBackend
{
public:
  /// @param threads 0: as many as the machine has.
  explicit ThreadBackend(int threads);
  ~ThreadBackend();
  ThreadBackend(ThreadBackend&&) noexcept;
  ThreadBackend& operator=(ThreadBackend&&) noexcept;

  /// Whether to spend time on what saves memory.
  static constexpr bool MemoryIsScarce = false;

  /// E.g. "Threads: 8".
  std::string GetName() const;

  /// Calls work(chunk) for chunk = 0 .. count - 1 and returns when all are done. An exception of a
  /// call is thrown again here.
  void ForChunks(std::int64_t count, const std::function<void(std::int64_t)>& work) const;

  /// Calls work(begin, end) on pieces of [0, size) of `grain` items.
  template <typename Work>
  void ForRange(std::int64_t size, const Work& work, std::int64_t grain = DefaultGrain) const
  {
    this->ForChunks((size + grain - 1) / grain,
      [&](std::int64_t chunk) { work(chunk * grain, std::min(size, (chunk + 1) * grain)); });
  }

  /// Sum, by operator+=, of work(begin, end) over pieces of [0, size), in their order.
  template <typename Result, typename Work>
  Result SumRanges(std::int64_t size, const Work& work, std::int64_t grain = DefaultGrain) const
  {
    std::vector<Result> parts((size + grain - 1) / grain);
    this->ForRange(
      size, [&](std::int64_t begin, std::int64_t end) { parts[begin / grain] = work(begin, end); },
      grain);
    Result total{};
    for (const Result& part : parts)
    {
      total += part;
    }
    return total;
  }

  /// Calls work(i) for i = 0 .. size - 1.
  template <typename Work>
  void ForEach(std::int64_t size, const Work& work) const
  {
    this->ForRange(size,
      [&work](std::int64_t begin, std::int64_t end)
      { Loop(begin, end, work, [&work](std::int64_t i) { work(i); }); });
  }

  /// Calls work(i, sum) for i = 0 .. size - 1 on partial sums. @returns their sum by operator+=,
  /// which must not depend on an order.
  template <typename Result, typename Work>
  Result Sum(std::int64_t size, const Work& work) const
  {
    return this->SumRanges<Result>(size,
      [&work](std::int64_t begin, std::int64_t end)
      {
        Result part{};
        Loop(begin, end, work, [&work, &part](std::int64_t i) { work(i, part); });
        return part;
      });
  }

  using Numbering = ThreadNumbering;

  /// Calls count(i), once for every i of [0, size): how many numbered items i has.
  template <typename CountOf>
  Numbering Count(std::int64_t size, const CountOf& count) const
  {
    Numbering numbering;
    numbering.FirstOfPiece.assign(size / DefaultGrain + 1, 0);
    this->ForRange(size,
      [&](std::int64_t begin, std::int64_t end)
      {
        std::int64_t items = 0;
        Loop(begin, end, count, [&count, &items](std::int64_t i) { items += count(i); });
        numbering.FirstOfPiece[begin / DefaultGrain] = items;
      });
    for (std::int64_t& first : numbering.FirstOfPiece)
    {
      const std::int64_t items = first;
      first = numbering.Total;
      numbering.Total += items;
    }
    return numbering;
  }

  /// Calls visit(i, first) for every i of [0, size), where `first` numbers the first of its
  /// count(i) items, counted through in the order of i.
  template <typename CountOf, typename Visit>
  void ForEachNumbered(
    const Numbering& numbering, std::int64_t size, const CountOf& count, const Visit& visit) const
  {
    this->ForRange(size,
      [&](std::int64_t begin, std::int64_t end)
      {
        std::int64_t next = numbering.FirstOfPiece[begin / DefaultGrain];
        Loop(begin, end, visit,
          [&](std::int64_t i)
          {
            const std::int64_t first = next;
            next += count(i);
            visit(i, first);
          });
      });
  }

  /// 0 .. size - 1 by keyOf(i) of at most SortKeyBits bits; equal keys keep their order.
  template <typename KeyOf>
  Array<std::uint32_t> SortIndices(std::int64_t size, const KeyOf& keyOf) const;

  template <typename T>
  Array<T> MakeArray(std::int64_t size) const
  {
    return Array<T>(static_cast<std::size_t>(size));
  }

  /// `size` values from the backend's memory to the host's, and back.
  template <typename T>
  void Download(const T* values, std::int64_t size, T* host) const
  {
    std::copy_n(values, size, host);
  }
  template <typename T>
  void Upload(const T* host, std::int64_t size, T* values) const
  {
    std::copy_n(host, size, values);
  }

  /// The caller's arrays are in reach as they are.
  struct LocalMesh
  {
    TriangleMesh Mesh;

    const TriangleMesh& View() const { return this->Mesh; }
    void DropPoints() {}
    void DropTriangles() {}
    void DropRegions() {}
  };
  LocalMesh Localize(const TriangleMesh& mesh) const { return { mesh }; }

  /// Calls store(t, target) for every triangle, to set its ids in the caller's slot, of which a
  /// device's target may hold some only.
  template <typename Store>
  void StoreTriangles(const MutableTriangleArray& triangles, const Store& store) const
  {
    this->ForEach(triangles.Count, [&](std::int64_t t) { store(t, triangles); });
  }

  /// Calls store(i, values) for i = 0 .. size - 1, to set one of the caller's values.
  template <typename T, typename Store>
  void StoreValues(std::int64_t size, T* values, const Store& store) const
  {
    this->ForEach(size, [&](std::int64_t i) { store(i, values); });
  }

  static constexpr std::int64_t DefaultGrain = 16384;

private:
  /// Items between the request for a cache line and its use.
  static constexpr std::int64_t PrefetchDistance = 32;

  template <typename Work, typename = void>
  struct Prefetches : std::false_type
  {
  };
  template <typename Work>
  struct Prefetches<Work, std::void_t<decltype(std::declval<const Work&>().Prefetch(0))>>
    : std::true_type
  {
  };
  template <typename Work, typename = void>
  struct PrefetchesFar : std::false_type
  {
  };
  template <typename Work>
  struct PrefetchesFar<Work, std::void_t<decltype(std::declval<const Work&>().PrefetchFar(0))>>
    : std::true_type
  {
  };

  /// Calls call(i) for i = begin .. end - 1, and ahead of it work.Prefetch(i) and, still earlier,
  /// work.PrefetchFar(i), if there are such.
  template <typename Work, typename Call>
  static void Loop(std::int64_t begin, std::int64_t end, const Work& work, const Call& call)
  {
    for (std::int64_t i = begin; i < end; ++i)
    {
      if constexpr (PrefetchesFar<Work>::value)
      {
        work.PrefetchFar(std::min(i + 2 * PrefetchDistance, end - 1));
      }
      if constexpr (Prefetches<Work>::value)
      {
        work.Prefetch(std::min(i + PrefetchDistance, end - 1));
      }
      call(i);
    }
  }

  /// One pass of a stable radix sort: `from` to `to` by the digit at `shift`.
  struct KeyedIndex
  {
    std::uint32_t Key;
    std::uint32_t Index;
  };
  void SortByDigit(const Array<KeyedIndex>& from, Array<KeyedIndex>& to, int shift) const;

  class Pool;
  std::unique_ptr<Pool> Threads;
};

template <typename KeyOf>
Array<std::uint32_t> ThreadBackend::SortIndices(std::int64_t size, const KeyOf& keyOf) const
{
  Array<KeyedIndex> items(size);
  Array<KeyedIndex> sorted(size);
  this->ForRange(size,
    [&](std::int64_t begin, std::int64_t end)
    {
      Loop(begin, end, keyOf,
        [&](std::int64_t i) {
          items[i] = { keyOf(i), static_cast<std::uint32_t>(i) };
        });
    });
  this->SortByDigit(items, sorted, 0);
  this->SortByDigit(sorted, items, SortKeyBits / 2);
  Array<std::uint32_t> indices(size);
  this->ForEach(size, [&](std::int64_t i) { indices[i] = items[i].Index; });
  return indices;
}

}

#endif
