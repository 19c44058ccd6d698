// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ThreadBackend.h"

#include "CornerPairing.h"
#include "SystemMemory.h"

#include <array>
#include <atomic>
#include <future>
#include <mutex>
#include <new>
#include <optional>

#if !defined(DELAUNAYFLIP_STD_THREADS)
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#endif

namespace delaunayflip
{

namespace
{
/// Starts up to `most` threads at once. @returns how many there can be beside the calling one.
int CountStartable(int most)
{
  std::promise<void> end;
  const std::shared_future<void> ended = end.get_future().share();
  std::atomic<int> arrived{ 0 };
  std::vector<std::thread> threads;
  threads.reserve(most);
  try
  {
    while (static_cast<int>(threads.size()) < most)
    {
      threads.emplace_back(
        [&arrived, ended]()
        {
          // The C library reserves address space for each thread that allocates.
          const std::unique_ptr<volatile char[]> some(new (std::nothrow) volatile char[64]);
          ++arrived;
          ended.wait();
        });
      while (arrived < static_cast<int>(threads.size()))
      {
        std::this_thread::yield();
      }
    }
  }
  catch (const std::exception&)
  {
    // The system has no room for more.
  }
  end.set_value();
  for (std::thread& thread : threads)
  {
    thread.join();
  }
  return static_cast<int>(threads.size());
}

/// The largest number of threads that were started at once in this process.
std::atomic<int> mostStarted{ 1 };

/// The system reads a file for this, which would take a tenth of the time of a few points.
int CountCores()
{
  static const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  return cores;
}

/// How many threads are used at most, whatever a caller wants.
int FindMostThreads() { return std::max(MostThreads, 2 * CountCores()); }

/// oneTBB ends the process if the system refuses it a thread. So threads are tried before, twice as
/// many, because oneTBB itself and the mesh need memory too. oneTBB 2022 waits for ever if memory
/// fails meanwhile; one thread does without oneTBB.
int ResolveThreads(int wanted)
{
  int threads = wanted > 0 ? std::min(wanted, FindMostThreads()) : CountCores();
  if (threads > mostStarted)
  {
    threads = std::clamp((1 + CountStartable(2 * threads - 1)) / 2, 1, threads);
  }
  if (threads == 1)
  {
    return 1;
  }
  // The heap may have some memory of its own that oneTBB cannot use.
  constexpr std::size_t room = 16 << 20; // many times what oneTBB takes at first or for an arena
  try
  {
    FreeToSystem(AllocateFromSystem(room), room);
    return threads;
  }
  catch (const std::bad_alloc&)
  {
    return 1;
  }
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
    const auto drain = [&]()
    {
      for (std::int64_t task = next++; task < count; task = next++)
      {
        work(task);
      }
    };
    std::vector<std::future<void>> helpers; // their destructors wait, too
    for (std::int64_t i = 1; i < std::min<std::int64_t>(this->Size, count); ++i)
    {
      helpers.push_back(std::async(std::launch::async, drain));
    }
    drain();
    for (std::future<void>& helper : helpers)
    {
      helper.get();
    }
  }

  int Size;
};

#else

/// Arenas that no backend uses. oneTBB 2021 may never free an arena that ends before its threads
/// have come, as on busy cores, so they are kept for the next backends.
class IdleArenas
{
public:
  static std::unique_ptr<tbb::task_arena> Take(int threads)
  {
    const std::lock_guard<std::mutex> lock(Get().Mutex);
    for (std::unique_ptr<tbb::task_arena>& arena : Get().Arenas)
    {
      if (arena && arena->max_concurrency() == threads)
      {
        return std::move(arena);
      }
    }
    return std::make_unique<tbb::task_arena>(threads);
  }

  static void Return(std::unique_ptr<tbb::task_arena> arena)
  {
    const std::lock_guard<std::mutex> lock(Get().Mutex);
    for (std::unique_ptr<tbb::task_arena>& place : Get().Arenas)
    {
      if (!place)
      {
        place = std::move(arena);
        return;
      }
    }
  }

private:
  /// Lives as long as the process: oneTBB may end before static objects do.
  static IdleArenas& Get()
  {
    static auto* idle = new IdleArenas;
    return *idle;
  }

