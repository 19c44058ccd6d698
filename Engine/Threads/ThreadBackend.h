// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_THREADBACKEND_H
#define DELAUNAYFLIP_THREADBACKEND_H

#include "Array.h"
#include "EdgeMesh.h"
#include "EdgeTable.h"
#include "HostMemory.h"
#include "LoadedMesh.h"
#include "ThreadGroup.h"
#include "TriangleMesh.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <functional>
#include <memory>
#include <numeric>
#include <string>
#include <thread>
#include <type_traits>
#include <utility>
#include <vector>

namespace delaunayflip
{

/// More threads than this are used only on machines with more than half as many cores; elsewhere
/// they would only cost memory.
constexpr int MostThreads = 16;

/// The number of the first item of every piece of a range, and the number of items
/// (ForEachNumbered).
struct ThreadNumbering
{
  std::vector<std::int64_t> FirstOfPiece;
  std::int64_t Grain = 1; ///< How many items a piece has.
  std::int64_t Total = 0;
};

/// Whether an item of some work takes long: about half a microsecond. Such work has a member
/// TakesLong, so that a few thousand items already wake another thread.
template <typename Work, typename = void>
constexpr bool TakesLong = false;
template <typename Work>
constexpr bool TakesLong<Work, std::void_t<decltype(Work::TakesLong)>> = Work::TakesLong;

/// Runs work for every item on CPU threads. Only this class uses the thread library: oneTBB, or
/// std::thread under ThreadSanitizer, which cannot see into the packaged oneTBB.
///
/// A backend is the parameter of the algorithms' templates. It has ForEach, Sum, Count with
/// ForEachNumbered, SortIndices, and arrays in its own memory. The bounds of the pieces into which
/// work is divided depend only on the problem, so no result depends on the number of threads.
class ThreadBackend
{
public:
  /// @param threads 0: as many as the machine has. A number that is too large to help, or too large
  /// for the system, is reduced.
  explicit ThreadBackend(int threads);
  ~ThreadBackend();
  ThreadBackend(ThreadBackend&&) noexcept;
  ThreadBackend& operator=(ThreadBackend&&) noexcept;

  /// Threads have no device.
  std::unique_ptr<DeviceScope> MakeCurrent() const { return nullptr; }

  /// Whether its arrays are in the host's memory.
  static constexpr bool IsOnHost = true;

  /// Whether to save memory at the cost of time.
  static constexpr bool MemoryIsScarce = false;
  int CountTableSlices() const { return 1; }

  /// E.g. "Threads: 8".
  std::string GetName() const;

  /// Calls work(task) for task = 0 .. count - 1 and returns when all are done. Rethrows an
  /// exception of a call.
  void ForTasks(std::int64_t count, const std::function<void(std::int64_t)>& work) const;

  /// From now on, calls `poll` on this thread between the tasks that it works on, at most every
  /// twentieth of a second. It may throw, which ends the tasks. Null: no more.
  void SetPoll(std::function<void()> poll);

  /// How many items a piece of a range has: enough that its start costs little, and so few that
  /// a mesh of 50,000 points still has work for many threads. Small ranges are one piece, which
  /// wakes no other thread.
  static constexpr std::int64_t GetGrain(std::int64_t size)
  {
    constexpr std::int64_t Fewest = 2048, Most = 16384, WantedPieces = 64;
    return size <= Most ? Most : std::clamp(size / WantedPieces, Fewest, Most);
  }

  /// How many items of some work a piece has.
  template <typename Work>
  static constexpr std::int64_t GetGrainOf(std::int64_t size)
  {
    constexpr std::int64_t Fewest = 1024, FewestPieces = 4;
    const std::int64_t grain = GetGrain(size);
    return TakesLong<Work> ? std::min(grain, std::max(size / FewestPieces, Fewest)) : grain;
  }

