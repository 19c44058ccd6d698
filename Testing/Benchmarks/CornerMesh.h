// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_CORNERMESH_H
#define DELAUNAYFLIP_CORNERMESH_H

#include <cstdint>
#include <vector>

namespace delaunayflip
{

/// Triangles with neighbours, as in textbooks. A corner represents the edge opposite to it.
struct CornerMesh
{
  /// Finds the twins by sorting vertex pairs.
  /// @param triangles three ids each.
  explicit CornerMesh(std::vector<std::int32_t> triangles);

  static std::int32_t Next(std::int32_t corner)
  {
    return corner % 3 == 2 ? corner - 2 : corner + 1;
  }
  static std::int32_t Previous(std::int32_t corner)
  {
    return corner % 3 == 0 ? corner + 2 : corner - 1;
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

}

#endif
