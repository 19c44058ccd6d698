// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SpreadPoints.h"

namespace delaunayflip
{

SpreadPoints::SpreadPoints(const InsertionTask& task, int rank, std::int64_t points)
  : OwnerOf(points, None)
{
  std::size_t borrowed = 0;
  for (const std::vector<std::int64_t>& list : task.Borrowed)
  {
    borrowed += list.size();
  }
  this->Owners.assign(task.Triangles.size() - borrowed, rank);
  for (std::size_t giver = 0; giver < task.Borrowed.size(); ++giver)
  {
    this->Owners.resize(this->Owners.size() + task.Borrowed[giver].size(), static_cast<int>(giver));
  }
}

void SpreadPoints::AddTriangles(const TriangleArray& triangles)
{
  for (std::int64_t t = 0; t < triangles.Count; ++t)
  {
    for (int slot = 0; slot < 3; ++slot)
    {
      int& owner = this->OwnerOf[triangles.Get(t, slot)];
      owner = owner == None || owner == this->Owners[t] ? this->Owners[t] : Several;
    }
  }
}

std::vector<std::int64_t> SpreadPoints::List() const
{
  std::vector<std::int64_t> list;
  for (std::size_t point = 0; point < this->OwnerOf.size(); ++point)
  {
    if (this->OwnerOf[point] == Several)
    {
      list.push_back(static_cast<std::int64_t>(point));
    }
  }
  return list;
}

}
