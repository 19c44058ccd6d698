// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PieceGroup.h"
#include "FlipError.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <chrono>
#include <functional>
#include <string>
#include <thread>

/// @file
/// Ranks that take turns, and that learn of each other's failures.

namespace delaunayflip
{
namespace
{

TEST(PieceGroup, RanksOfATurnWorkOneAfterTheOther)
{
  const std::vector<int> turnOf{ 0, 1, 0, 1, 0 };
  std::array<std::atomic<int>, 2> atWork{};
  std::atomic<int> most{ 0 };
  std::atomic<int> done{ 0 };
  RunInThreads(
    static_cast<int>(turnOf.size()),
    [&](PieceGroup& group)
    {
      std::atomic<int>& own = atWork[turnOf[group.GetRank()]];
      for (int round = 0; round < 4; ++round)
      {
        DoTogether(group,
          [&]()
          {
            const int now = ++own;
            most = std::max(most.load(), now);
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
            --own;
            ++done;
          });
      }
    },
    turnOf);
  EXPECT_EQ(1, most);
  EXPECT_EQ(20, done);
}

/// Rank 1 fails while the others do `others`. @returns how many ranks fail with its message.
int CountTold(const std::function<void(PieceGroup&)>& others)
{
  std::atomic<int> told{ 0 };
  RunInThreads(3,
    [&](PieceGroup& group)
    {
      try
      {
        RunTogether(group,
          [&](PieceGroup& one)
          {
            one.Gather({ 'x' });
            if (one.GetRank() == 1)
            {
              throw InvalidOptions("no such thing");
            }
            others(one);
          });
      }
      catch (const InvalidOptions& error)
      {
        told += error.what() == std::string("rank 1: no such thing") ? 1 : 0;
      }
    });
  return told;
}

TEST(PieceGroup, AFailureBetweenCallsIsToldWhateverOthersCall)
{
  EXPECT_EQ(3, CountTold([](PieceGroup& group) { group.Gather({ 'y', 'z' }); }));
  EXPECT_EQ(3, CountTold([](PieceGroup& group) { group.Exchange(std::vector<Message>(3)); }));
  EXPECT_EQ(3, CountTold([](PieceGroup& group) { DoTogether(group, []() {}); }));
  EXPECT_EQ(3, CountTold([](PieceGroup&) {}));
  EXPECT_EQ(3,
    CountTold(
      [](PieceGroup& group) { RunTogether(group, [](PieceGroup& same) { same.Gather({}); }); }));
}

TEST(PieceGroup, MessagesArriveAsSentWhereFailuresAreTold)
{
  RunInThreads(2,
    [](PieceGroup& group)
    {
      RunTogether(group,
        [](PieceGroup& told)
        {
          const auto own = static_cast<char>('a' + told.GetRank());
          EXPECT_EQ((std::vector<Message>{ { 'a' }, { 'b' } }), told.Gather({ own }));
          EXPECT_EQ((std::vector<Message>{ { 'a' }, { 'b' } }),
            told.Exchange(std::vector<Message>(2, Message{ own })));
          EXPECT_EQ(std::vector<Message>(2), told.Gather({}));
        });
    });
}

}
}
