// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_QUADSOUP_H
#define DELAUNAYFLIP_QUADSOUP_H

#include "FlipOptions.h"
#include "FlipReport.h"
#include "PieceSurvey.h"
#include "TriangleMesh.h"

#include <cstdint>
#include <vector>

namespace delaunayflip
{

/// Coordinates of points, in the precision of the caller's coordinates.
class PointList
{
public:
  explicit PointList(bool isFloat)
    : IsFloat(isFloat)
  {
  }
  void Reserve(std::int64_t size);
  void Add(const double (&x)[3]);
  std::int64_t GetSize() const;
  PointArray View() const;

private:
  bool IsFloat;
  std::vector<float> Floats;
  std::vector<double> Doubles;
};

/// One of the two triangles of an edge, with all that decides whether the edge is fixed.
struct SeamSide
{
  double Ends[2][3]; ///< Of the edge, in the same order for both triangles.
  double Opposite[3];
  bool RunsForward; ///< The triangle runs through the edge from the first end to the second.
  bool IsFrozen;
  std::int32_t Region;
};

/// A mesh of quads that share no points. Each quad has two triangles: those of an edge, which may
/// come from different ranks. So the engine judges such edges by the same rules as all others.
class QuadSoup
{
public:
  QuadSoup(const PieceSurvey& survey, const FlipOptions& options);

  void Add(const SeamSide& one, const SeamSide& other);
  std::int64_t GetSize() const { return this->Points.GetSize() / 4; }

  /// One flag per quad: whether its edge is fixed. Adds these edges, and why they are fixed, to
  /// `counts`.
  std::vector<unsigned char> FindFixed(EdgeCounts& counts) const;

private:
  TriangleMesh View() const;
  FlipOptions Options;
  WholeMesh Whole;
  PointList Points;
  std::vector<std::int64_t> Triangles;
  std::vector<std::int32_t> Regions;
  std::vector<unsigned char> Frozen;
};

/// The options for flipping a part of the whole mesh. The geometry has been chosen for the whole
/// mesh, and the fixed edges must be given.
FlipOptions GetPartOptions(const PieceSurvey& survey, const FlipOptions& options);

}

#endif
