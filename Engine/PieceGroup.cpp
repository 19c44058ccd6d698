// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PieceGroup.h"

#include "FlipError.h"
#include "FlipReport.h"

#include <condition_variable>
#include <exception>
#include <mutex>
#include <new>
#include <thread>

/// @file
/// Groups of one rank and of threads, and how a failure of one rank reaches the others.

namespace delaunayflip
{

PieceGroup::~PieceGroup() = default;

namespace
{
/// Ends a rank after another one has failed.
struct GroupBroken
{
};

/// The messages and locks that the threads of a group share.
struct MessageBoard
{
  MessageBoard(int size, const std::vector<int>& turnOf)
    : Messages(size),
      Turns(turnOf.empty() ? 0 : 1 + *std::max_element(turnOf.begin(), turnOf.end())),
      TurnOf(turnOf)
  {
  }

  std::vector<std::vector<Message>> Messages; ///< By the rank that sends them, then by receiver.
  std::vector<std::mutex> Turns;
  const std::vector<int>& TurnOf; ///< By rank; or empty.
  std::mutex Mutex; ///< Guards what follows.
  std::condition_variable Changed;
  std::size_t Waiting = 0;
  long Meeting = 0;
  std::exception_ptr Failure; ///< The first.
};

class ThreadGroup : public PieceGroup
{
public:
  ThreadGroup(MessageBoard& board, int rank)
    : Board(board),
      Rank(rank)
  {
  }

  int GetRank() const override { return this->Rank; }
  int GetSize() const override { return static_cast<int>(this->Board.Messages.size()); }
  std::vector<Message> Exchange(std::vector<Message> messages) override
  {
    this->Board.Messages[this->Rank] = std::move(messages);
    this->Wait();
    std::vector<Message> received;
    for (std::vector<Message>& sent : this->Board.Messages)
    {
      received.push_back(std::move(sent[this->Rank]));
    }
    this->Wait();
    return received;
  }
  std::vector<Message> Gather(const Message& message) override
  {
    return this->Exchange(std::vector<Message>(this->GetSize(), message));
  }
  void Work(const std::function<void()>& work) override
  {
    std::unique_lock<std::mutex> lock;
    if (!this->Board.TurnOf.empty())
    {
      lock = std::unique_lock<std::mutex>(this->Board.Turns[this->Board.TurnOf[this->Rank]]);
    }
    work();
  }

private:
  /// Waits until all ranks are here.
  void Wait()
  {
    std::unique_lock<std::mutex> lock(this->Board.Mutex);
    const long meeting = this->Board.Meeting;
    if (++this->Board.Waiting == this->Board.Messages.size())
    {
      this->Board.Waiting = 0;
      ++this->Board.Meeting;
      this->Board.Changed.notify_all();
    }
    this->Board.Changed.wait(
      lock, [&]() { return this->Board.Meeting != meeting || this->Board.Failure; });
    if (this->Board.Failure)
    {
      throw GroupBroken();
    }
  }

