// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PieceGroup.h"

#include "FlipError.h"
#include "FlipReport.h"

#include <algorithm>
#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <new>
#include <string>
#include <thread>
#include <utility>
#include <vector>

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

/// What the threads of a group share: a board with a message from every rank to every rank.
class MessageBoard
{
public:
  MessageBoard(int size, const std::vector<int>& turnOf)
    : Messages(size),
      Turns(turnOf.empty() ? 0 : 1 + *std::max_element(turnOf.begin(), turnOf.end())),
      TurnOf(turnOf)
  {
  }

  int GetSize() const { return static_cast<int>(this->Messages.size()); }

  /// The mutex of a rank's turn, or null.
  std::mutex* GetTurn(int rank)
  {
    return this->TurnOf.empty() ? nullptr : &this->Turns[this->TurnOf[rank]];
  }

  std::vector<Message> Exchange(int rank, std::vector<Message> messages)
  {
    this->Messages[rank] = std::move(messages);
    this->Wait();
    std::vector<Message> received(this->GetSize());
    for (int from = 0; from < this->GetSize(); ++from)
    {
      received[from] = std::move(this->Messages[from][rank]);
    }
    this->Wait();
    return received;
  }

  /// Keeps the first failure, and wakes all.
  void Break(std::exception_ptr failure)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    this->Failure = this->Failure ? this->Failure : std::move(failure);
    this->Changed.notify_all();
  }

  std::exception_ptr GetFailure() const { return this->Failure; }

private:
  void Wait()
  {
    std::unique_lock<std::mutex> lock(this->Mutex);
    const long phase = this->Phase;
    if (++this->Waiting == this->GetSize())
    {
      this->Waiting = 0;
      ++this->Phase;
      this->Changed.notify_all();
    }
    this->Changed.wait(lock, [&]() { return this->Phase != phase || this->Failure; });
    if (this->Failure)
    {
      throw GroupBroken();
    }
  }

  std::vector<std::vector<Message>> Messages; ///< By the rank that sent them.
  std::vector<std::mutex> Turns;
  std::vector<int> TurnOf;
  std::mutex Mutex; ///< Of what follows.
  std::condition_variable Changed;
  int Waiting = 0;
  long Phase = 0;
  std::exception_ptr Failure;
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
  int GetSize() const override { return this->Board.GetSize(); }
  std::vector<Message> Exchange(std::vector<Message> messages) override
  {
    return this->Board.Exchange(this->Rank, std::move(messages));
  }
  std::vector<Message> Gather(const Message& message) override
  {
    return this->Exchange(std::vector<Message>(this->GetSize(), message));
  }
  void Work(const std::function<void()>& work) override
  {
    std::mutex* turn = this->Board.GetTurn(this->Rank);
    const std::unique_lock<std::mutex> lock =
      turn ? std::unique_lock<std::mutex>(*turn) : std::unique_lock<std::mutex>();
    work();
  }

private:
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

void RunRank(MessageBoard& board, int rank, const std::function<void(PieceGroup&)>& work) noexcept
{
  try
  {
    ThreadGroup group(board, rank);
    work(group);
  }
  catch (const GroupBroken&)
  {
    // Another rank keeps the reason.
  }
  catch (...)
  {
    board.Break(std::current_exception());
  }
}
}

std::unique_ptr<PieceGroup> MakeSingleGroup()
{
  return std::unique_ptr<PieceGroup>(new SingleGroup);
}

void RunInThreads(
  int size, const std::function<void(PieceGroup&)>& work, const std::vector<int>& turnOf)
{
  MessageBoard board(size, turnOf);
  std::vector<std::thread> threads;
  try
  {
    for (int rank = 1; rank < size; ++rank)
    {
      threads.emplace_back(RunRank, std::ref(board), rank, std::cref(work));
    }
  }
  catch (...)
  {
    board.Break(std::current_exception()); // no more threads
  }
  RunRank(board, 0, work);
  for (std::thread& thread : threads)
  {
    thread.join();
  }
  if (board.GetFailure())
  {
    std::rethrow_exception(board.GetFailure());
  }
}