  /// Calls work(begin, end) on pieces of [0, size).
  /// @param grain how many items a piece has; 0: as GetGrain says.
  template <typename Work>
  void ForRange(std::int64_t size, const Work& work, std::int64_t grain = 0) const
  {
    const std::int64_t items = grain > 0 ? grain : GetGrain(size);
    this->ForTasks((size + items - 1) / items,
      [&](std::int64_t piece) { work(piece * items, std::min(size, (piece + 1) * items)); });
  }

  /// The sum, by operator+=, of work(begin, end) over pieces of [0, size), in their order.
  template <typename Result, typename Work>
  Result SumRanges(std::int64_t size, const Work& work, std::int64_t grain) const
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
    this->ForRange(
      size,
      [&work](std::int64_t begin, std::int64_t end)
      { Loop(begin, end, work, [&work](std::int64_t i) { work(i); }); },
      GetGrainOf<Work>(size));
  }

  /// Calls work(group) on each thread of a group.
  template <typename Work>
  void RunGroup(const Work& work) const
  {
    work(ThreadGroup{ 0, 1, 1 });
  }
  std::int64_t CountGroupThreads() const { return 1; }

  /// Calls work(i, sum) for i = 0 .. size - 1 on partial sums. @returns their sum by operator+=,
  /// which must not depend on an order.
  template <typename Result, typename Work>
  Result Sum(std::int64_t size, const Work& work) const
  {
    return this->SumRanges<Result>(
      size,
      [&work](std::int64_t begin, std::int64_t end)
      {
        Result part{};
        Loop(begin, end, work, [&work, &part](std::int64_t i) { work(i, part); });
        return part;
      },
      GetGrain(size));
  }

  using Numbering = ThreadNumbering;

  /// Calls count(i), once for every i of [0, size): how many numbered items i has.
  template <typename CountOf>
  Numbering Count(std::int64_t size, const CountOf& count) const
  {
    Numbering numbering;
    const std::int64_t grain = GetGrainOf<CountOf>(size);
    numbering.Grain = grain;
    numbering.FirstOfPiece.assign(size / grain + 1, 0);
    this->ForRange(
      size,
      [&](std::int64_t begin, std::int64_t end)
      {
        std::int64_t items = 0;
        Loop(begin, end, count, [&count, &items](std::int64_t i) { items += count(i); });
        numbering.FirstOfPiece[begin / grain] = items;
      },
      grain);
    auto& firsts = numbering.FirstOfPiece;
    numbering.Total = std::accumulate(firsts.begin(), firsts.end(), std::int64_t(0));
    std::exclusive_scan(firsts.begin(), firsts.end(), firsts.begin(), std::int64_t(0));
    return numbering;
  }

  /// Calls visit(i, first) for every i of [0, size), where `first` numbers the first of its
  /// count(i) items, counted through in the order of i.
  template <typename CountOf, typename Visit>
  void ForEachNumbered(
    const Numbering& numbering, std::int64_t size, const CountOf& count, const Visit& visit) const
  {
    this->ForRange(
      size,
      [&](std::int64_t begin, std::int64_t end)
      {
        std::int64_t next = numbering.FirstOfPiece[begin / numbering.Grain];
        Loop(begin, end, visit,
          [&](std::int64_t i)
          {
            const std::int64_t first = next;
            next += count(i);
            visit(i, first);
          });
      },
      numbering.Grain);
  }

  /// Sorts `size` numbers, none of which is NaN.
  void SortNumbers(Array<double>& numbers, std::int64_t size) const
  {
    std::sort(numbers.Data(), numbers.Data() + size);
  }

