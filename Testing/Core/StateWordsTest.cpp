// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "EdgeWorklist.h"

#include <gtest/gtest.h>

#include <random>

namespace
{
using namespace delaunayflip;

TEST(StateWords, MatchStatesFindsEveryRange)
{
  // More values than there are states, of which Candidate is the last.
  constexpr int NumberOfStates = 16;
  static_assert(static_cast<int>(EdgeState::Candidate) < NumberOfStates);
  std::mt19937 random(5);
  for (int repetition = 0; repetition < 100; ++repetition)
  {
    // Words are read at multiples of 64 states.
    alignas(64) EdgeState states[StatesPerSet];
    for (EdgeState& state : states)
    {
      state = static_cast<EdgeState>(random() % NumberOfStates);
    }
    const auto last = static_cast<int>(random() % NumberOfStates);
    const auto first = static_cast<int>(random() % (last + 1));
    std::uint64_t expected = 0;
    for (int i = 0; i < StatesPerSet; ++i)
    {
      const auto state = static_cast<int>(states[i]);
      expected |= std::uint64_t(first <= state && state <= last ? 1 : 0) << i;
    }
    EXPECT_EQ(expected,
      MatchStates(states, { static_cast<EdgeState>(first), static_cast<EdgeState>(last) }));
  }
}

}
