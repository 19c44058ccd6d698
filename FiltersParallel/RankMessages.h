// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef RankMessages_h
#define RankMessages_h

#include "PieceFlip.h"

#include "vtkType.h"

#include <cstring>
#include <functional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

class vtkDataSetAttributes;

/// @file
/// What ranks tell each other. All ranks must call each function together.

namespace delaunayflip
{

/// Adds a number to a message, of a type that has the same bytes on all ranks.
template <typename Number>
void Put(Message& message, Number number)
{
  static_assert(!std::is_base_of<std::string, Number>::value, "a text");
  const char* bytes = reinterpret_cast<const char*>(&number);
  message.insert(message.end(), bytes, bytes + sizeof(number));
}
inline void Put(Message& message, const std::string& text)
{
  Put(message, static_cast<std::int64_t>(text.size()));
  message.insert(message.end(), text.begin(), text.end());
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
  template <typename Number>
  Number Get()
  {
    Number number;
    this->Read(reinterpret_cast<char*>(&number), sizeof(number));
    return number;
  }
  void Read(char* bytes, std::int64_t count)
  {
    std::memcpy(bytes, this->Bytes.data() + this->At, count);
    this->At += count;
  }
  std::string GetText()
  {
    const auto size = this->Get<std::int64_t>();
    this->At += size;
    return std::string(this->Bytes.data() + this->At - size, size);
  }

private:
  Message Bytes;
  std::size_t At = 0;
};

/// Sends a message to all ranks. @returns those of all ranks, one behind the other.
MessageReader GatherAll(const Message& message, PieceGroup& group);

bool IsOnAnyRank(bool flag, PieceGroup& group);

/// Brings the data of points or cells from the ranks that have them.
/// @param origins what to bring. @param given the data of this rank.
/// @param tupleOf the tuple of `given` for an id of an origin.
/// @param result receives one tuple for each origin in every array that `given` has. Where `given`
/// has no arrays at all, because the rank's piece is empty, it gets those of the others. Values
/// that the other rank does not have are 0 or empty.
void BringTuples(const std::vector<PieceOrigin>& origins, vtkDataSetAttributes* given,
  const std::function<vtkIdType(std::int64_t)>& tupleOf, PieceGroup& group,
  vtkDataSetAttributes* result);

}

#endif
