// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_SEAMHALVES_H
#define DELAUNAYFLIP_SEAMHALVES_H

#include "PieceMesh.h"
#include "SeamTester.h"

#include <array>
#include <unordered_map>
#include <vector>

namespace delaunayflip
{

/// The bad seam edges between two ranks, cut into two halves by their places, so that in each round
/// either rank gets the triangles of one half and both have edges to flip.
///
/// Both ranks find the same halves, because they know the same bad edges and coordinates.
class SeamHalves
{
public:
  /// @param bad the bad seam edges of this rank.
  SeamHalves(const std::vector<BadSeam>& bad, const PieceMesh& mesh);

  /// Whether an edge is in the second half.
  bool IsInSecond(const BadSeam& seam) const
  {
    const Cut& cut = this->Cuts.at(seam.OtherRank);
    return this->GetPlace(seam)[cut.Axis] >= cut.Median;
  }

private:
  using Place = std::array<double, 3>;

  struct Cut
  {
    int Axis; ///< Along which the edges extend most.
    double Median;
  };

  /// Where the end with the lower key is. A coordinate that is NaN counts as 0.
  Place GetPlace(const BadSeam& seam) const;
  /// @param places of the edges to one other rank.
  static Cut FindCut(std::vector<Place> places);

  const PieceMesh& Mesh;
  std::unordered_map<int, Cut> Cuts; ///< By the other rank.
};

}

#endif
