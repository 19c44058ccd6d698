// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_SPHERESEGMENTS_H
#define DELAUNAYFLIP_SPHERESEGMENTS_H

#include "SphereStart.h"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

/// @file
/// Segments along great circles, in triangles that face away from the origin.
///
/// Seen from the origin a great circle is a line, and triangles that face away do not overlap. So
/// everything is as in the plane: a point is to the left of a segment if the segment's ends, the
/// point and the origin have a positive orientation. All signs are exact.

namespace delaunayflip
{

/// Whether two places are in opposite directions from the origin, except for rounding: then a great
/// circle through both may run anywhere.
/// @param rounding how much the directions may be off, e.g. some units of the last place.
bool AreOpposite(const PlanePoint& a, const PlanePoint& b, double rounding);

/// An edge that a segment has become, or a part of it.
struct SphereEdge
{
  std::int32_t From, To; ///< Points; the direction is that of the segment.
  std::int32_t Segment; ///< The index of its segment.
  bool IsFirst; ///< Whether no segment before has become the same edge.
};

/// Makes segments edges of a mesh, one after the other.
class SphereSegments
{
public:
  /// @param triangles all face away from the origin. They cover the sphere, or a part of it that
  /// every great circle enters at most once.
  /// @param neighbors as FindNeighbors lists them; not needed afterwards.
  SphereSegments(const SpacePoints& points, const std::vector<std::int32_t>& neighbors,
    std::vector<std::int32_t>& triangles);

  /// What has become of a segment.
  enum class OutcomeKind
  {
    Inserted,
    Crosses, ///< It crosses a segment that was inserted before. Nothing is changed.
    HasNoTriangle ///< An end has none, or the segment leaves the mesh. Nothing is changed.
  };

  /// Inserts a segment that is shorter than half a great circle. The triangles that it crosses
  /// are replaced. The new ones are not Delaunay yet.
  OutcomeKind Insert(std::int32_t from, std::int32_t to, std::int32_t segment);

  /// All edges of segments, in the order of the segments.
  const std::vector<SphereEdge>& GetEdges() const { return this->Edges; }
  /// The first one of the segments that the last segment crosses.
  std::int32_t GetCrossed() const { return this->Crossed; }
  /// How many edges were replaced.
  std::int64_t CountReplaced() const { return this->Replaced; }

private:
  /// A part of a segment between two vertices.
  struct Stretch
  {
    std::int32_t From, To;
    std::vector<std::int32_t> Crossing; ///< The corners opposite to the edges that it crosses.
  };
  /// A side of the channel, and what is behind it.
  struct RimSide
  {
    std::int32_t From, To;
    std::int32_t Twin; ///< None if the other side belongs to the channel, too, or to nothing.
    std::int32_t Segment;
  };
  /// A side of a new triangle.
  struct NewSide
  {
    std::int32_t From, To;
    std::int32_t Corner; ///< The one opposite to it.
  };
  struct Departure
  {
    std::int32_t Corner; ///< Opposite to the edge that is crossed first or followed; or None.
    std::int32_t Vertex; ///< Where the edge ends that is followed; or None.
  };

  static constexpr std::int32_t None = -1;
  static std::int32_t Next(std::int32_t corner)
  {
    return corner % 3 == 2 ? corner - 2 : corner + 1;
  }
  static std::int32_t Previous(std::int32_t corner)
  {
    return corner % 3 == 0 ? corner + 2 : corner - 1;
  }

  int FindSide(std::int32_t from, std::int32_t to, std::int32_t point) const;
  Departure LookAt(std::int32_t corner, std::int32_t to) const;
  std::int32_t Turn(std::int32_t corner, bool isClockwise) const;
  Departure Depart(std::int32_t from, std::int32_t to) const;
  bool Walk(std::int32_t from, std::int32_t to);
  bool WalkStretch(std::int32_t from, std::int32_t to);
  void Note(std::int32_t corner, std::int32_t from, std::int32_t to, std::int32_t segment);
  void Replace(const Stretch& stretch, std::int32_t segment);
  void TakeRim(const Stretch& stretch);
  void Fill(const std::vector<std::int32_t>& chain);
  void Connect(const Stretch& stretch, std::int32_t segment);

  const SpacePoints& Points;
  std::vector<std::int32_t>& Triangles;
  std::vector<std::int32_t> Twins; ///< By corner: the one opposite to the same edge, or None.
  std::vector<std::int32_t> SegmentOf; ///< By corner, the first segment on the edge opposite to it.
  std::vector<std::int32_t> CornerOf; ///< By point: a corner, or None.
  std::vector<SphereEdge> Edges;
  std::int32_t Crossed = None;
  std::int64_t Replaced = 0;

  // What is known of the segment that is inserted.
  std::vector<Stretch> Stretches;
  std::vector<std::int32_t> Channel; ///< Its triangles.
  std::vector<std::int32_t> Left, Right; ///< Vertices of the channel, from one end to the other.
  std::vector<RimSide> Rim;
  std::vector<std::int32_t> Made; ///< New triangles.
};

}

#endif