  MessageBoard& Board;
  int Rank;
};

class SingleGroup : public PieceGroup
{
public:
  int GetRank() const override { return 0; }
  int GetSize() const override { return 1; }
  std::vector<Message> Exchange(std::vector<Message> messages) override { return messages; }
  std::vector<Message> Gather(const Message& message) override { return { message }; }
};
}

std::unique_ptr<PieceGroup> MakeSingleGroup() { return std::make_unique<SingleGroup>(); }

void RunInThreads(
  int size, const std::function<void(PieceGroup&)>& work, const std::vector<int>& turnOf)
{
  if (size < 1 || (!turnOf.empty() && turnOf.size() < static_cast<std::size_t>(size)))
  {
    throw InvalidOptions("RunInThreads needs at least one rank, and a turn for each");
  }
  MessageBoard board(size, turnOf);
  const auto fail = [&board]() // keeps the first failure, and wakes all
  {
    const std::lock_guard<std::mutex> lock(board.Mutex);
    if (!board.Failure)
    {
      board.Failure = std::current_exception();
    }
    board.Changed.notify_all();
  };
  const auto run = [&](int rank) noexcept
  {
    try
    {
      ThreadGroup group(board, rank);
      work(group);
    }
    catch (const GroupBroken&) // another rank keeps the reason
    {
    }
    catch (...)
    {
      fail();
    }
  };
  std::vector<std::thread> threads;
  try
  {
    for (int rank = 1; rank < size; ++rank)
    {
      threads.emplace_back(run, rank);
    }
  }
  catch (...) // no more threads
  {
    fail();
  }
  run(0);
  for (std::thread& thread : threads)
  {
    thread.join();
  }
  if (board.Failure)
  {
    std::rethrow_exception(board.Failure);
  }
}

//------------------------------------------------------------------------------
namespace
{
/// How a rank has failed: the last character of what it tells the others, after a text. A rank
/// that lacks memory for that tells nothing.
enum FailureKind : char
{
  None,
  Options,
  Mesh,
  Size,
  Backend,
  Abort,
  Other
};

FailureKind FindKind(const std::exception& error)
{
  if (dynamic_cast<const InvalidOptions*>(&error))
  {
    return Options;
  }
  if (dynamic_cast<const InvalidMesh*>(&error))
  {
    return Mesh;
  }
  if (dynamic_cast<const MeshTooLarge*>(&error))
  {
    return Size;
  }
  if (dynamic_cast<const BackendUnavailable*>(&error))
  {
    return Backend;
  }
  return Other;
}

/// The message to other ranks about the exception that is being handled.
Message PackException()
try
{
  std::string text = "an exception of unknown type";
  FailureKind kind = Other;
  try
  {
    throw;
  }
  catch (const RunAborted&)
  {
    kind = Abort;
  }
  catch (const std::bad_alloc&)
  {
    return {};
  }
  catch (const std::exception& error)
  {
    text = error.what();
    kind = FindKind(error);
  }
  catch (...)
  {
  }
  text.push_back(kind);
  return Message(text.begin(), text.end());
}
catch (const std::bad_alloc&)
{
  return {};
}

/// Throws if a rank has failed: the exception of the first of these, which names it.
/// @param all the messages of the ranks.
void ThrowFirst(const std::vector<Message>& all)
{
  bool isAborted = false;
  for (std::size_t rank = 0; rank < all.size(); ++rank)
  {
    const bool hasText = !all[rank].empty(); // else it had no memory for one
    const char kind = hasText ? all[rank].back() : char(Other);
    isAborted = isAborted || kind == Abort;
    if (kind == None || kind == Abort)
    {
      continue;
    }
    std::string text = "not enough memory";
    if (hasText)
    {
      text.assign(all[rank].begin(), all[rank].end() - 1);
    }
    if (all.size() > 1)
    {
      text = "rank " + std::to_string(rank) + ": " + text;
    }
    switch (kind)
    {
      case Options:
        throw InvalidOptions(text);
      case Mesh:
        throw InvalidMesh(text, -1, -1);
      case Size:
        throw MeshTooLarge(text);
      case Backend:
        throw BackendUnavailable(text);
      default:
        throw std::runtime_error(text);
    }
  }
  if (isAborted)
  {
    throw RunAborted();
  }
}

/// Another group. All its ranks learn of it if one of them fails between two calls.
///
/// Whatever the others call next, their first message to the group below is that of a Gather, with
/// a character more that says whether the rank has failed. So a rank that has can answer it without
/// knowing what they call.
class ToldGroup : public PieceGroup
{
public:
  explicit ToldGroup(PieceGroup& group)
    : Group(group)
  {
  }

  int GetRank() const override { return this->Group.GetRank(); }
  int GetSize() const override { return this->Group.GetSize(); }
  std::vector<Message> Exchange(std::vector<Message> messages) override
  {
    this->Gather({});
    return this->Try([&]() { return this->Group.Exchange(std::move(messages)); });
  }
  std::vector<Message> Gather(const Message& message) override
  {
    Message told;
    try
    {
      told.reserve(message.size() + 1);
    }
    catch (const std::bad_alloc&)
    {
      this->Tell({}); // or a group above this one would think that all ranks know
      throw;
    }
    told = message;
    told.push_back(None);
    return this->Share(told);
  }
  void Work(const std::function<void()>& work) override { this->Group.Work(work); }

  /// Tells the other ranks that this one has failed, if they do not know. @throws as they do.
  void Tell(const Message& failure)
  {
    if (!this->End)
    {
      this->Share(failure);
    }
  }

private:
  std::vector<Message> Share(const Message& message)
  {
    std::vector<Message> all = this->Try(
      [&]()
      {
        std::vector<Message> gathered = this->Group.Gather(message);
        ThrowFirst(gathered);
        return gathered;
      });
    for (Message& one : all)
    {
      one.pop_back();
    }
    return all;
  }

  /// Calls a function of the group below, unless one has failed: then some rank calls none any
  /// more.
  template <typename Call>
  std::vector<Message> Try(const Call& call)
  {
    if (this->End)
    {
      std::rethrow_exception(this->End);
    }
    try
    {
      return call();
    }
    catch (...)
    {
      this->End = std::current_exception();
      throw;
    }
  }

  PieceGroup& Group;
  std::exception_ptr End; ///< What all ranks know of, or what the group itself has thrown.
};
}

void RunTogether(PieceGroup& group, const std::function<void(PieceGroup&)>& work)
{
  if (dynamic_cast<ToldGroup*>(&group))
  {
    work(group); // within a RunTogether, which tells the others
    return;
  }
  ToldGroup told(group);
  try
  {
    work(told);
    told.Gather({}); // a rank that fails until here is heard
  }
  catch (...)
  {
    told.Tell(PackException());
    throw;
  }
}

void DoTogether(PieceGroup& group, const std::function<void()>& work)
{
  const auto workAndWait = [&](PieceGroup& told)
  {
    told.Work(work);
    told.Gather({});
  };
  RunTogether(group, std::ref(workAndWait)); // a copy would need memory
}

}