  /// One pass of a stable radix sort: calls put(i, place) for i = 0 .. size - 1, with the place of
  /// i by digitOf(i), below `digits`.
  /// @param most of one digit; if there are more, nothing is put.
  /// @returns the first place of each digit, and the end; or nothing.
  template <typename DigitOf, typename Put>
  std::vector<std::uint32_t> PlaceByDigit(std::int64_t size, std::uint32_t digits,
    const DigitOf& digitOf, const Put& put, std::uint32_t most = ~std::uint32_t(0)) const
  {
    // A piece has a count of every digit, so there are not more counts than items.
    constexpr std::int64_t Fewest = 1 << 12, Most = 1 << 17, WantedPieces = 16;
    const std::int64_t grain =
      std::max<std::int64_t>(std::clamp(size / WantedPieces, Fewest, Most), digits);
    const std::int64_t pieces = (size + grain - 1) / grain;
    std::vector<std::uint32_t> starts(pieces * digits, 0);
    const auto count = [&](std::int64_t begin, std::int64_t end)
    {
      std::uint32_t* counts = &starts[begin / grain * digits];
      for (std::int64_t i = begin; i < end; ++i)
      {
        ++counts[digitOf(i)];
      }
    };
    this->ForRange(size, count, grain);
    // Row by row, which is fast: columns would be a power of two apart.
    std::vector<std::uint32_t> firsts(digits + 1, 0);
    for (std::int64_t piece = 0; piece < pieces; ++piece)
    {
      for (std::uint32_t digit = 0; digit < digits; ++digit)
      {
        firsts[digit + 1] += starts[piece * digits + digit];
      }
    }
    if (*std::max_element(firsts.begin(), firsts.end()) > most)
    {
      return {};
    }
    std::partial_sum(firsts.begin(), firsts.end(), firsts.begin());
    std::vector<std::uint32_t> running(firsts.begin(), firsts.end() - 1);
    for (std::int64_t piece = 0; piece < pieces; ++piece)
    {
      for (std::uint32_t digit = 0; digit < digits; ++digit)
      {
        running[digit] += std::exchange(starts[piece * digits + digit], running[digit]);
      }
    }
    const auto place = [&](std::int64_t begin, std::int64_t end)
    {
      std::uint32_t* next = &starts[begin / grain * digits];
      for (std::int64_t i = begin; i < end; ++i)
      {
        put(i, next[digitOf(i)]++);
      }
    };
    this->ForRange(size, place, grain);
    return firsts;
  }

  /// 0 .. size - 1 by keyOf(i), a number of KeyBits bits; equal keys keep their order.
  template <int KeyBits, typename KeyOf>
  Array<std::uint32_t> SortIndices(std::int64_t size, const KeyOf& keyOf) const
  {
    static_assert(KeyBits % 2 == 0, "two passes, half of the bits each");
    constexpr int DigitBits = KeyBits / 2;
    struct KeyedIndex
    {
      std::uint32_t Key, Index;
    };
    Array<std::uint32_t> keys = this->MakeArray<std::uint32_t>(size);
    Array<KeyedIndex> sorted = this->MakeArray<KeyedIndex>(size); // by the lower digit
    this->ForRange(size,
      [&](std::int64_t begin, std::int64_t end)
      { Loop(begin, end, keyOf, [&](std::int64_t i) { keys[i] = keyOf(i); }); });
    this->PlaceByDigit(
      size, 1u << DigitBits, [&](std::int64_t i) { return keys[i] & ((1u << DigitBits) - 1); },
      [&](std::int64_t i, std::uint32_t place) {
        sorted[place] = { keys[i], static_cast<std::uint32_t>(i) };
      });
    Array<std::uint32_t> indices = std::move(keys);
    this->PlaceByDigit(
      size, 1u << DigitBits, [&](std::int64_t i) { return sorted[i].Key >> DigitBits; },
      [&](std::int64_t i, std::uint32_t place) { indices[place] = sorted[i].Index; });
    return indices;
  }

  /// Finds the other corner of every corner's edge without a table of all edges
  /// (CornerPairing.h), and numbers the edges.
  /// @returns false if one vertex has so many edges that the shared table is faster; then nothing
  /// is changed.
  bool PairCorners(
    EdgeMesh& mesh, std::int64_t vertices, PairSums& sums, Numbering& numbering) const;

