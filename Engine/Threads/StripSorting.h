// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_STRIPSORTING_H
#define DELAUNAYFLIP_STRIPSORTING_H

#include "Strips.h"
#include "ThreadBackend.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace delaunayflip
{

/// Puts the points into their strips, and then sorts every strip, which fits a cache.
template <typename Real>
struct StripSorter<Real, ThreadBackend>
{
  struct Item
  {
    Real X, Y;
    VertexId Id;

    bool operator<(const Item& other) const
    {
      return this->X != other.X ? this->X < other.X
                                : (this->Y != other.Y ? this->Y < other.Y : this->Id < other.Id);
    }
  };

  static StripPoints<Real> Sort(
    const PlaneArray& points, const StripBounds& bounds, const ThreadBackend& backend)
  {
    StripPoints<Real> sorted;
    sorted.Strips = bounds.CountStrips();
    const StripFinder findStrip = bounds.View();
    const auto unused = static_cast<std::uint32_t>(sorted.Strips); // not finite
    Array<std::uint32_t> stripOf = backend.MakeArray<std::uint32_t>(points.Count);
    backend.ForEach(points.Count,
      [&](std::int64_t i)
      { stripOf[i] = IsFinitePoint(points, i) ? findStrip(points.Get(i, 1)) : unused; });
    Array<Item> items = backend.MakeArray<Item>(points.Count);
    // The points of a range go to places all over the array. So that not the first ranges wait for
    // all of its memory, and an observer for them, it is touched before.
    backend.TouchPages(items.Data(), points.Count * static_cast<std::int64_t>(sizeof(Item)));
    const std::vector<std::uint32_t> starts = backend.PlaceByDigit(
      points.Count, unused + 1, [&](std::int64_t i) { return stripOf[i]; },
      [&](std::int64_t i, std::uint32_t place)
      {
        items[place] = { static_cast<Real>(points.Get(i, 0)), static_cast<Real>(points.Get(i, 1)),
          static_cast<VertexId>(i) };
      });
    sorted.Count = starts[unused];
    sorted.Starts = backend.MakeArray<std::uint32_t>(sorted.Strips + 1);
    std::copy_n(starts.begin(), sorted.Strips + 1, sorted.Starts.Data());
    sorted.Coordinates = backend.MakeArray<Real>(2 * sorted.Count);
    CoordinatePair<Real>* sortedPlaces = sorted.Places();
    sorted.Ids = backend.MakeArray<VertexId>(sorted.Count);
    const auto store = [&](const Item* first, const Item* last)
    {
      for (const Item* item = first; item < last; ++item)
      {
        sortedPlaces[item - items.Data()] = { item->X, item->Y };
        sorted.Ids[item - items.Data()] = item->Id;
      }
    };
    const std::int64_t stripGrain =
      std::max<std::int64_t>(1, 4096 * sorted.Strips / (sorted.Count + 1));
    backend.ForRange(
      sorted.Strips,
      [&](std::int64_t begin, std::int64_t end)
      {
        for (std::int64_t strip = begin; strip < end; ++strip)
        {
          SortStrip(items.Data() + sorted.Starts[strip], items.Data() + sorted.Starts[strip + 1],
            store, backend);
        }
      },
      stripGrain);
    return sorted;
  }

  /// Calls store(first, last) with sorted items. One strip may have most of the points, as where
  /// these lie along a line.
  template <typename Store>
  static void SortStrip(Item* first, Item* last, const Store& store, const ThreadBackend& backend)
  {
    constexpr std::int64_t Most = 1 << 16;
    if (last - first <= Most)
    {
      std::sort(first, last);
      store(first, last);
      return;
    }
    Item* const middle = first + (last - first) / 2;
    // A task, so that an observer is asked after it.
    backend.ForTasks(1, [&](std::int64_t) { std::nth_element(first, middle, last); });
    backend.ForTasks(2,
      [&](std::int64_t half)
      { SortStrip(half == 0 ? first : middle, half == 0 ? middle : last, store, backend); });
  }
};

}

#endif
