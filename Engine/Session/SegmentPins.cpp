// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SegmentPins.h"

#include "ExactPredicates.h"

#include <algorithm>
#include <unordered_map>

namespace delaunayflip
{

void SegmentPins::List(const std::vector<SegmentEdge>& edges, const std::vector<std::int64_t>& ends,
  const std::vector<Segment>& segments)
{
  std::unordered_map<EdgeId, std::uint32_t> pins;
  for (const SegmentEdge& edge : edges)
  {
    const auto next = static_cast<std::uint32_t>(this->Edges.size());
    const auto [found, isNew] = pins.emplace(EdgeOf(edge.Side), next);
    if (isNew)
    {
      this->Edges.push_back(found->first);
    }
    this->PinOf.push_back(found->second);
  }
  for (const Segment& segment : segments)
  {
    this->Points.push_back(segment.From);
    this->Points.push_back(segment.To);
  }
  for (std::size_t i = 1; i < edges.size(); ++i)
  {
    if (edges[i].Segment != edges[i - 1].Segment)
    {
      continue;
    }
    const Segment& segment = segments[edges[i].Segment];
    for (std::size_t end = 2 * i - 2; end < 2 * i + 2; ++end) // of both edges
    {
      this->Points.push_back(ends[end]);
      this->Between.push_back({ segment.From, ends[end], segment.To });
    }
  }
  std::sort(this->Points.begin(), this->Points.end());
  this->IsListed = true;
}

bool SegmentPins::HavePoint(const std::vector<VertexId>& points) const
{
  return std::any_of(points.begin(), points.end(),
    [&](VertexId point)
    { return std::binary_search(this->Points.begin(), this->Points.end(), std::int64_t(point)); });
}

bool SegmentPins::AreStraight(const PlaneArray& points) const
{
  const auto get = [&](std::int64_t point) {
    return PlanePoint{ points.Get(point, 0), points.Get(point, 1), 0.0 };
  };
  return std::all_of(this->Between.begin(), this->Between.end(),
    [&](const auto& line)
    { return FindOrientation(get(line[0]), get(line[1]), get(line[2])) == 0; });
}

void SegmentPins::Renumber(const std::vector<PinnedEdge>& changed, std::vector<SegmentEdge>& edges)
{
  if (changed.empty())
  {
    return;
  }
  for (std::size_t i = 0; i < changed.size(); ++i)
  {
    this->Edges[i] = EdgeOf(changed[i].Side);
  }
  for (std::size_t i = 0; i < edges.size(); ++i)
  {
    const PinnedEdge& pinned = changed[this->PinOf[i]];
    SegmentEdge& edge = edges[i];
    edge.Side = pinned.Side ^ (edge.Side & 1u);
    edge.IsOnBoundary = pinned.IsOnHull != 0;
    const bool hasNoTriangle = edge.IsOnBoundary && edge.Side % 2 != 0;
    if (hasNoTriangle)
    {
      edge.Side ^= 1u;
      edge.IsOnLeft = !edge.IsOnLeft;
    }
  }
}

}
