// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "RingDirections.h"

#include "FlipError.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>

namespace delaunayflip
{

namespace
{
using SegmentsByPlace = std::map<std::int64_t, std::vector<std::size_t>>;

/// Walks along the segments of a ring, each once, and turns those that are met at their end.
/// @param waiting the segments at each place, which is used up.
void WalkRing(const std::vector<std::size_t>& ring, const std::vector<std::int64_t>& used,
  SegmentsByPlace& waiting, std::vector<Segment>& segments)
{
  for (auto& [place, indices] : waiting)
  {
    std::reverse(indices.begin(), indices.end()); // the first ones are taken first
  }
  std::set<std::size_t> taken;
  for (const std::size_t first : ring)
  {
    std::int64_t place = used[segments[first].From];
    waiting[place].push_back(first);
    while (!waiting[place].empty())
    {
      const std::size_t i = waiting[place].back();
      waiting[place].pop_back();
      if (taken.insert(i).second)
      {
        Segment& segment = segments[i];
        if (used[segment.From] != place)
        {
          std::swap(segment.From, segment.To);
        }
        place = used[segment.To];
      }
    }
  }
}
}

void TurnSegments(const std::vector<std::size_t>& ring, const std::vector<std::int64_t>& used,
  std::vector<Segment>& segments)
{
  std::map<std::int64_t, std::int64_t> surplus; // by place, the ends minus the beginnings there
  SegmentsByPlace waiting;
  for (const std::size_t i : ring)
  {
    const Segment& segment = segments[i];
    const std::int64_t from = used[segment.From], to = used[segment.To];
    surplus[from] -= 1;
    surplus[to] += 1;
    if (from != to)
    {
      waiting[from].push_back(i);
      waiting[to].push_back(i);
    }
  }
  for (const std::size_t i : ring)
  {
    const Segment& segment = segments[i];
    for (const std::int64_t point : { segment.From, segment.To })
    {
      if (waiting[used[point]].size() % 2 != 0)
      {
        throw InvalidMesh("ring " + std::to_string(segment.Ring) + " is not closed at point " +
            std::to_string(point) + ": close it, or make its segments part of no ring",
          segment.Number, point, segment.Ring);
      }
    }
  }
  const bool isOneWay =
    std::all_of(surplus.begin(), surplus.end(), [](const auto& item) { return item.second == 0; });
  if (!isOneWay)
  {
    WalkRing(ring, used, waiting, segments);
  }
}

}
