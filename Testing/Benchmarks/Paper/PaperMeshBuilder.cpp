// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PaperMeshBuilder.h"

#include "Atomics.h"

namespace delaunayflip
{
namespace
{

/// The edge opposite to a corner, as an entry in the list of its end with the smaller id.
struct PairedCorner
{
  std::int32_t Larger; ///< The end with the larger id.
  std::int32_t Corner;
  bool Rises; ///< Whether the triangle runs from the smaller end to the larger.
};

class TwinFinder
{
public:
  TwinFinder(
    const std::vector<std::int32_t>& triangles, std::int64_t points, const ThreadBackend& threads)
    : Triangles(triangles),
      Points(points),
      Threads(threads),
      Starts(points + 1, 0),
      Corners(triangles.size()),
      Twins(triangles.size(), -1)
  {
  }

  std::vector<std::int32_t> Find()
  {
    this->GroupBySmallerEnd();
    this->Threads.ForEach(this->Points, [this](std::int64_t vertex) { this->PairAt(vertex); });
    return std::move(this->Twins);
  }

private:
  std::int32_t From(std::int64_t c) const
  {
    return this->Triangles[NextCorner(static_cast<std::int32_t>(c))];
  }
  std::int32_t To(std::int64_t c) const
  {
    return this->Triangles[PreviousCorner(static_cast<std::int32_t>(c))];
  }

  void GroupBySmallerEnd()
  {
    const auto corners = static_cast<std::int64_t>(this->Triangles.size());
    this->Threads.ForEach(corners,
      [this](std::int64_t c)
      { AtomicAdd(&this->Starts[std::min(this->From(c), this->To(c))], 1u); });
    std::uint32_t end = 0;
    for (std::uint32_t& start : this->Starts)
    {
      end += start;
      start = end;
    }
    this->Threads.ForEach(corners,
      [this](std::int64_t c)
      {
        const std::uint32_t place =
          AtomicAdd(&this->Starts[std::min(this->From(c), this->To(c))], ~0u) - 1;
        this->Corners[place] = static_cast<std::int32_t>(c);
      });
  }

  void PairAt(std::int64_t vertex)
  {
    const auto begin = static_cast<std::int32_t>(this->Starts[vertex]);
    std::vector<PairedCorner> around;
    for (std::uint32_t i = begin; i < this->Starts[vertex + 1]; ++i)
    {
      const std::int32_t c = this->Corners[i];
      around.push_back({ std::max(this->From(c), this->To(c)), c, this->From(c) < this->To(c) });
    }
    std::sort(around.begin(), around.end(),
      [](const PairedCorner& c, const PairedCorner& d) { return c.Larger < d.Larger; });
    for (std::size_t i = 0, next = 0; i < around.size(); i = next)
    {
      while (next < around.size() && around[next].Larger == around[i].Larger)
      {
        ++next;
      }
      const PairedCorner& c = around[i];
      const PairedCorner& d = around[next - 1];
      if (next == i + 2 && c.Rises != d.Rises)
      {
        this->Twins[c.Corner] = d.Corner;
        this->Twins[d.Corner] = c.Corner;
      }
    }
  }

  const std::vector<std::int32_t>& Triangles;
  std::int64_t Points;
  const ThreadBackend& Threads;
  std::vector<std::uint32_t> Starts; ///< By vertex: where its corners begin.
  std::vector<std::int32_t> Corners; ///< Grouped by the smaller end of their edge.
  std::vector<std::int32_t> Twins;
};

}

std::vector<std::int32_t> FindTwinCorners(
  const std::vector<std::int32_t>& triangles, std::int64_t points, const ThreadBackend& threads)
{
  return TwinFinder(triangles, points, threads).Find();
}

}
