// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_SPLITHISTORY_H
#define DELAUNAYFLIP_SPLITHISTORY_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace delaunayflip
{

/// Coordinates are multiples of 2^-24: float represents them exactly, and an orientation
/// determinant of them easily fits into 64 bits.
constexpr std::int32_t LatticeSize = std::int32_t(1) << 24;

struct LatticePoint
{
  std::int32_t X;
  std::int32_t Y;
};

inline bool operator==(const LatticePoint& a, const LatticePoint& b)
{
  return a.X == b.X && a.Y == b.Y;
}

/// A triangle that is or was part of the mesh. Its children cover it, and the last vertex of each
/// is the point that split it.
struct HistoryNode
{
  std::array<std::int32_t, 3> Vertices;
  std::int32_t FirstChild = -1;
  std::int32_t NumberOfChildren = 0;
};

/// The tree of all splits. It finds the triangle that contains a point from the root downwards, in
/// O(log n) expected steps and without any adjacency between triangles.
class SplitHistory
{
public:
  /// @param side the side of the square, at most LatticeSize.
  SplitHistory(std::int64_t expectedPoints, std::int32_t side)
  {
    this->Points.reserve(static_cast<std::size_t>(expectedPoints));
    this->Nodes.reserve(static_cast<std::size_t>(3 * expectedPoints));
    this->Points = { { 0, 0 }, { side, 0 }, { side, side }, { 0, side } };
    this->Nodes = { { { 0, 1, 2 } }, { { 0, 2, 3 } } };
  }

  /// Adds a point inside the square, unless it is already there.
  void Insert(const LatticePoint& point)
  {
    this->FindLeaves(point);
    for (std::int32_t leaf : this->Leaves)
    {
      for (std::int32_t vertex : this->Nodes[leaf].Vertices)
      {
        if (this->Points[vertex] == point)
        {
          return;
        }
      }
    }
    this->Points.push_back(point);
    for (std::int32_t leaf : this->Leaves)
    {
      this->Split(leaf);
    }
  }

  /// Calls take(vertices) for every triangle of the mesh.
  template <typename Take>
  void ForEachTriangle(const Take& take) const
  {
    for (const HistoryNode& node : this->Nodes)
    {
      if (node.NumberOfChildren == 0)
      {
        take(node.Vertices);
      }
    }
  }

  std::vector<LatticePoint> Points; ///< First the four corners of the square.

private:
  std::int64_t Turn(std::int32_t from, std::int32_t to, const LatticePoint& point) const
  {
    const LatticePoint& a = this->Points[from];
    const LatticePoint& b = this->Points[to];
    return (std::int64_t(b.X) - a.X) * (std::int64_t(point.Y) - a.Y) -
      (std::int64_t(b.Y) - a.Y) * (std::int64_t(point.X) - a.X);
  }

  /// Whether a child contains a point that its parent contains. Only the two sides at the last
  /// vertex are new; the third is the parent's.
  bool ChildHolds(const HistoryNode& child, const LatticePoint& point) const
  {
    return this->Turn(child.Vertices[1], child.Vertices[2], point) >= 0 &&
      this->Turn(child.Vertices[2], child.Vertices[0], point) >= 0;
  }

  /// All leaves that contain the point: one, two if it lies on an edge, more if it is a vertex.
  void FindLeaves(const LatticePoint& point)
  {
    this->Leaves.clear();
    this->Pending.clear();
    for (std::int32_t root = 0; root < 2; ++root)
    {
      const std::int64_t side = this->Turn(0, 2, point);
      if (root == 0 ? side <= 0 : side >= 0)
      {
        this->Pending.push_back(root);
      }
    }
    while (!this->Pending.empty())
    {
      const std::int32_t node = this->Pending.back();
      this->Pending.pop_back();
      this->Visit(node, point);
    }
  }

  void Visit(std::int32_t index, const LatticePoint& point)
  {
    const HistoryNode& node = this->Nodes[index];
    if (node.NumberOfChildren == 0)
    {
      this->Leaves.push_back(index);
    }
    for (std::int32_t i = 0; i < node.NumberOfChildren; ++i)
    {
      if (this->ChildHolds(this->Nodes[node.FirstChild + i], point))
      {
        this->Pending.push_back(node.FirstChild + i);
      }
    }
  }

  /// Splits a leaf at the newest point. An edge on which the point lies makes no triangle with it.
  void Split(std::int32_t leaf)
  {
    const auto newest = static_cast<std::int32_t>(this->Points.size()) - 1;
    const std::array<std::int32_t, 3> corners = this->Nodes[leaf].Vertices;
    this->Nodes[leaf].FirstChild = static_cast<std::int32_t>(this->Nodes.size());
    for (int i = 0; i < 3; ++i)
    {
      const std::int32_t from = corners[i];
      const std::int32_t to = corners[(i + 1) % 3];
      if (this->Turn(from, to, this->Points[newest]) != 0)
      {
        this->Nodes.push_back({ { from, to, newest } });
        this->Nodes[leaf].NumberOfChildren++;
      }
    }
  }

  std::vector<HistoryNode> Nodes;
  std::vector<std::int32_t> Leaves;
  std::vector<std::int32_t> Pending;
};

}

#endif
