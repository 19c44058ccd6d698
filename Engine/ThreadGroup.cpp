// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PieceGroup.h"

#include <algorithm>
#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <utility>

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

}