//------------------------------------------------------------------------------
namespace
{
/// Why work of a rank failed, as it is sent to the other ranks.
struct RankFailure
{
  char Kind = 0; ///< 0: it did not.
  std::string Text;
};

enum FailureKind : char
{
  None,
  Options,
  Mesh,
  Size,
  Backend,
  Memory,
  Abort,
  Other
};

[[noreturn]] void Throw(char kind, const std::string& text)
{
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
    case Abort:
      throw RunAborted();
    default:
      throw std::runtime_error(text);
  }
}

/// What the exception that is being handled means.
/// @throws std::bad_alloc if there is no memory for its text.
RankFailure ReadException()
{
  try
  {
    throw;
  }
  catch (const InvalidOptions& error)
  {
    return { Options, error.what() };
  }
  catch (const InvalidMesh& error)
  {
    return { Mesh, error.what() };
  }
  catch (const MeshTooLarge& error)
  {
    return { Size, error.what() };
  }
  catch (const BackendUnavailable& error)
  {
    return { Backend, error.what() };
  }
  catch (const RunAborted&)
  {
    return { Abort, "" };
  }
  catch (const std::bad_alloc&)
  {
    return { Memory, "" };
  }
  catch (const std::exception& error)
  {
    return { Other, error.what() };
  }
  catch (...)
  {
    return { Other, "an exception of unknown type" };
  }
}

/// A failure that takes memory to describe is described as one for want of memory.
RankFailure DescribeException()
{
  try
  {
    return ReadException();
  }
  catch (const std::bad_alloc&)
  {
    return { Memory, "" };
  }
}

/// Throws if a rank has failed: the exception of the first of these, which names it.
/// @param all what the ranks have sent: a text, and the kind of failure as the last character; or
/// nothing, for want of memory.
void ThrowFirst(const std::vector<Message>& all)
{
  bool isAborted = false;
  for (std::size_t rank = 0; rank < all.size(); ++rank)
  {
    const char kind = all[rank].empty() ? char(Memory) : all[rank].back();
    isAborted = isAborted || kind == Abort;
    if (kind != None && kind != Abort)
    {
      const std::string where = all.size() > 1 ? "rank " + std::to_string(rank) + ": " : "";
      Throw(kind,
        where +
          (kind == Memory ? "not enough memory"
                          : std::string(all[rank].begin(), all[rank].end() - 1)));
    }
  }
  if (isAborted)
  {
    throw RunAborted();
  }
}

/// Another group, whose ranks all learn of it if one of them fails between two calls.
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
      this->Tell({ Memory, "" }); // or a group above this one would think that all ranks know
      throw;
    }
    told = message;
    told.push_back(None);
    return this->Share(told);
  }
  void Work(const std::function<void()>& work) override { this->Group.Work(work); }

  /// Tells the other ranks that this one has failed, if they do not know. @throws as they do.
  void Tell(const RankFailure& failure)
  {
    if (!this->End)
    {
      this->Share(Pack(failure));
    }
  }

private:
  /// @returns an empty message if there is no memory for more.
  static Message Pack(const RankFailure& failure)
  {
    try
    {
      Message message(failure.Text.begin(), failure.Text.end());
      message.push_back(failure.Kind);
      return message;
    }
    catch (const std::bad_alloc&)
    {
      return {};
    }
  }

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
    told.Tell(DescribeException());
    throw;
  }
}

void DoTogether(PieceGroup& group, const std::function<void()>& work)
{
  const bool isWithin = dynamic_cast<ToldGroup*>(&group) != nullptr;
  const auto workAndWait = [&](PieceGroup& told)
  {
    told.Work(work);
    if (isWithin) // else RunTogether waits
    {
      told.Gather({});
    }
  };
  RunTogether(group, std::ref(workAndWait));
}

}
