// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FixedPairs.h"

#include <algorithm>

namespace delaunayflip
{

void MarkedEdges::Add(const PointPair& edge, unsigned char marks)
{
  const auto last = static_cast<std::size_t>(edge[1]);
  if (last >= this->Ends.size())
  {
    this->Ends.resize(std::max(last + 1, 2 * this->Ends.size()));
  }
  this->Ends[edge[0]] = 1;
  this->Ends[edge[1]] = 1;
  this->Marks[edge] |= marks;
}

unsigned char MarkedEdges::Find(const PointPair& edge) const
{
  const auto found = this->Marks.find(edge);
  return found != this->Marks.end() ? found->second : 0;
}

void MarkedEdges::Apply(PieceTriangles& triangles) const
{
  for (PieceTriangle& triangle : triangles)
  {
    for (int slot = 0; slot < 3; ++slot)
    {
      triangle.SetMarks(slot, this->Get(triangle.GetStart(slot), triangle.GetEnd(slot)));
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
