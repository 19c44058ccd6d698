// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ThreadBackend.h"

#include "CornerPairing.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <exception>
#include <future>
#include <memory>
#include <mutex>
#include <new>
#include <optional>
#include <thread>
#include <utility>

#if !defined(DELAUNAYFLIP_STD_THREADS)
#include <tbb/global_control.h>
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

void RunHere(std::int64_t count, const std::function<void(std::int64_t)>& work)
{
  for (std::int64_t task = 0; task < count; ++task)
  {
    work(task);
  }
}

/// As many threads as this have been started at once in this process.
std::atomic<int> mostStarted{ 1 };

/// oneTBB ends the process where the system refuses it a thread, so that is tried before, with
/// twice as many: there must be memory left for oneTBB itself and for the mesh. oneTBB 2022 waits
/// for ever where memory fails meanwhile; one thread does without oneTBB.
int ResolveThreads(int wanted)
{
  const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  int threads = wanted > 0 ? std::min(wanted, std::max(MostThreads, 2 * cores)) : cores;
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
  HostMemory memory;
  try
  {
    memory.Free(memory.AllocateSparse(room), room);
    return threads;
  }
  catch (const std::bad_alloc&)
  {
    return 1;
  }
}
}

namespace
{
/// The calling thread and helpers, which stay for the next range for a while: with 16 threads,
/// oneTBB takes 20 to 40 us for each range to wake them and to divide it, a crew 3 us. A surface of
/// 50,000 points has about a hundred ranges in 8 ms.
class Crew
{
public:
  using Work = std::function<void(std::int64_t)>;

  /// Calls work(task) for task = 0 .. count - 1. Rethrows an exception of a call. While the crew
  /// has a range, a task or another thread that comes with one works alone.
  void Run(std::int64_t count, const Work& work)
  {
    if (this->IsBusy.exchange(true))
    {
      RunHere(count, work);
      return;
    }
    // The ticket is closed, so that no helper takes a task while this changes.
    this->HasFailed = false;
    this->Done = 0;
    this->Current = &work;
    this->Count = count;
    this->Range += OneRange;
    this->Ticket = this->Range;
    this->TakeTasks();
    for (const IdleTime idle; this->Done < count;)
    {
      idle.Pause();
    }
    this->Ticket = this->Range + Closed;
    const std::exception_ptr error = std::exchange(this->Error, nullptr);
    this->IsBusy = false;
    if (error)
    {
      std::rethrow_exception(error);
    }
  }

  /// What a helper does. It leaves when there has been nothing to do for a while.
  void Help()
  {
    IdleTime idle;
    while (!this->IsOver && idle.Pause() < LongestIdle)
    {
      if (this->TakeTasks())
      {
        idle = IdleTime();
      }
    }
    --this->Helpers;
  }

  std::atomic<int> Helpers{ 0 };
  std::atomic<bool> IsOver{ false };

private:
  using Microseconds = std::chrono::duration<double, std::micro>;
  static constexpr Microseconds LongestIdle{ 300.0 };
  static constexpr std::uint64_t OneRange = std::uint64_t(1) << 32;
  static constexpr std::uint64_t Closed = OneRange - 1;

  /// How long a thread has had nothing to do.
  class IdleTime
  {
  public:
    /// Lets other threads run, but not at once: to come back may take longer than a range. Linux
    /// hardly heeds a yield since 6.6, so that where threads share cores only sleep helps.
    Microseconds Pause() const
    {
      constexpr Microseconds LongestSpin{ 20.0 }, LongestYield{ 100.0 };
      const Microseconds idle = std::chrono::steady_clock::now() - this->Start;
      if (idle > LongestYield)
      {
        std::this_thread::sleep_for(LongestSpin);
      }
      else if (idle > LongestSpin)
      {
        std::this_thread::yield();
      }
      return idle;
    }

  private:
    std::chrono::steady_clock::time_point Start = std::chrono::steady_clock::now();
  };

  /// @returns whether there was one.
  bool TakeTasks()
  {
    for (bool any = false;; any = true)
    {
      std::uint64_t ticket = this->Ticket;
      std::int64_t task;
      const Work* work;
      do
      {
        task = static_cast<std::int64_t>(ticket % OneRange);
        work = this->Current;
        if (task >= this->Count)
        {
          return any;
        }
      } while (!this->Ticket.compare_exchange_weak(ticket, ticket + 1));
      try
      {
        if (!this->HasFailed)
        {
          (*work)(task);
        }
      }
      catch (...)
      {
        const std::lock_guard<std::mutex> lock(this->Mutex);
        this->Error = std::current_exception();
        this->HasFailed = true;
      }
      ++this->Done;
    }
  }

