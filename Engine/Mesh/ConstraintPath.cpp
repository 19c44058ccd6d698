// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ConstraintPath.h"

#include "Atomics.h"

#include <tuple>

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
        const VertexId vertex = mesh.GetVertex(corner);
        if (this->First[vertex] == NoHalfEdge)
        {
          this->First[vertex] = leaves;
        }
        else
        {
          this->Others.emplace(vertex, leaves);
        }
        this->SearchFan(leaves,
          [&](CornerId known)
          {
            isKnown[known] = true;
            return false;
          });
      }
    }
  };
  addFans(true);
  addFans(false); // of these any corner is the first
}

void VertexFans::NoteFlip(EdgeId edge, const Quad& quad, HalfEdgeId fromP, HalfEdgeId fromQ)
{
  for (const auto& [vertex, halfEdge] : { std::pair(quad.P, fromP), std::pair(quad.Q, fromQ) })
  {
    // Flips elsewhere may read it meanwhile, but only one of them has this edge.
    HalfEdgeId& first = this->First[vertex];
    if (EdgeOf(AtomicLoad(&first)) == edge)
    {
      AtomicStore(&first, halfEdge);
    }
    const auto [begin, end] = this->Others.equal_range(vertex);
    for (auto other = begin; other != end; ++other)
    {
      other->second = EdgeOf(other->second) == edge ? halfEdge : other->second;
    }
  }
}

namespace
{

bool IsBefore(const PlanePoint& a, const PlanePoint& b)
{
  return std::tie(a.U, a.V) < std::tie(b.U, b.V);
}

/// Walks from vertex to vertex along a constraint.
class PathWalk
{
public:
  PathWalk(const PlaneMesh& mesh, const VertexFans& fans, VertexId from, VertexId to)
    : Mesh(mesh),
      Fans(fans),
      From(from),
      To(to),
      IsAscending(IsBefore(mesh.GetPoint(from), mesh.GetPoint(to)))
  {
  }

  ConstraintPath Walk()
  {
    VertexId at = this->From;
    while (at != this->To && this->Path.Result == PathResult::Found)
    {
      at = this->Step(at);
    }
    return std::move(this->Path);
  }

private:
  /// How a path can leave a vertex.
  struct Exits
  {
    HalfEdgeId Along = NoHalfEdge; ///< An edge, to End.
    VertexId End = 0;
    CornerId Through = NoCorner; ///< Across the edge opposite this corner.
    int Triangles = 0; ///< That it can go through.
    TriangleId Bar = NoTriangle;
  };

  /// To which side of the constraint a vertex lies; 0: on its line.
  int FindSide(VertexId vertex) const { return this->Mesh.FindTurn(this->From, this->To, vertex); }

  /// Of two vertices on the line, whether `b` lies further on, but not beyond the end.
  bool IsAhead(VertexId a, VertexId b) const
  {
    const PlanePoint p = this->Mesh.GetPoint(a);
    const PlanePoint q = this->Mesh.GetPoint(b);
    const PlanePoint end = this->Mesh.GetPoint(this->To);
    return this->IsAscending ? IsBefore(p, q) && !IsBefore(end, q)
                             : IsBefore(q, p) && !IsBefore(q, end);
  }

  VertexId Fail(PathResult result, TriangleId bar = NoTriangle)
  {
    this->Path.Result = result;
    this->Path.Bar = bar;
    return this->To;
  }

  /// @returns the next vertex.
  VertexId Step(VertexId at)
  {
    const Exits exits = this->FindExits(at);
    if (exits.Along != NoHalfEdge)
    {
      this->Path.Segments.push_back({ exits.Along });
      return exits.End;
    }
    if (exits.Triangles == 1)
    {
      return this->Cross(at, exits.Through);
    }
    if (exits.Triangles > 1)
    {
      return this->Fail(PathResult::Overlaps);
    }
    return exits.Bar == NoTriangle ? this->Fail(PathResult::LeavesMesh)
                                   : this->Fail(PathResult::IsBarred, exits.Bar);
  }

  Exits FindExits(VertexId at) const
  {
    Exits exits;
    this->Fans.Search(at,
      [&](CornerId corner)
      {
        this->AddExits(corner, exits);
        return exits.Along != NoHalfEdge && exits.End == this->To;
      });
    return exits;
  }

