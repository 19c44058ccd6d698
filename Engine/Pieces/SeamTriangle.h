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

/// A triangle at an edge whose ends are both shared, as its rank sends it to the edge's home.
struct SeamTriangle
{
  PointPair Ends; ///< Keys.
  std::int64_t Opposite; ///< A key.
  std::int64_t Corner; ///< 3 * triangle + slot of the opposite point, on its rank.
  SeamSide Side;

  std::int64_t GetTriangle() const { return this->Corner / 3; }
  int GetSlot() const { return static_cast<int>(this->Corner % 3); }
};

/// The triangle at the edge opposite to a slot; it is not frozen and in no region.
SeamTriangle MakeSeamTriangle(const PieceMesh& mesh, std::int64_t triangle, int slot);

/// One that a rank has sent.
struct RankedTriangle
{
  PointPair Ends; ///< Those of the seam.
  int Rank;
  const SeamTriangle* Seam;
};

/// The order by edge and rank.
template <typename First, typename Second>
bool IsBefore(const First& a, const Second& b)
{
  if (a.Ends[0] != b.Ends[0])
  {
    return a.Ends[0] < b.Ends[0];
  }
  return a.Ends[1] != b.Ends[1] ? a.Ends[1] < b.Ends[1] : a.Rank < b.Rank;
}

/// The triangles that all ranks have sent, those of an edge next to each other, by rank.
/// @param lists must live as long as the result.
std::vector<RankedTriangle> SortByEdge(const RecordLists<SeamTriangle>& lists);

}

#endif
