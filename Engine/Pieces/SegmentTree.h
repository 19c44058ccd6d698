// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_SEGMENTTREE_H
#define DELAUNAYFLIP_SEGMENTTREE_H

#include "FilteredPredicates.h"

#include <array>
#include <cstdint>
#include <vector>

namespace delaunayflip
{

/// Finds the segments in a plane that touch a triangle. W is ignored.
///
/// The segments are in a tree of bounding boxes. Long ones are cut into parts to make the boxes
/// small.
class SegmentTree
{
public:
  using Segment = std::array<PlanePoint, 2>;
  using Triangle = std::array<PlanePoint, 3>;

  /// Segments with a coordinate that is NaN or infinite touch nothing.
  explicit SegmentTree(const std::vector<Segment>& segments);

  /// Lists the segments that touch a closed triangle with finite corners, ascending. The list is
  /// exact if the triangle has a positive area; otherwise it may have a few more segments nearby.
  void FindTouched(const Triangle& triangle, std::vector<std::int32_t>& touched) const;

private:
  struct Box
  {
    double LowerU, UpperU, LowerV, UpperV;

    static Box Of(const PlanePoint* points, int count);
    void Add(const Box& other);
    bool Meets(const Box& other) const;
  };
  struct Part
  {
    Box Bounds;
    std::int32_t Segment;
  };
  /// A node with its parts, [Begin, End). Its children are 2 * Index and 2 * Index + 1.
  struct NodeRange
  {
    std::size_t Index, Begin, End;

    bool IsLeaf() const { return this->End - this->Begin <= 4; }
    std::size_t GetMiddle() const { return (this->Begin + this->End) / 2; }
    NodeRange GetLeft() const { return { 2 * this->Index, this->Begin, this->GetMiddle() }; }
    NodeRange GetRight() const { return { 2 * this->Index + 1, this->GetMiddle(), this->End }; }
  };

  void AddParts(std::int32_t segment, int count);
  void MakeNodes(const NodeRange& range);
  void Search(const NodeRange& range, const Box& bounds, std::vector<std::int32_t>& near) const;

  std::vector<Segment> Segments;
  std::vector<Part> Parts; ///< In the order of the leaves.
  std::vector<Box> Nodes;
};

}

#endif
