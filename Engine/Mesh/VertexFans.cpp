// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "VertexFans.h"

namespace delaunayflip
{

VertexFans::VertexFans(const PlaneMesh& mesh, std::int64_t vertices, std::int64_t triangles)
  : Mesh(mesh),
    First(vertices, NoHalfEdge)
{
  std::vector<bool> isKnown(4 * triangles, false);
  const auto addFans = [&](bool open)
  {
    for (std::int64_t i = 0; i < 3 * triangles; ++i)
    {
      const CornerId corner = MakeCorner(static_cast<TriangleId>(i / 3), static_cast<int>(i % 3));
      const HalfEdgeId leaves = mesh.GetHalfEdge(PlaneMesh::Previous(corner));
      if (!isKnown[corner] && (!open || mesh.FindAcross(leaves) == NoCorner))
      {
        this->AddFan(corner, isKnown);
      }
    }
  };
  addFans(true);
  addFans(false); // of these any corner is the first
}

void VertexFans::AddFan(CornerId first, std::vector<bool>& isKnown)
{
  const HalfEdgeId leaves = this->Mesh.GetHalfEdge(PlaneMesh::Previous(first));
  HalfEdgeId& known = this->First[this->Mesh.GetVertex(first)];
  if (known == NoHalfEdge)
  {
    known = leaves;
  }
  else
  {
    this->Others.emplace(this->Mesh.GetVertex(first), leaves);
  }
  this->SearchFan(leaves,
    [&](CornerId corner)
    {
      isKnown[corner] = true;
      return false;
    });
}

void VertexFans::NoteFlip(EdgeId edge, const Quad& quad, HalfEdgeId fromP, HalfEdgeId fromQ)
{
  this->Replace(quad.P, edge, fromP);
  this->Replace(quad.Q, edge, fromQ);
}

void VertexFans::Replace(VertexId vertex, EdgeId gone, HalfEdgeId halfEdge)
{
  if (EdgeOf(this->First[vertex]) == gone)
  {
    this->First[vertex] = halfEdge;
    return;
  }
  const auto [begin, end] = this->Others.equal_range(vertex);
  for (auto other = begin; other != end; ++other)
  {
    other->second = EdgeOf(other->second) == gone ? halfEdge : other->second;
  }
}

}
