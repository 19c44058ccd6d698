// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PIECEQUALITY_H
#define DELAUNAYFLIP_PIECEQUALITY_H

#include "PieceMesh.h"
#include "PieceRegion.h"

#include <cstdint>
#include <vector>

namespace delaunayflip
{

/// The smallest angle of every triangle of a rank, for FlipOptions::TrackQuality: a session sees
/// only a region, but its iterations tell the angle of all triangles.
class PieceQuality
{
public:
  /// Measures all triangles.
  void Measure(const PieceMesh& mesh, const PieceSurvey& survey);

  /// Measures the triangles of a region after flips.
  /// @param ids of all of them, the region's numbers.
  void Update(
    const PieceRegion& region, const std::vector<std::int32_t>& ids, const PieceSurvey& survey);

  /// The smallest angle in degrees; NaN if there is none.
  /// @param omitted triangles, ascending.
  double FindSmallest(const PieceMesh& mesh, const std::vector<std::int64_t>& omitted = {}) const;

private:
  std::vector<double> Angles; ///< One per place; some may be missing at the end.
};

}

#endif
