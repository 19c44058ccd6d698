// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_SEAMTRIANGLE_H
#define DELAUNAYFLIP_SEAMTRIANGLE_H

#include "PieceMesh.h"
#include "QuadSoup.h"
#include "Records.h"

#include <cstdint>
#include <vector>

namespace delaunayflip
{

/// A triangle at an edge between two shared points, as its rank sends it to the home of the edge.
struct SeamTriangle
{
  PointPair Ends; ///< Keys of the ends of the edge.
  std::int64_t Opposite; ///< Key of the point opposite to the edge.
  std::int64_t Corner; ///< 3 * triangle + slot of the opposite point, on its rank.
  SeamSide Side;

  std::int64_t GetTriangle() const { return this->Corner / 3; }
  int GetSlot() const { return static_cast<int>(this->Corner % 3); }
};

/// The triangle, for its edge opposite to corner `slot`. Takes it as not frozen and in no region.
SeamTriangle MakeSeamTriangle(const PieceMesh& mesh, std::int64_t triangle, int slot);

/// A SeamTriangle with the rank that has sent it.
struct RankedTriangle
{
  PointPair Ends; ///< Seam->Ends.
  int Rank;
  const SeamTriangle* Seam;
};

/// Orders by edge, then by rank.
template <typename First, typename Second>
bool IsBefore(const First& a, const Second& b)
{
  if (a.Ends[0] != b.Ends[0])
  {
    return a.Ends[0] < b.Ends[0];
  }
  return a.Ends[1] != b.Ends[1] ? a.Ends[1] < b.Ends[1] : a.Rank < b.Rank;
}

/// Sorts the triangles that all ranks have sent by edge, then by rank.
/// @param lists must live as long as the result.
std::vector<RankedTriangle> SortByEdge(const RecordLists<SeamTriangle>& lists);

}

#endif
