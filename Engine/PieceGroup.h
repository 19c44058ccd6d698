// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PIECEGROUP_H
#define DELAUNAYFLIP_PIECEGROUP_H

#include "EngineExport.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

/// @file
/// The ranks that hold the pieces of one mesh send each other messages through a PieceGroup:
///
///     RunInThreads(2,
///       [](PieceGroup& group)
///       {
///         Message message;
///         Put(message, 10 * group.GetRank());
///         const std::vector<Message> all = group.Gather(message);
///         MessageReader(all[0]).Get<int>(); // 0
///         MessageReader(all[1]).Get<int>(); // 10
///       });

namespace delaunayflip
{

using Message = std::vector<char>;

/// Adds a value to a message, of a type that has the same bytes on all ranks.
template <typename Value>
void Put(Message& message, const Value& value)
{
  static_assert(std::is_trivially_copyable<Value>::value, "copied byte by byte");
  const char* bytes = reinterpret_cast<const char*>(&value);
  message.insert(message.end(), bytes, bytes + sizeof(value));
}
inline void Put(Message& message, const std::string& text)
{
  Put(message, static_cast<std::int64_t>(text.size()));
  message.insert(message.end(), text.begin(), text.end());
}
template <typename Value>
void Put(Message& message, const std::vector<Value>& values)
{
  Put(message, static_cast<std::int64_t>(values.size()));
  std::for_each(
    values.begin(), values.end(), [&message](const Value& value) { Put(message, value); });
}

/// Reads a message in the order in which it was written.
class MessageReader
{
public:
  explicit MessageReader(Message bytes)
    : Bytes(std::move(bytes))
  {
  }

  bool IsAtEnd() const { return this->At >= this->Bytes.size(); }
  void Read(char* bytes, std::int64_t count)
  {
    std::copy_n(this->Bytes.data() + this->At, count, bytes);
    this->At += count;
  }
  template <typename Value>
  void Get(Value& value)
  {
    this->Read(reinterpret_cast<char*>(&value), sizeof(value));
  }
  void Get(std::string& text)
  {
    text.resize(this->Get<std::int64_t>());
    this->Read(&text[0], static_cast<std::int64_t>(text.size()));
  }
  template <typename Value>
  void Get(std::vector<Value>& values)
  {
    values.resize(this->Get<std::int64_t>());
    std::for_each(values.begin(), values.end(), [this](Value& value) { this->Get(value); });
  }
  template <typename Value>
  Value Get()
  {
    Value value{};
    this->Get(value);
    return value;
  }

private:
  Message Bytes;
  std::size_t At = 0;
};

/// The ranks that hold the pieces of one mesh, as one of them sees it. A rank is a process, or a
/// thread of this process. All ranks must call Exchange and Gather the same number of times and in
/// the same order; both wait for the other ranks.
class DELAUNAYFLIP_EXPORT PieceGroup
{
public:
  virtual ~PieceGroup();

  /// The number of this rank, 0 to GetSize() - 1.
  virtual int GetRank() const = 0;
  virtual int GetSize() const = 0;

  /// Sends messages[r] to rank r, for every rank. @returns what the ranks have sent to this one, in
  /// their order.
  virtual std::vector<Message> Exchange(std::vector<Message> messages) = 0;

  /// Sends a message to all ranks. @returns those of all ranks, in their order.
  virtual std::vector<Message> Gather(const Message& message) = 0;

  /// Calls `work`, which may take long and needs no other rank. If ranks of the group share a
  /// device, the group calls it when it is this rank's turn.
  virtual void Work(const std::function<void()>& work) { work(); }
};

/// Calls work() on this rank, in its turn, and waits for the other ranks. `work` must call no
/// function of the group.
/// @throws on every rank, if work throws on one: what it throws there, with a text that names the
/// rank, as far as it is an exception of FlipError.h or RunAborted; else std::runtime_error.
DELAUNAYFLIP_EXPORT void DoTogether(PieceGroup& group, const std::function<void()>& work);

/// Calls work(group) on every rank, with a group that takes the place of this one. If a rank fails
/// outside of the group's functions, the others learn it at their next call of the group, or at the
/// end: no rank waits for it.
/// @throws as DoTogether.
DELAUNAYFLIP_EXPORT void RunTogether(
  PieceGroup& group, const std::function<void(PieceGroup&)>& work);

/// A group of one rank.
DELAUNAYFLIP_EXPORT std::unique_ptr<PieceGroup> MakeSingleGroup();

/// Calls work(group) in `size` threads, one for each rank of a group, and returns when all are
/// done. If one throws, the others stop at their next call of the group, and its exception leaves
/// this function.
/// @param turnOf the number of the turn, for example of the device, that a rank shares with others:
/// Work runs for one rank of a turn at a time. Empty: all ranks work at once.
DELAUNAYFLIP_EXPORT void RunInThreads(
  int size, const std::function<void(PieceGroup&)>& work, const std::vector<int>& turnOf = {});

}

#endif
