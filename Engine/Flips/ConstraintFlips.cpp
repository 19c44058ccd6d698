// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ConstraintFlips.h"

#include "EdgeFlip.h"
#include "FlipRules.h"

#include <algorithm>

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

//------------------------------------------------------------------------------
namespace
{
/// Walks from vertex to vertex along a constraint.
class PathWalk
{
public:
  PathWalk(const PlaneMesh& mesh, const VertexFans& fans, VertexId from, VertexId to)
    : Mesh(mesh),
      Fans(fans),
      From(from),
      To(to),
      IsAscending(IsLexicographicallyLess(mesh.GetPoint(from), mesh.GetPoint(to)))
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
    return this->IsAscending ? IsLexicographicallyLess(p, q) && !IsLexicographicallyLess(end, q)
                             : IsLexicographicallyLess(q, p) && !IsLexicographicallyLess(q, end);
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

struct CertainSigns
{
  static int Orientation(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c)
  {
    return FindOrientation(a, b, c);
  }
};
}

ConstraintPath ConstraintFlips::Find(VertexId from, VertexId to) const
{
  ConstraintPath path;
  if (!this->Mesh.IsFinite(from) || !this->Mesh.IsFinite(to))
  {
    path.Result = PathResult::LeavesMesh;
    return path;
  }
  const PlanePoint a = this->Mesh.GetPoint(from);
  const PlanePoint b = this->Mesh.GetPoint(to);
  if (!IsLexicographicallyLess(a, b) && !IsLexicographicallyLess(b, a))
  {
    path.Result = PathResult::Overlaps;
    return path;
  }
  return PathWalk(this->Mesh, this->Fans, from, to).Walk();
}

PathResult ConstraintFlips::Insert(VertexId from, VertexId to)
{
  ConstraintPath path = this->Find(from, to);
  while (path.Result == PathResult::IsBarred) // by a triangle without area
  {
    if (!this->RemoveBar(path.Bar))
    {
      return PathResult::Overlaps;
    }
    path = this->Find(from, to);
  }
  if (path.Result == PathResult::Found && !this->Flip(path))
  {
    return PathResult::Overlaps;
  }
  if (path.Result == PathResult::Found)
  {
    this->Fix(path);
  }
  return path.Result;
}

bool ConstraintFlips::Flip(ConstraintPath& path)
{
  return std::all_of(
    path.Segments.begin(), path.Segments.end(), [this](Rim& rim) { return this->Straighten(rim); });
}

void ConstraintFlips::Fix(const ConstraintPath& path)
{
  for (const Rim& rim : path.Segments)
  {
    this->Mesh.Edges.States[EdgeOf(rim.front())] = EdgeState::Fixed;
    this->Segments.push_back(rim.front());
  }
}

/// Cuts ears off the triangles that a segment of a constraint crosses until their rim is that
/// segment. A rim that is not straight always has an ear (Documentation/method.md).
/// @returns false where triangles overlap so that there is none.
bool ConstraintFlips::Straighten(Rim& rim)
{
  Rim kept;
  for (HalfEdgeId next : rim)
  {
    while (!kept.empty() && this->IsEar(kept.back(), next))
    {
      if (!this->CutEar(kept.back(), next))
      {
        return false;
      }
      // Of the ear, the third side; of what is left, its other side.
      const CornerId corner = PlaneMesh::Next(this->Mesh.Edges.CornerOfHalfEdge[kept.back()]);
      next = this->Mesh.GetHalfEdge(corner) ^ 1u;
      kept.pop_back();
    }
    kept.push_back(next);
  }
  rim = std::move(kept);
  return rim.size() == 1;
}

/// Whether the triangles at the vertex between two half-edges of a rim cover less than half a turn.
bool ConstraintFlips::IsEar(HalfEdgeId first, HalfEdgeId second) const
{
  const int turn = this->Mesh.FindTurnAt(this->Mesh.Edges.CornerOfHalfEdge[first]);
  return turn != 0 &&
    this->Mesh.FindTurn(
      this->Mesh.GetEnd(first), this->Mesh.GetStart(first), this->Mesh.GetStart(second)) == -turn;
}

/// Flips edges away from the vertex between two half-edges of a rim, until one triangle is left
/// there that has both.
bool ConstraintFlips::CutEar(HalfEdgeId first, HalfEdgeId second)
{
  std::vector<EdgeId> fan; // the edges between the two, around the vertex
  const CornerId start = PlaneMesh::Next(this->Mesh.Edges.CornerOfHalfEdge[first]);
  CornerId corner = start;
  HalfEdgeId side = this->Mesh.GetHalfEdge(PlaneMesh::Next(corner));
  while (side != second)
  {
    fan.push_back(EdgeOf(side));
    corner = this->Mesh.FindNextAround(corner);
    if (corner == NoCorner || corner == start)
    {
      return false;
    }
    side = this->Mesh.GetHalfEdge(PlaneMesh::Next(corner));
  }
  std::vector<EdgeId> left;
  for (const EdgeId edge : fan)
  {
    left.push_back(edge);
    while (!left.empty() && this->TryFlip(left.back()))
    {
      left.pop_back();
    }
  }
  return left.empty();
}

/// Flips a triangle without area away, and before it others on which it leans with its long side:
/// the next one's is longer, so that there is a last one.
bool ConstraintFlips::RemoveBar(TriangleId bar)
{
  std::vector<EdgeId> sides;
  for (TriangleId flat = bar; this->Mesh.FindTurnAt(MakeCorner(flat, 0)) == 0;)
  {
    const HalfEdgeId side = this->GetLongSide(flat);
    if (side == NoHalfEdge || this->Mesh.IsFixed(side) ||
      (!sides.empty() && sides.back() == EdgeOf(side)))
    {
      return false;
    }
    sides.push_back(EdgeOf(side));
    flat = TriangleOf(this->Mesh.FindAcross(side));
  }
  bool flipped = true;
  for (auto side = sides.rbegin(); side != sides.rend() && flipped; ++side)
  {
    flipped = this->TryFlip(*side);
  }
  return flipped;
}

/// Of a triangle without area, the side that holds all three points; NoHalfEdge where two coincide.
HalfEdgeId ConstraintFlips::GetLongSide(TriangleId flat) const
{
  for (int slot = 0; slot < 3; ++slot)
  {
    const CornerId corner = MakeCorner(flat, slot);
    const PlanePoint at = this->Mesh.GetPoint(this->Mesh.GetVertex(corner));
    const PlanePoint next = this->Mesh.GetPoint(this->Mesh.GetVertex(PlaneMesh::Next(corner)));
    const PlanePoint previous =
      this->Mesh.GetPoint(this->Mesh.GetVertex(PlaneMesh::Previous(corner)));
    const bool isBetween =
      (IsLexicographicallyLess(next, at) && IsLexicographicallyLess(at, previous)) ||
      (IsLexicographicallyLess(previous, at) && IsLexicographicallyLess(at, next));
    if (isBetween)
    {
      return this->Mesh.GetHalfEdge(corner);
    }
  }
  return NoHalfEdge;
}

bool ConstraintFlips::TryFlip(EdgeId edge)
{
  const EdgeMeshView& mesh = this->Mesh.Edges;
  if (mesh.States[edge] == EdgeState::Fixed)
  {
    return false;
  }
  const Quad quad = mesh.GetQuad(edge);
  if (!this->IsConvex(quad))
  {
    return false;
  }
  if (this->Table)
  {
    const std::uint64_t key = EdgeKey(quad.A, quad.B);
    bool fresh = false;
    if (this->Table->Find(key) != EdgeTableView::NoSlot || !this->Table->InsertNew(key, fresh))
    {
      return false;
    }
    this->Table->Remove(EdgeKey(quad.P, quad.Q));
  }
  const OuterHalfEdges outer = FlipEdge(mesh, edge, quad, mesh.Triangles[TriangleOf(quad.CornerA)],
    mesh.Triangles[TriangleOf(quad.CornerB)], nullptr);
  this->Fans.NoteFlip(edge, quad, outer.PB, outer.QA);
  for (const HalfEdgeId side : { 2 * edge, outer.AP, outer.QA, outer.PB, outer.BQ })
  {
    EdgeState* state = &mesh.States[EdgeOf(side)]; // others may make it a candidate, too
    if (AtomicLoad(state) != EdgeState::Fixed)
    {
      AtomicStore(state, EdgeState::Candidate);
    }
  }
  __atomic_fetch_add(&this->Flips, 1, __ATOMIC_RELAXED);
  return true;
}

/// Whether both triangles have the same side after the flip, strictly, and before it, at least one.
bool ConstraintFlips::IsConvex(const Quad& quad) const
{
  const PlanePoint apqb[4] = { this->Mesh.GetPoint(quad.A), this->Mesh.GetPoint(quad.P),
    this->Mesh.GetPoint(quad.Q), this->Mesh.GetPoint(quad.B) };
  bool strict = true;
  const int side = FindSide<CertainSigns>(apqb, strict);
  return side != 0 && CheckConvex<CertainSigns>(apqb, side) == EdgeState::Bad;
}

}
