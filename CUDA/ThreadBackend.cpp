// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ThreadBackend.h"

#include <thread>

#if defined(DELAUNAYFLIP_STD_THREADS)
#include <atomic>
#include <exception>
#include <mutex>
#else
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#endif

namespace delaunayflip
{

namespace
{
int ResolveThreads(int threads)
{
  return threads > 0 ? threads : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}
}

#if defined(DELAUNAYFLIP_STD_THREADS)

class ThreadBackend::Pool
{
public:
  explicit Pool(int threads)
    : Size(threads)
  {
  }

  void Run(std::int64_t count, const std::function<void(std::int64_t)>& work)
  {
    std::atomic<std::int64_t> next{ 0 };
    std::exception_ptr error;
    std::mutex errorMutex;
    const auto drain = [&]()
    {
      for (std::int64_t chunk = next++; chunk < count; chunk = next++)
      {
        try
        {
          work(chunk);
        }
        catch (...)
        {
          const std::lock_guard<std::mutex> lock(errorMutex);
          error = std::current_exception();
        }
      }
    };
    std::vector<std::thread> helpers;
    for (std::int64_t i = 1; i < std::min<std::int64_t>(this->Size, count); ++i)
    {
      helpers.emplace_back(drain);
    }
    drain();
    for (std::thread& helper : helpers)
    {
      helper.join();
    }
    if (error)
    {
      std::rethrow_exception(error);
    }
  }

  int Size;
};

#else

class ThreadBackend::Pool
{
public:
  explicit Pool(int threads)
    : Size(threads),
      Allowance(tbb::global_control::max_allowed_parallelism,
        std::max<std::size_t>(threads,
          tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism))),
      Arena(threads)
  {
  }

  void Run(std::int64_t count, const std::function<void(std::int64_t)>& work)
  {
    this->Arena.execute([&]()
      { tbb::parallel_for(std::int64_t(0), count, [&](std::int64_t chunk) { work(chunk); }); });
  }

  int Size;
  tbb::global_control Allowance; // lets a caller ask for more threads than cores
  tbb::task_arena Arena;
};

#endif

ThreadBackend::ThreadBackend(int threads)
  : Threads(new Pool(ResolveThreads(threads)))
{
}

ThreadBackend::~ThreadBackend() = default;
ThreadBackend::ThreadBackend(ThreadBackend&&) noexcept = default;
ThreadBackend& ThreadBackend::operator=(ThreadBackend&&) noexcept = default;

std::string ThreadBackend::GetName() const
{
  return "Threads: " + std::to_string(this->Threads->Size);
}

void ThreadBackend::ForChunks(
  std::int64_t count, const std::function<void(std::int64_t)>& work) const
{
  if (count > 1 && this->Threads->Size > 1)
  {
    this->Threads->Run(count, work);
    return;
  }
  for (std::int64_t chunk = 0; chunk < count; ++chunk)
  {
    work(chunk);
  }
}

void ThreadBackend::SortByDigit(
  const Array<KeyedIndex>& from, Array<KeyedIndex>& to, int shift) const
{
  constexpr std::uint32_t Digits = 1u << (SortKeyBits / 2);
  constexpr std::int64_t Grain = 1 << 17;
  const std::int64_t size = from.Size();
  const std::int64_t chunks = (size + Grain - 1) / Grain;
  const auto digitOf = [shift](const KeyedIndex& item)
  { return (item.Key >> shift) & (Digits - 1); };
  std::vector<std::uint32_t> starts(chunks * Digits, 0);
  const auto count = [&](std::int64_t begin, std::int64_t end)
  {
    std::uint32_t* counts = &starts[begin / Grain * Digits];
    for (std::int64_t i = begin; i < end; ++i)
    {
      ++counts[digitOf(from[i])];
    }
  };
  this->ForRange(size, count, Grain);
  std::uint32_t start = 0;
  for (std::uint32_t digit = 0; digit < Digits; ++digit)
  {
    for (std::int64_t chunk = 0; chunk < chunks; ++chunk)
    {
      const std::uint32_t items = starts[chunk * Digits + digit];
      starts[chunk * Digits + digit] = start;
      start += items;
    }
  }
  const auto place = [&](std::int64_t begin, std::int64_t end)
  {
    std::uint32_t* next = &starts[begin / Grain * Digits];
    for (std::int64_t i = begin; i < end; ++i)
    {
      to[next[digitOf(from[i])]++] = from[i];
    }
  };
  this->ForRange(size, place, Grain);
}

}
