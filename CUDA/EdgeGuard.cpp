// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "EdgeGuard.h"

namespace delaunayflip
{

namespace
{
/// Share of slots ever used above which searches for absent edges get long.
constexpr double LargestUse = 0.8;
}

EdgeTableView EdgeGuard::MakeClaims(std::int64_t bad, const ThreadBackend& backend)
{
  // A table of the first iteration's size would cost every later one its clearing.
  this->Claims = EdgeTable(bad, this->NumberOfVertices, true, backend);
  return this->Claims.View();
}

void EdgeGuard::Maintain(const StepCounts& flips, EdgeMesh& mesh, const ThreadBackend& backend)
{
  this->UsedSlots += flips.FreshSlots;
  const double limit = LargestUse * static_cast<double>(this->Table.GetCapacity());
  if (flips.LostInserts > 0 || static_cast<double>(this->UsedSlots) > limit)
  {
    this->Rebuild(mesh, backend);
  }
}

void EdgeGuard::Rebuild(EdgeMesh& mesh, const ThreadBackend& backend)
{
  this->Table = EdgeTable();
  this->Table = EdgeTable(mesh.NumberOfEdges, this->NumberOfVertices, false, backend);
  const EdgeTableView table = this->Table.View();
  backend.ForRange(mesh.NumberOfTriangles,
    [&](std::int64_t begin, std::int64_t end)
    {
      for (std::int64_t t = begin; t < end; ++t)
      {
        const VertexId* v = mesh.Triangles[t].Vertices;
        bool inserted = false;
        table.FindOrInsert(EdgeKey(v[0], v[1]), inserted);
        table.FindOrInsert(EdgeKey(v[1], v[2]), inserted);
        table.FindOrInsert(EdgeKey(v[2], v[0]), inserted);
      }
    });
  this->UsedSlots = mesh.NumberOfEdges;
}

}
