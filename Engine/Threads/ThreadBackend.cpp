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
      for (std::int64_t task = next++; task < count; task = next++)
      {
        try
        {
          work(task);
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
    this->Arena.execute(
      [&]() { tbb::parallel_for(std::int64_t(0), count, [&](std::int64_t task) { work(task); }); });
  }

  int Size;
  tbb::global_control Allowance; // lets a caller ask for more threads than cores
  tbb::task_arena Arena;
};

#endif

ThreadBackend::ThreadBackend(int threads)
  : Threads(new Pool(ResolveThreads(threads))),
    Memory(new HostMemory)
{
}

ThreadBackend::~ThreadBackend() = default;
ThreadBackend::ThreadBackend(ThreadBackend&&) noexcept = default;
ThreadBackend& ThreadBackend::operator=(ThreadBackend&&) noexcept = default;

std::string ThreadBackend::GetName() const
{
  return "Threads: " + std::to_string(this->Threads->Size);
}

void ThreadBackend::ForTasks(
  std::int64_t count, const std::function<void(std::int64_t)>& work) const
{
  if (count > 1 && this->Threads->Size > 1)
  {
    this->Threads->Run(count, work);
    return;
  }
  for (std::int64_t task = 0; task < count; ++task)
  {
    work(task);
  }
}

}
