// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef UpdateReport_h
#define UpdateReport_h

#include "FlipReport.h"

#include <cstdint>
#include <utility>

namespace delaunayflip
{

/// What an update did to a mesh, or the sum over several meshes: the blocks of a composite dataset
/// or the pieces of several processes.
struct UpdateReport : FlipReport
{
  UpdateReport() = default;
  explicit UpdateReport(FlipReport report)
    : FlipReport(std::move(report))
  {
  }

  /// Whether two meshes were flipped one after the other or at the same time.
  enum class Timing
  {
    InTurn,
    AtOnce
  };

  /// Adds the report of another mesh. Counts are summed, those of iterations row by row; the stop
  /// reason is the worse of the two, and angles are the smaller ones. Ids of defects are dropped:
  /// they mean nothing outside their mesh.
  void Add(const UpdateReport& other, Timing timing);

  /// GeometryUsed in words, or "mixed".
  const char* GetGeometryName() const;

  bool HasMixedGeometry = false; ///< GeometryUsed is then that of the first mesh.
  std::int64_t Rounds = 0; ///< PiecesReport's; 0 if the mesh was not flipped in pieces.
  std::int64_t MovedTriangles = 0;
};

}

#endif
