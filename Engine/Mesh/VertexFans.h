// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_VERTEXFANS_H
#define DELAUNAYFLIP_VERTEXFANS_H

#include "PlaneMesh.h"

#include <cstdint>
#include <map>
#include <vector>

namespace delaunayflip
{

/// From vertices to their triangles. A fan is what can be reached around a vertex from triangle to
/// triangle; most vertices have one. Of each fan a half-edge is known that leaves the vertex: of an
/// open one the first edge, which has nothing on its other side, so that no flip takes it away.
class VertexFans
{
public:
  /// @param mesh must outlive this.
  VertexFans(const PlaneMesh& mesh, std::int64_t vertices, std::int64_t triangles);

  /// Calls visit(corner) for the corners of a vertex until it returns true.
  template <typename Visit>
  void Search(VertexId vertex, const Visit& visit) const
  {
    const HalfEdgeId first = this->First[vertex];
    if (first == NoHalfEdge || this->SearchFan(first, visit))
    {
      return;
    }
    const auto [begin, end] = this->Others.equal_range(vertex);
    for (auto other = begin; other != end && !this->SearchFan(other->second, visit);)
    {
      ++other;
    }
  }

  /// Must hear of every flip.
  /// @param quad as it was. @param fromP, fromQ half-edges that leave P and Q now, other than the
  /// flipped one.
  void NoteFlip(EdgeId edge, const Quad& quad, HalfEdgeId fromP, HalfEdgeId fromQ);

private:
  template <typename Visit>
  bool SearchFan(HalfEdgeId first, const Visit& visit) const
  {
    const CornerId start = PlaneMesh::Next(this->Mesh.Edges.CornerOfHalfEdge[first]);
    CornerId corner = start;
    do
    {
      if (visit(corner))
      {
        return true;
      }
      corner = this->Mesh.FindNextAround(corner);
    } while (corner != NoCorner && corner != start);
    return false;
  }

  void AddFan(CornerId first, std::vector<bool>& isKnown);
  void Replace(VertexId vertex, EdgeId gone, HalfEdgeId halfEdge);

  const PlaneMesh& Mesh;
  std::vector<HalfEdgeId> First; ///< One a vertex, or NoHalfEdge.
  std::multimap<VertexId, HalfEdgeId> Others;
};

}

#endif
