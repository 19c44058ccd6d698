// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_SEQUENTIALLAWSON_H
#define DELAUNAYFLIP_SEQUENTIALLAWSON_H

#include "Predicates.h"
#include "TriangleMesh.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace delaunayflip
{

/// Triangles with neighbours, as in textbooks. A corner represents the edge opposite to it.
struct CornerMesh
{
  /// Finds the twins by sorting the edges' ends.
  explicit CornerMesh(const TriangleArray& triangles)
    : Vertices(3 * triangles.Count),
      Twins(this->Vertices.size(), -1)
  {
    for (std::size_t i = 0; i < this->Vertices.size(); ++i)
    {
      this->Vertices[i] = static_cast<std::int32_t>(triangles.Get(i / 3, i % 3));
    }
    std::vector<std::pair<std::uint64_t, std::int32_t>> sides; // the ends, and a corner
    sides.reserve(this->Vertices.size());
    for (std::int32_t corner = 0; corner < this->CountCorners(); ++corner)
    {
      sides.emplace_back(this->GetEnds(corner), corner);
    }
    std::sort(sides.begin(), sides.end());
    for (std::size_t i = 0, next = 0; i < sides.size(); i = next)
    {
      while (next < sides.size() && sides[next].first == sides[i].first)
      {
        ++next;
      }
      const std::int32_t a = sides[i].second;
      const std::int32_t b = sides[next - 1].second;
      if (next == i + 2 && this->Vertices[Next(a)] == this->Vertices[Previous(b)])
      {
        this->Link(a, b);
      }
    }
  }

  static std::int32_t Next(std::int32_t corner)
  {
    return corner % 3 == 2 ? corner - 2 : corner + 1;
  }
  static std::int32_t Previous(std::int32_t corner)
  {
    return corner % 3 == 0 ? corner + 2 : corner - 1;
  }

  /// Names an edge: the smaller id in the upper half, the larger one in the lower.
  static std::uint64_t MakeEnds(std::int64_t p, std::int64_t q)
  {
    return std::uint64_t(std::min(p, q)) << 32 | std::uint64_t(std::max(p, q));
  }
  std::uint64_t GetEnds(std::int32_t corner) const
  {
    return MakeEnds(this->Vertices[Next(corner)], this->Vertices[Previous(corner)]);
  }

  std::int32_t CountCorners() const { return static_cast<std::int32_t>(this->Vertices.size()); }

  /// Whether `corner` represents an edge of two triangles and is the smaller of its two corners.
  bool IsInterior(std::int32_t corner) const { return corner < this->Twins[corner]; }

  /// Triangles (a, p, q) and (b, q, p) become (a, p, b) and (b, q, a). Then the corners a,
  /// previous(a), b and previous(b) represent the outer edges.
  /// @param a a corner that represents an edge of two triangles.
  void Flip(std::int32_t a)
  {
    const std::int32_t b = this->Twins[a];
    const std::int32_t p = Next(a);
    const std::int32_t q = Previous(a);
    const std::int32_t qOfB = Next(b);
    const std::int32_t pOfB = Previous(b);
    const std::int32_t acrossQA = this->Twins[p];
    const std::int32_t acrossPB = this->Twins[qOfB];
    this->Vertices[q] = this->Vertices[b];
    this->Vertices[pOfB] = this->Vertices[a];
    this->Link(a, acrossPB);
    this->Link(b, acrossQA);
    this->Link(p, qOfB);
  }

  std::vector<std::int32_t> Vertices; ///< One per corner, three corners per triangle.

  /// The corner across the edge; -1 if the edge has one triangle, three or more, or two that run
  /// through it the same way.
  std::vector<std::int32_t> Twins;

private:
  void Link(std::int32_t corner, std::int32_t twin)
  {
    this->Twins[corner] = twin;
    if (twin >= 0)
    {
      this->Twins[twin] = corner;
    }
  }
};

/// The textbook algorithm: a stack of edges to test, one flip at a time.
/// @param mesh is flipped in place. Afterwards it has no bad edges, unless the limit was reached.
/// @param isBad isBad(p, q, a, b) for the corners of an edge p-q of triangles (a, p, q), (b, q, p).
/// @param maximumFlips a limit, for criteria with which the flips may never end.
/// @returns the number of flips.
template <typename IsBad>
std::int64_t RunLawson(CornerMesh& mesh, const IsBad& isBad,
  std::int64_t maximumFlips = std::numeric_limits<std::int64_t>::max())
{
  std::vector<std::int32_t> stack;
  std::vector<char> isStacked(mesh.Vertices.size(), 0);
  const auto push = [&](std::int32_t corner)
  {
    if (mesh.Twins[corner] >= 0 && !isStacked[corner])
    {
      isStacked[corner] = 1;
      stack.push_back(corner);
    }
  };
  for (std::int32_t corner = 0; corner < mesh.CountCorners(); ++corner)
  {
    if (mesh.IsInterior(corner))
    {
      push(corner);
    }
  }
  std::int64_t flips = 0;
  while (!stack.empty() && flips < maximumFlips)
  {
    const std::int32_t corner = stack.back();
    stack.pop_back();
    isStacked[corner] = 0;
    const std::int32_t twin = mesh.Twins[corner];
    if (twin >= 0 && isBad(CornerMesh::Next(corner), CornerMesh::Previous(corner), corner, twin))
    {
      mesh.Flip(corner);
      ++flips;
      for (const std::int32_t outer :
        { corner, CornerMesh::Previous(corner), twin, CornerMesh::Previous(twin) })
      {
        push(outer);
      }
    }
  }
  return flips;
}

/// Flips planar, counter-clockwise meshes without overlaps. Edges are judged by x and y,
/// exactly.
class SequentialLawson
{
public:
  explicit SequentialLawson(const TriangleMesh& mesh)
    : Mesh(mesh.Triangles)
  {
    for (std::int64_t i = 0; i < mesh.Points.Count; ++i)
    {
      this->Points.push_back(mesh.Points.Get(i, 0));
      this->Points.push_back(mesh.Points.Get(i, 1));
    }
  }

  /// @returns the number of flips.
  std::int64_t Run()
  {
    const auto at = [this](std::int32_t corner)
    { return &this->Points[2 * std::size_t(this->Mesh.Vertices[corner])]; };
    return RunLawson(this->Mesh,
      [&](std::int32_t p, std::int32_t q, std::int32_t a, std::int32_t b)
      { return InCircle(at(a), at(p), at(q), at(b)) > 0; });
  }

  const std::vector<std::int32_t>& GetTriangles() const { return this->Mesh.Vertices; }

private:
  std::vector<double> Points; ///< x, y.
  CornerMesh Mesh;
};

}

#endif
