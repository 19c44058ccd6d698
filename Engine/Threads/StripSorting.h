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
    const std::int64_t strips = bounds.CountStrips();
    // So that there are not more counters than points, however many strips there are.
    const std::int64_t grain = std::max<std::int64_t>(1 << 16, strips);
    const std::int64_t pieces = (points.Count + grain - 1) / grain;
    const StripFinder findStrip = bounds.View();
    const std::uint32_t unused = static_cast<std::uint32_t>(strips); // not finite
    Array<std::uint32_t> stripOf = backend.MakeArray<std::uint32_t>(points.Count);
    std::vector<std::uint32_t> next(pieces * strips, 0);
    backend.ForRange(
      points.Count,
      [&](std::int64_t begin, std::int64_t end)
      {
        std::uint32_t* counts = &next[begin / grain * strips];
        for (std::int64_t i = begin; i < end; ++i)
        {
          stripOf[i] = IsFinitePoint(points, i) ? findStrip(points.Get(i, 1)) : unused;
          if (stripOf[i] != unused)
          {
            ++counts[stripOf[i]];
          }
        }
      },
      grain);

    StripPoints<Real> sorted;
    sorted.Starts = backend.MakeArray<std::uint32_t>(strips + 1);
    std::uint32_t start = 0;
    for (std::int64_t strip = 0; strip < strips; ++strip)
    {
      sorted.Starts[strip] = start;
      for (std::int64_t piece = 0; piece < pieces; ++piece)
      {
        const std::uint32_t items = next[piece * strips + strip];
        next[piece * strips + strip] = start;
        start += items;
      }
    }
    sorted.Starts[strips] = start;
    sorted.Strips = strips;
    sorted.Count = start;

    Array<Item> items = backend.MakeArray<Item>(start);
    // The points of a range go to places all over the array. So that not the first ranges wait for
    // all of its memory, and an observer for them, it is touched before.
    constexpr std::int64_t ItemsPerPage = 4096 / sizeof(Item);
    backend.ForRange(
      start / ItemsPerPage,
      [&](std::int64_t begin, std::int64_t end)
      {
        for (std::int64_t page = begin; page < end; ++page)
        {
          items[page * ItemsPerPage].Id = 0;
        }
      },
      64);
    backend.ForRange(
      points.Count,
      [&](std::int64_t begin, std::int64_t end)
      {
        std::uint32_t* places = &next[begin / grain * strips];
        for (std::int64_t i = begin; i < end; ++i)
        {
          if (stripOf[i] != unused)
          {
            items[places[stripOf[i]]++] = { static_cast<Real>(points.Get(i, 0)),
              static_cast<Real>(points.Get(i, 1)), static_cast<VertexId>(i) };
          }
        }
      },
      grain);
    SortStrips(items, sorted, backend);
    return sorted;
  }

private:
  static void SortStrips(
    Array<Item>& items, StripPoints<Real>& sorted, const ThreadBackend& backend)
  {
    sorted.Coordinates = backend.MakeArray<Real>(2 * sorted.Count);
    CoordinatePair<Real>* sortedPlaces = sorted.Places();
    sorted.Ids = backend.MakeArray<VertexId>(sorted.Count);
    const std::int64_t stripGrain =
      std::max<std::int64_t>(1, 4096 * sorted.Strips / (sorted.Count + 1));
    backend.ForRange(
      sorted.Strips,
      [&](std::int64_t begin, std::int64_t end)
      {
        for (std::int64_t strip = begin; strip < end; ++strip)
        {
          std::sort(items.Data() + sorted.Starts[strip], items.Data() + sorted.Starts[strip + 1]);
        }
        for (std::uint32_t i = sorted.Starts[begin]; i < sorted.Starts[end]; ++i)
        {
          sortedPlaces[i] = { items[i].X, items[i].Y };
          sorted.Ids[i] = items[i].Id;
        }
      },
      stripGrain);
  }
};

}

#endif