  /// The number of the range, and below it that of its next task, or Closed.
  alignas(64) std::atomic<std::uint64_t> Ticket{ Closed };
  std::atomic<std::int64_t> Count{ 0 };
  std::atomic<const Work*> Current{ nullptr };
  std::atomic<bool> IsBusy{ false }, HasFailed{ false };
  alignas(64) std::atomic<std::int64_t> Done{ 0 };
  std::uint64_t Range = 0;
  std::mutex Mutex;
  std::exception_ptr Error;
};

#if defined(DELAUNAYFLIP_STD_THREADS)

/// A crew with a thread for every helper: what ThreadSanitizer can follow.
class Team
{
public:
  explicit Team(int) {}
  ~Team() { this->Members->IsOver = true; }
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  Crew& GetCrew() const { return *this->Members; }

  void StartHelper()
  {
    std::thread([members = this->Members]() { members->Help(); }).detach();
  }

private:
  std::shared_ptr<Crew> Members = std::make_shared<Crew>(); ///< Helpers may outlive the team.
};

#else

/// An arena of oneTBB, and a crew whose helpers are its threads.
struct CrewInArena
{
  std::unique_ptr<tbb::task_arena> Arena;
  std::shared_ptr<Crew> Members; ///< Helpers may come after the last use.
};

/// Arenas that no backend uses. oneTBB 2021 may never free an arena that ends before its threads
/// have come, as on busy cores, so they are kept for the next backends.
class IdleArenas
{
public:
  static CrewInArena Take(int threads)
  {
    const std::lock_guard<std::mutex> lock(Get().Mutex);
    for (CrewInArena& idle : Get().Arenas)
    {
      if (idle.Arena && idle.Arena->max_concurrency() == threads)
      {
        return std::move(idle);
      }
    }
    return { std::make_unique<tbb::task_arena>(threads), std::make_shared<Crew>() };
  }

  static void Return(CrewInArena used)
  {
    const std::lock_guard<std::mutex> lock(Get().Mutex);
    for (CrewInArena& place : Get().Arenas)
    {
      if (!place.Arena)
      {
        place = std::move(used);
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
  std::array<CrewInArena, 8> Arenas; ///< Null where there is room.
};

/// A crew whose helpers are threads of oneTBB.
class Team
{
public:
  explicit Team(int threads)
    : Own(IdleArenas::Take(threads))
  {
    if (threads > 1)
    {
      constexpr auto parallelism = tbb::global_control::max_allowed_parallelism;
      this->Allowance.emplace(parallelism,
        std::max<std::size_t>(threads, tbb::global_control::active_value(parallelism)));
    }
  }

  ~Team() { IdleArenas::Return(std::move(this->Own)); }
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  Crew& GetCrew() const { return *this->Own.Members; }

  void StartHelper()
  {
    this->Own.Arena->enqueue([members = this->Own.Members]() { members->Help(); });
  }

private:
  std::optional<tbb::global_control> Allowance; // allows more threads than cores
  CrewInArena Own;
};

#endif
}

class ThreadBackend::Pool
{
public:
  explicit Pool(int threads)
    : Size(threads),
      Members(threads)
  {
    if (threads > mostStarted)
    {
      mostStarted = threads;
      this->StartAll();
    }
  }

  void Run(std::int64_t count, const std::function<void(std::int64_t)>& work)
  {
    Crew& crew = this->Members.GetCrew();
    while (crew.Helpers < std::min<std::int64_t>(this->Size, count) - 1)
    {
      this->Members.StartHelper();
      ++crew.Helpers;
    }
    crew.Run(count, work);
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

  Team Members;
};

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
  if (this->Poll)
  {
    const auto polled = [&](std::int64_t task)
    {
      work(task);
      this->TakePoll();
    };
    this->Threads->Size > 1 ? this->Threads->Run(count, polled) : RunHere(count, polled);
  }
  else
  {
    count > 1 && this->Threads->Size > 1 ? this->Threads->Run(count, work) : RunHere(count, work);
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
  const TriangleRecord* triangles = mesh.Triangles.Data();
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
  numbering = this->Count(mesh.NumberOfTriangles, OtherCornerStep{ mesh.Triangles.Data() });
  return true;
}

}
