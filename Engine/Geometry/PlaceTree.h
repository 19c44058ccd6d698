// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PLACETREE_H
#define DELAUNAYFLIP_PLACETREE_H

#include "FilteredPredicates.h"

#include <array>
#include <cstdint>
#include <vector>

namespace delaunayflip
{

using PlaneVector = std::array<double, 2>;

/// Points of the plane that are removed one by one, and a search for one of them in a triangle.
///
/// Points with equal coordinates share a place, so a search visits them once, however many there
/// are. All points with a NaN or infinite coordinate share one more place, which lies in every
/// triangle.
///
/// A k-d tree that is balanced from the start. A node has the bounding box of the places that are
/// left and, if these are nearly in line, a slim rectangle in that direction, because long thin
/// triangles along thin chains meet most boxes. Both are fitted again as places are removed.
class PlaceTree
{
public:
  static constexpr std::int64_t NoPlace = -1;

  explicit PlaceTree(const std::vector<PlaneVector>& points);

  /// Places are numbered from 0.
  std::int64_t GetNumberOfPlaces() const { return this->GetElsewhere() + 1; }

  std::int64_t GetPlace(std::int64_t point) const { return this->PlaceOf[point]; }

  /// @returns whether it was the last point of its place.
  bool Remove(std::int64_t point);

  /// A place that has points left and lies in the closed triangle but not at a corner, or NoPlace.
  /// If there are several, one of them, scattered so that it is seldom the next to be removed.
  /// @param corners three points that turn left.
  std::int64_t FindInside(const std::array<std::int64_t, 3>& corners) const;

  /// The number of nodes that all searches have visited, as a measure of time.
  std::int64_t GetVisits() const { return this->Visits; }

private:
  static constexpr std::int64_t LeafSize = 8;

  struct Box
  {
    PlanePoint Lower, Upper;
  };
  using Rectangle = std::array<PlanePoint, 4>; ///< Counter-clockwise.

  struct Node
  {
    Box Bounds;
    bool IsSlim; ///< Whether it has a Hull.
    Rectangle Hull; ///< A rectangle that is much slimmer than the box.
    std::int64_t PlacesLeft;
    std::int64_t PlacesAtFit; ///< Places that were left when it was fitted.
  };

  /// A node with its places, [Begin, End). Its children are 2 * Index and 2 * Index + 1.
  struct NodeRange
  {
    std::int64_t Index, Begin, End;

    bool IsLeaf() const { return this->End - this->Begin <= LeafSize; }
    std::int64_t GetMiddle() const { return (this->Begin + this->End) / 2; }
    NodeRange GetLeft() const { return { 2 * this->Index, this->Begin, this->GetMiddle() }; }
    NodeRange GetRight() const { return { 2 * this->Index + 1, this->GetMiddle(), this->End }; }
  };

  struct Triangle
  {
    std::array<std::int64_t, 3> Places;
    std::array<PlanePoint, 3> Corners; ///< Scaled.
    Box Bounds;
  };

  /// Where the places of a node lie relative to a triangle.
  enum class Meeting
  {
    Outside,
    Partly,
    Inside
  };

  std::int64_t GetElsewhere() const { return static_cast<std::int64_t>(this->Places.size()); }
  NodeRange GetRoot() const { return { 1, 0, this->GetElsewhere() }; }

  void FindPlaces(const std::vector<PlaneVector>& points);
  void Scale();
  void Order(const NodeRange& range, std::vector<std::int64_t>& order) const;
  void Reorder(const std::vector<std::int64_t>& order);
  void MakeNodes(const NodeRange& range);
  void Fit(const NodeRange& range);
  void FitSlimRectangle(const NodeRange& range, const PlanePoint& first, const PlanePoint& last);
  void RemovePlace(std::int64_t place);

  /// Calls work with the scaled places of a node that are left.
  template <typename Work>
  void ForPlaces(const NodeRange& range, const Work& work) const
  {
    for (std::int64_t i = range.Begin; i < range.End; ++i)
    {
      if (this->PointsLeft[i] > 0)
      {
        work(this->Scaled[i]);
      }
    }
  }

  std::uint64_t Scatter() const
  {
    return static_cast<std::uint64_t>(this->Visits) * 0x9E3779B97F4A7C15u;
  }
  std::int64_t Search(const NodeRange& range, const Triangle& triangle) const;
  std::int64_t PickPlace(NodeRange range) const;
  std::int64_t SearchLeaf(const NodeRange& range, const Triangle& triangle) const;
  Meeting Meet(const Node& node, const Triangle& triangle) const;
  bool IsInside(std::int64_t place, const Triangle& triangle) const;

  std::vector<PlaneVector> Places; ///< In the order of the leaves.
  std::vector<PlanePoint> Scaled; ///< The same near 1, for filters.
  std::vector<std::int64_t> PointsLeft; ///< Of every place.
  std::vector<std::int64_t> PlaceOf; ///< Of every point.
  std::vector<Node> Nodes;
  mutable std::int64_t Visits = 0;
};

}

#endif
