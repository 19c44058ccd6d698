// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_LAWSONORACLE_H
#define DELAUNAYFLIP_LAWSONORACLE_H

#include "ExactReference.h"
#include "FlipOptions.h"
#include "FlipTestSupport.h"

#include <cstdint>
#include <map>
#include <set>
#include <utility>

namespace delaunayflip
{

/// Lawson's algorithm in x and y in rational arithmetic, one flip at a time, until none is left:
/// a simple way to compute the mesh that the engine must reach.
class LawsonOracle
{
public:
  using Edge = std::pair<std::int32_t, std::int32_t>;

  /// @param mesh without flat, overlapping or clockwise triangles.
  /// @param constraints edges that stay, the smaller id first.
  LawsonOracle(const OwnedMesh<double>& mesh, std::set<Edge> constraints, TieRuleKind rule);

  /// @returns the number of flips.
  std::int64_t Run();

  TriangleSet GetTriangles() const;

private:
  void Add(std::int32_t a, std::int32_t b, std::int32_t c);
  Point3 Get(std::int32_t id) const;
  bool FlipOne();

  /// Triangles (a, p, q) and (b, q, p), both counter-clockwise.
  bool IsBad(std::int32_t a, std::int32_t p, std::int32_t q, std::int32_t b) const;

  const OwnedMesh<double>& Mesh;
  std::set<Edge> Constraints;
  TieRuleKind Rule;
  std::map<Edge, std::int32_t> Opposites;
};

}

#endif
