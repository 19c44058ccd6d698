// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_RECORDS_H
#define DELAUNAYFLIP_RECORDS_H

#include "PieceFlip.h"
#include "PieceGroup.h"

#include <algorithm>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

/// @file
/// Ranks send each other messages made of records, which are plain structs with the same memory
/// layout on all ranks.

namespace delaunayflip
{

template <typename Record>
using RecordLists = std::vector<std::vector<Record>>; ///< One list per rank.

template <typename Record>
Message Pack(const std::vector<Record>& records)
{
  static_assert(std::is_trivially_copyable<Record>::value, "records are copied byte by byte");
  const auto* bytes = reinterpret_cast<const char*>(records.data());
  return Message(bytes, bytes + records.size() * sizeof(Record));
}

template <typename Record>
RecordLists<Record> Unpack(const std::vector<Message>& messages)
{
  RecordLists<Record> lists;
  for (const Message& message : messages)
  {
    lists.emplace_back(message.size() / sizeof(Record));
    std::copy(message.begin(), message.end(), reinterpret_cast<char*>(lists.back().data()));
  }
  return lists;
}

/// Sends toRank[r] to each rank r. @returns the records from each rank.
template <typename Record>
RecordLists<Record> ExchangeRecords(PieceGroup& group, const RecordLists<Record>& toRank)
{
  std::vector<Message> messages;
  for (const std::vector<Record>& records : toRank)
  {
    messages.push_back(Pack(records));
  }
  return Unpack<Record>(group.Exchange(std::move(messages)));
}

template <typename Record>
RecordLists<Record> GatherRecords(PieceGroup& group, const std::vector<Record>& records)
{
  return Unpack<Record>(group.Gather(Pack(records)));
}

/// Numbers for the items of all ranks: those of the first rank come first.
struct RankNumbers
{
  RankNumbers() = default;
  /// @param count of the items of this rank. All ranks must call this together.
  RankNumbers(std::int64_t count, PieceGroup& group)
  {
    for (const auto& counts : GatherRecords(group, std::vector<std::int64_t>{ count }))
    {
      this->Firsts.push_back(this->Firsts.back() + counts.front());
    }
  }

  /// The rank that has an item, and its number there.
  PieceOrigin Find(std::int64_t number) const
  {
    const auto after = std::upper_bound(this->Firsts.begin(), this->Firsts.end(), number);
    const auto rank = static_cast<std::int32_t>(after - this->Firsts.begin() - 1);
    return { rank, number - this->Firsts[rank] };
  }

  std::vector<std::int64_t> Firsts{ 0 }; ///< One per rank, and at the end the number of all.
};

/// The sum of a value over all ranks, by operator+= in the order of the ranks.
template <typename Value>
Value SumOverRanks(PieceGroup& group, const Value& value)
{
  Value sum{};
  for (const std::vector<Value>& part : GatherRecords(group, std::vector<Value>{ value }))
  {
    sum += part.front();
  }
  return sum;
}

/// Whether something is true on at least one rank.
inline bool IsOnAnyRank(PieceGroup& group, bool isHere)
{
  return SumOverRanks(group, std::int64_t(isHere)) > 0;
}

/// Returns, for each value, the largest of all ranks.
template <typename Value>
std::vector<Value> FindMaxima(PieceGroup& group, std::vector<Value> values)
{
  for (const std::vector<Value>& others : GatherRecords(group, values))
  {
    std::transform(others.begin(), others.end(), values.begin(), values.begin(),
      [](Value a, Value b) { return std::max(a, b); });
  }
  return values;
}

/// The records of all ranks in one list, by rank.
template <typename Record>
std::vector<Record> Join(const RecordLists<Record>& lists)
{
  std::vector<Record> all;
  for (const std::vector<Record>& list : lists)
  {
    all.insert(all.end(), list.begin(), list.end());
  }
  return all;
}

/// Calls visit(begin, end) for every run of consecutive items that are the same as its first.
template <typename Item, typename IsSame, typename Visit>
void ForEachRun(std::vector<Item>& items, const IsSame& isSame, const Visit& visit)
{
  for (auto begin = items.begin(); begin != items.end();)
  {
    const auto end = std::find_if_not(
      begin + 1, items.end(), [&](const Item& item) { return isSame(*begin, item); });
    visit(&*begin, &*begin + (end - begin));
    begin = end;
  }
}

/// A hash of a number. Each bit of the hash depends on all bits of the number.
inline std::uint64_t ScatterBits(std::uint64_t bits)
{
  bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9u;
  bits = (bits ^ (bits >> 27)) * 0x94d049bb133111ebu;
  return bits ^ (bits >> 31);
}

/// The home of a point or an edge with this hash: the rank that collects what all ranks know of it.
inline int GetHome(std::uint64_t hash, const PieceGroup& group)
{
  return static_cast<int>(hash % static_cast<std::uint64_t>(group.GetSize()));
}

}

#endif
