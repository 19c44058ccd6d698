// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "IdSet.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <set>
#include <vector>

using namespace delaunayflip;

TEST(IdSet, ListsIdsInTheirOrder)
{
  constexpr std::int64_t Size = 3 * 4096 + 1;
  IdSet set;
  set.Resize(Size);
  std::mt19937 random(1);
  for (const int ids : { 0, 1, 10, 3000, 50000 })
  {
    std::set<std::int64_t> expected{ Size - 1 };
    set.Add(Size - 1);
    for (int i = 0; i < ids; ++i)
    {
      const auto id = static_cast<std::int64_t>(random() % Size);
      EXPECT_EQ(expected.count(id) > 0, set.Has(id));
      expected.insert(id);
      set.Add(id);
    }
    EXPECT_EQ(
      std::vector<std::int64_t>(expected.begin(), expected.end()), set.List<std::int64_t>());
    set.Clear();
    EXPECT_TRUE(set.List<std::int64_t>().empty());
  }
}

TEST(IdSet, KeepsItsIdsWhenItGrows)
{
  IdSet set;
  set.Resize(1);
  set.Add(0);
  set.Resize(100000);
  EXPECT_TRUE(set.Has(0));
  set.Add(99999);
  EXPECT_EQ((std::vector<std::int32_t>{ 0, 99999 }), set.List<std::int32_t>());
}
