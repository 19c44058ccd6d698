// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FixedPairs.h"

#include <algorithm>

namespace delaunayflip
{

void MarkedEdges::Add(const PointPair& edge, EdgeMark mark)
{
  const auto last = static_cast<std::size_t>(edge[1]);
  if (last >= this->Ends.size())
  {
    this->Ends.resize(std::max(last + 1, 2 * this->Ends.size()));
  }
  this->Ends[edge[0]] = 1;
  this->Ends[edge[1]] = 1;
  this->Marks[edge] |= mark;
}

void MarkedEdges::Apply(std::vector<PieceTriangle>& triangles) const
{
  const auto isEnd = [this](std::int32_t point)
  { return static_cast<std::size_t>(point) < this->Ends.size() && this->Ends[point] != 0; };
  for (PieceTriangle& triangle : triangles)
  {
    triangle.Marks = 0;
    for (int slot = 0; slot < 3; ++slot)
    {
      if (!isEnd(triangle.GetStart(slot)) || !isEnd(triangle.GetEnd(slot)))
      {
        continue;
      }
      const auto found = this->Marks.find(triangle.GetEdge(slot));
      triangle.Marks |=
        static_cast<unsigned char>(found != this->Marks.end() ? found->second << slot : 0);
    }
  }
}

std::vector<PointPair> FindCrowdedEdges(const TriangleArray& triangles)
{
  std::vector<PointPair> edges;
  for (std::int64_t t = 0; t < triangles.Count; ++t)
  {
    for (int slot = 0; slot < 3; ++slot)
    {
      edges.push_back(MakePair(triangles.Get(t, (slot + 1) % 3), triangles.Get(t, (slot + 2) % 3)));
    }
  }
  std::sort(edges.begin(), edges.end());
  std::vector<PointPair> crowded;
  for (std::size_t i = 2; i < edges.size(); ++i)
  {
    if (edges[i] == edges[i - 2])
    {
      crowded.push_back(edges[i]);
    }
  }
  return crowded;
}

}
