// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ConstraintFlips.h"

#include "EdgeFlip.h"
#include "FlipRules.h"

#include <algorithm>

namespace delaunayflip
{

namespace
{
struct CertainSigns
{
  static int Orientation(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c)
  {
    return FindOrientation(a, b, c);
  }
};
}

PathResult ConstraintFlips::Insert(VertexId from, VertexId to)
{
  ConstraintPath path = FindPath(this->Mesh, this->Fans, from, to);
  while (path.Result == PathResult::IsBarred) // by a triangle without area
  {
    if (!this->RemoveBar(path.Bar))
    {
      return PathResult::Overlaps;
    }
    path = FindPath(this->Mesh, this->Fans, from, to);
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