  void AddExits(CornerId corner, Exits& exits) const
  {
    const VertexId at = this->Mesh.GetVertex(corner);
    const VertexId next = this->Mesh.GetVertex(PlaneMesh::Next(corner));
    const VertexId previous = this->Mesh.GetVertex(PlaneMesh::Previous(corner));
    if (!this->Mesh.IsFinite(next) || !this->Mesh.IsFinite(previous))
    {
      return;
    }
    const int nextSide = this->FindSide(next);
    const int previousSide = this->FindSide(previous);
    this->AddEdge(at, next, nextSide, PlaneMesh::Previous(corner), exits);
    this->AddEdge(at, previous, previousSide, PlaneMesh::Next(corner), exits);
    if (nextSide * previousSide < 0)
    {
      const int turn = this->Mesh.FindTurnAt(corner);
      const bool leads = turn * previousSide > 0;
      exits.Through = leads ? corner : exits.Through;
      exits.Triangles += leads ? 1 : 0;
      exits.Bar = turn == 0 ? TriangleOf(corner) : exits.Bar;
    }
  }

  /// Takes the edge to `end` if it leads along the constraint, and no other one to a nearer vertex.
  void AddEdge(VertexId at, VertexId end, int side, CornerId opposite, Exits& exits) const
  {
    const bool leads = side == 0 && (end == this->To || this->IsAhead(at, end));
    if (leads && (exits.Along == NoHalfEdge || end == this->To || this->IsAhead(end, exits.End)))
    {
      exits.Along = this->Mesh.GetHalfEdge(opposite);
      exits.End = end;
    }
  }

  /// From a vertex through the triangle at its corner to the next vertex on the line.
  VertexId Cross(VertexId at, CornerId corner)
  {
    const int turn = this->Mesh.FindTurnAt(corner);
    ConstraintPath::Rim rim = { this->Mesh.GetHalfEdge(PlaneMesh::Next(corner)) };
    HalfEdgeId crossed = this->Mesh.GetHalfEdge(corner);
    while (true)
    {
      if (this->Mesh.IsFixed(crossed))
      {
        const bool isRim = this->Mesh.Edges.CornerOfHalfEdge[crossed ^ 1u] == NoCorner;
        return this->Fail(isRim ? PathResult::LeavesMesh : PathResult::CrossesFixedEdge);
      }
      this->Path.Crossed.push_back(crossed);
      const CornerId across = this->Mesh.FindAcross(crossed);
      const int turnAcross = this->Mesh.FindTurnAt(across);
      if (turnAcross != turn)
      {
        return turnAcross == 0 ? this->Fail(PathResult::IsBarred, TriangleOf(across))
                               : this->Fail(PathResult::Overlaps);
      }
      const int side = turn * this->FindSide(this->Mesh.GetVertex(across));
      const HalfEdgeId beforeAcross = this->Mesh.GetHalfEdge(PlaneMesh::Previous(across));
      crossed = side > 0 ? this->Mesh.GetHalfEdge(PlaneMesh::Next(across)) : beforeAcross;
      if (side >= 0)
      {
        rim.push_back(beforeAcross);
      }
      if (side == 0)
      {
        return this->Arrive(at, this->Mesh.GetVertex(across), std::move(rim));
      }
    }
  }

  VertexId Arrive(VertexId from, VertexId at, ConstraintPath::Rim rim)
  {
    if (at != this->To && !this->IsAhead(from, at))
    {
      return this->Fail(PathResult::Overlaps); // it has passed its end in another layer
    }
    this->Path.Segments.push_back(std::move(rim));
    return at;
  }

  const PlaneMesh& Mesh;
  const VertexFans& Fans;
  const VertexId From, To;
  const bool IsAscending; ///< Along the constraint u, or v, grows.
  ConstraintPath Path;
};

}

ConstraintPath FindPath(const PlaneMesh& mesh, const VertexFans& fans, VertexId from, VertexId to)
{
  ConstraintPath path;
  if (!mesh.IsFinite(from) || !mesh.IsFinite(to))
  {
    path.Result = PathResult::LeavesMesh;
    return path;
  }
  const PlanePoint a = mesh.GetPoint(from);
  const PlanePoint b = mesh.GetPoint(to);
  if (!IsBefore(a, b) && !IsBefore(b, a))
  {
    path.Result = PathResult::Overlaps;
    return path;
  }
  return PathWalk(mesh, fans, from, to).Walk();
}

}