  HostMemory& GetHostMemory() const { return *this->Memory; }
  const ThreadBackend& GetThreads() const { return *this; }

  template <typename T>
  Array<T> MakeArray(std::int64_t size) const
  {
    return Array<T>(static_cast<std::size_t>(size), *this->Memory);
  }

  /// Sets the bytes of `size` values.
  template <typename T>
  void Fill(T* values, int byte, std::int64_t size) const
  {
    std::memset(values, byte, static_cast<std::size_t>(size) * sizeof(T));
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

  /// Threads can read the caller's arrays directly.
  struct LocalMesh
  {
    TriangleMesh Mesh;
    static constexpr bool IsOnHost = true;

    void DropPoints() {}
    void DropTriangles() {}
    void DropRegions() {}
  };
  LocalMesh Localize(const TriangleMesh& mesh) const { return { mesh }; }

  /// Touches the pages of memory, so that the system provides them. The contents are lost.
  void TouchPages(void* memory, std::int64_t bytes) const
  {
    constexpr std::int64_t Page = 4096, PagesPerTask = 64;
    this->ForRange((bytes + Page - 1) / Page,
      [=](std::int64_t begin, std::int64_t end)
      {
        for (std::int64_t page = begin; page < end; ++page)
        {
          static_cast<char*>(memory)[page * Page] = 0;
        }
      },
      PagesPerTask);
  }

  /// Calls store(t, target) for every triangle, to set its ids in the caller's slot. On a device, a
  /// target may include only some of them.
  /// @param areInOrder whether the slots have the numbers of the triangles.
  template <typename Store>
  void StoreTriangles(
    const MutableTriangleArray& triangles, const Store& store, bool /*areInOrder*/ = false) const
  {
    this->ForEach(triangles.Count, [&](std::int64_t t) { store(t, triangles); });
  }

  /// Calls store(i, target) for i = 0 .. size - 1, to set one of the caller's values by
  /// target.Set(index, value).
  template <typename Store>
  void StoreValues(std::int64_t size, std::int32_t* values, const Store& store) const
  {
    const OutputSlice all{ reinterpret_cast<std::uint32_t*>(values), 0, size };
    this->ForEach(size, [&](std::int64_t i) { store(i, all); });
  }

private:
  /// Runs the poll where that is due.
  void TakePoll() const;

  std::function<void()> Poll;
  std::thread::id Poller;
  mutable std::chrono::steady_clock::time_point LastPoll; ///< Only used by the poller.

  /// Items between the request for a cache line and its use.
  static constexpr std::int64_t PrefetchDistance = 32;

  /// Calls work.Prefetch(i), if that exists.
  template <typename Work>
  static auto Request(const Work& work, std::int64_t i, int) -> decltype(work.Prefetch(i))
  {
    work.Prefetch(i);
  }
  template <typename Work>
  static void Request(const Work&, std::int64_t, long)
  {
  }

  /// Calls call(i) for i = begin .. end - 1. If work.Prefetch exists, work.Prefetch(i) is called
  /// PrefetchDistance items earlier, except for the first ones.
  template <typename Work, typename Call>
  static void Loop(std::int64_t begin, std::int64_t end, const Work& work, const Call& call)
  {
    for (std::int64_t i = begin; i < end; ++i)
    {
      // Nothing is prefetched beyond end, because other threads may change those items.
      if (i + PrefetchDistance < end)
      {
        Request(work, i + PrefetchDistance, 0);
      }
      call(i);
    }
  }

  class Pool;
  std::unique_ptr<Pool> Threads;
  std::unique_ptr<HostMemory> Memory;
};

/// The seconds since it was made.
class StopWatch
{
public:
  double GetSeconds() const
  {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - this->Start).count();
  }

private:
  std::chrono::steady_clock::time_point Start = std::chrono::steady_clock::now();
};

}

#endif
