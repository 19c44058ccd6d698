// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_THREADBACKEND_H
#define DELAUNAYFLIP_THREADBACKEND_H

#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace delaunayflip
{

/// "For every chunk do this" on threads of the CPU. The one place that knows the thread library
/// (oneTBB; std::thread under ThreadSanitizer, which cannot see into the packaged oneTBB).
///
/// Work is cut into chunks whose borders depend on the problem alone, and what chunks return is
/// combined in their order: no result depends on the number of threads.
class ThreadBackend
{
public:
  /// @param threads 0: as many as the machine has.
  explicit ThreadBackend(int threads);
  ~ThreadBackend();
  ThreadBackend(ThreadBackend&&) noexcept;
  ThreadBackend& operator=(ThreadBackend&&) noexcept;

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

  /// Sum, by operator+=, of work(begin, end) over pieces of [0, size).
  template <typename Result, typename Work>
  Result Sum(std::int64_t size, const Work& work, std::int64_t grain = DefaultGrain) const
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

  static constexpr std::int64_t DefaultGrain = 16384;

private:
  class Pool;
  std::unique_ptr<Pool> Threads;
};

}

#endif
