// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_SEAMHALVES_H
#define DELAUNAYFLIP_SEAMHALVES_H

#include "SeamTester.h"

#include <unordered_map>
#include <vector>

namespace delaunayflip
{

/// The bad seam edges between every two ranks, divided into two halves by their places. In each
/// round either rank gets the triangles of one half, so that usually both have edges to flip.
///
/// Both ranks find the same halves, because they have got the same edges and places.
class SeamHalves
{
public:
  /// @param bad the bad seam edges of this rank.
  explicit SeamHalves(const std::vector<BadSeam>& bad);

  bool IsInSecond(const BadSeam& seam) const;

private:
  struct Cut
  {
    int Axis; ///< Along which the edges extend most.
    double Median;
  };

  /// @param seams the edges to one other rank.
  static Cut FindCut(std::vector<const BadSeam*> seams);

  std::unordered_map<int, Cut> Cuts; ///< By the other rank.
};

}

#endif