  std::mutex Mutex;
  std::array<std::unique_ptr<tbb::task_arena>, 8> Arenas; ///< Null where there is room.
};

class ThreadBackend::Pool
{
public:
  explicit Pool(int threads)
    : Size(threads)
  {
    if (threads == 1)
    {
      return; // and oneTBB is not used
    }
    // The smallest allowance in the process counts, so those of all pools are equal. The program
    // may have given a smaller one; oneTBB would write a warning if more threads were requested.
    constexpr auto parallelism = tbb::global_control::max_allowed_parallelism;
    this->Allowance.emplace(parallelism, static_cast<std::size_t>(FindMostThreads()));
    this->Size =
      std::min(threads, static_cast<int>(tbb::global_control::active_value(parallelism)));
    this->Arena = IdleArenas::Take(this->Size);
    if (this->Size > mostStarted)
    {
      mostStarted = this->Size;
      this->StartAll();
    }
  }

  ~Pool()
  {
    if (this->Arena)
    {
      IdleArenas::Return(std::move(this->Arena));
    }
  }
  Pool(const Pool&) = delete;
  Pool& operator=(const Pool&) = delete;

  void Run(std::int64_t count, const std::function<void(std::int64_t)>& work)
  {
    this->Arena->execute(
      [&]() { tbb::parallel_for(std::int64_t(0), count, [&](std::int64_t task) { work(task); }); });
  }

  int Size;

private:
  /// Starts all threads now. oneTBB starts threads only when there is work, when the mesh may have
  /// left no memory for them, and keeps those that it has.
  void StartAll()
  {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point deadline = Clock::now() + std::chrono::milliseconds(100);
    std::atomic<int> arrived{ 0 };
    this->Run(this->Size,
      [&](std::int64_t)
      {
        ++arrived;
        while (arrived < this->Size && Clock::now() < deadline)
        {
          std::this_thread::yield();
        }
      });
  }

  std::optional<tbb::global_control> Allowance; // allows more threads than cores
  std::unique_ptr<tbb::task_arena> Arena;
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

void ThreadBackend::SetPoll(std::function<void()> poll)
{
  this->Poll = std::move(poll);
  this->Poller = std::this_thread::get_id();
  this->LastPoll = std::chrono::steady_clock::now();
}

void ThreadBackend::TakePoll() const
{
  constexpr std::chrono::milliseconds Pause(50);
  const auto now = std::chrono::steady_clock::now();
  if (std::this_thread::get_id() == this->Poller && now - this->LastPoll >= Pause)
  {
    this->LastPoll = now;
    this->Poll();
  }
}

void ThreadBackend::ForTasks(
  std::int64_t count, const std::function<void(std::int64_t)>& work) const
{
  const auto run = [&](std::int64_t task)
  {
    work(task);
    if (this->Poll)
    {
      this->TakePoll();
    }
  };
  if (count > 1 && this->Threads->Size > 1)
  {
    this->Threads->Run(count, run);
    return;
  }
  for (std::int64_t task = 0; task < count; ++task)
  {
    run(task);
  }
}

/// Corners are distributed to buckets of vertices. A bucket must not have so many corners that one
/// thread would still work on it long after the others: one vertex may have most of the edges.
bool ThreadBackend::PairCorners(
  EdgeMesh& mesh, std::int64_t vertices, PairSums& sums, Numbering& numbering) const
{
  constexpr std::int64_t MostBuckets = 4096;
  constexpr std::uint32_t MostCornersPerBucket = 1u << 20;
  int bucketBits = 9;
  while ((vertices >> bucketBits) >= MostBuckets)
  {
    ++bucketBits;
  }
  TriangleRecord* triangles = mesh.Triangles.Data();
  const std::int64_t size = 3 * mesh.NumberOfTriangles;
  Array<CornerId> corners = this->MakeArray<CornerId>(size);
  const std::vector<std::uint32_t> starts = this->PlaceByDigit(
    size, static_cast<std::uint32_t>(vertices >> bucketBits) + 1,
    [=](std::int64_t i)
    {
      const VertexId* points = triangles[i / 3].Vertices;
      const int slot = static_cast<int>(i % 3);
      return std::min(points[NextSlot(slot)], points[PreviousSlot(slot)]) >> bucketBits;
    },
    [&](std::int64_t i, std::uint32_t place)
    { corners[place] = MakeCorner(static_cast<TriangleId>(i / 3), static_cast<int>(i % 3)); },
    MostCornersPerBucket);
  if (starts.empty())
  {
    return false;
  }
  sums = CornerPairing(mesh, *this).Run(corners, starts);
  numbering = this->Count(mesh.NumberOfTriangles,
    [=](std::int64_t t)
    {
      SeparateIfEdgeless(triangles[t]);
      return SetRoles(triangles[t], t);
    });
  return true;
}

}
