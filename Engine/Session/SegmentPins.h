// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_SEGMENTPINS_H
#define DELAUNAYFLIP_SEGMENTPINS_H

#include "Outline.h"
#include "SegmentCrossings.h"

#include <array>
#include <cstdint>
#include <vector>

namespace delaunayflip
{

/// The edges that segments have become, which stay edges while points move.
class SegmentPins
{
public:
  /// Lists the edges. Called once.
  /// @param edges what all segments have become. @param ends two points for each of them.
  void List(const std::vector<SegmentEdge>& edges, const std::vector<std::int64_t>& ends,
    const std::vector<Segment>& segments);
  bool AreListed() const { return this->IsListed; }

  /// Each edge once.
  const std::vector<EdgeId>& GetEdges() const { return this->Edges; }

  /// Whether one of these points is on a segment, or an end of one. @param points ascending.
  bool HavePoint(const std::vector<VertexId>& points) const;

  /// Whether there are points on segments between their ends.
  bool HasBetween() const { return !this->Between.empty(); }
  /// Whether the points that were between the ends of segments are still on the lines through
  /// these.
  /// @param points in the host's memory, at different places.
  bool AreStraight(const PlaneArray& points) const;

  /// Gives the edges other numbers.
  /// @param changed by edge, in the order of GetEdges. Empty: none has changed.
  /// @param edges those of List.
  void Renumber(const std::vector<PinnedEdge>& changed, std::vector<SegmentEdge>& edges);

private:
  bool IsListed = false;
  std::vector<EdgeId> Edges;
  std::vector<std::uint32_t> PinOf; ///< By element of List's edges, an index of Edges.
  std::vector<std::int64_t> Points; ///< The points on segments, and their ends, ascending.
  /// The ends of a segment of several edges, and a point on it.
  std::vector<std::array<std::int64_t, 3>> Between;
};

}

#endif
