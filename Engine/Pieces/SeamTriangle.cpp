// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SeamTriangle.h"

#include <algorithm>
#include <utility>

namespace delaunayflip
{

SeamTriangle MakeSeamTriangle(const PieceMesh& mesh, std::int64_t t, int slot)
{
  std::int32_t points[3];
  mesh.GetPoints(t, points);
  std::int32_t first = points[(slot + 1) % 3];
  std::int32_t second = points[(slot + 2) % 3];
  SeamTriangle seam{};
  seam.Ends = mesh.GetKeys({ first, second });
  seam.Opposite = mesh.GetKey(points[slot]);
  seam.Corner = 3 * t + slot;
  seam.Side.RunsForward = mesh.GetKey(first) == seam.Ends[0];
  if (!seam.Side.RunsForward)
  {
    std::swap(first, second);
  }
  mesh.GetPosition(first, seam.Side.Ends[0]);
  mesh.GetPosition(second, seam.Side.Ends[1]);
  mesh.GetPosition(points[slot], seam.Side.Opposite);
  return seam;
}

std::vector<RankedTriangle> SortByEdge(const RecordLists<SeamTriangle>& lists)
{
  std::vector<RankedTriangle> all;
  for (std::size_t rank = 0; rank < lists.size(); ++rank)
  {
    for (const SeamTriangle& seam : lists[rank])
    {
      all.push_back({ seam.Ends, static_cast<int>(rank), &seam });
    }
  }
  std::sort(all.begin(), all.end(),
    [](const RankedTriangle& a, const RankedTriangle& b)
    { return IsBefore(a, b) || (!IsBefore(b, a) && a.Seam->Corner < b.Seam->Corner); });
  return all;
}

}
