// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef UpdateReport_h
#define UpdateReport_h

#include "FlipReport.h"

#include <utility>

namespace delaunayflip
{

/// What an update did to a mesh or, in sum, to several: the blocks of a composite dataset, the
/// pieces of several processes.
struct UpdateReport : FlipReport
{
  UpdateReport() = default;
  explicit UpdateReport(FlipReport report)
    : FlipReport(std::move(report))
  {
  }

  /// Whether the seconds of two reports passed one after the other or at the same time.
  enum class Timing
  {
    InTurn,
    AtOnce
  };

  /// Adds what was done to another mesh: counts are summed, those of iterations row by row; the
  /// stop reason is the worse one; angles are the smaller ones. Ids of defects, which only have a
  /// meaning in one mesh, are dropped.
  void Add(const UpdateReport& other, Timing timing);

  /// GeometryUsed in words, or "mixed".
  const char* GetGeometryName() const;

  bool HasMixedGeometry = false; ///< GeometryUsed is then that of the first mesh.
};

}

#endif
