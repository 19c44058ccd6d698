// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_REFINEMENTSTEP_H
#define DELAUNAYFLIP_REFINEMENTSTEP_H

#include "Atomics.h"
#include "RefinementItem.h"
#include "RefinementView.h"
#include "TriangleSplit.h"

#include <cstdint>

/// @file
/// How a round of refinement chooses among places: one for every bad triangle, and one for every
/// subsegment that has to be split. Each place claims the triangles that it would split, and the
/// lowest key wins each triangle. Only places that have won all of theirs look for subsegments that
/// they encroach upon, and for places near them. So places that are inserted together are as far
/// from each other as if they had been inserted one after the other (Spielman, Teng and Üngör
/// 2007).

namespace delaunayflip
{

/// The steps of a round for one place.
struct RefinementStep
{
  RefinementView View;
  RefinementItem* Items;
  Cavity* Cavities; ///< By item, for items for triangles.
  std::uint64_t* Claims; ///< By triangle: the lowest key of the places that would split it.
  std::uint64_t Round; ///< See RefinementKey.

  /// Makes the place for a bad triangle.
  DELAUNAYFLIP_HOST_DEVICE void MakeItem(std::int64_t i, TriangleId triangle) const
  {
    const TriangleShape shape(this->View.Mesh, triangle);
    RefinementItem& item = this->Items[i];
    item.IsOnSegment = false;
    item.CutsSliver = false;
    item.Source = triangle;
    item.Flips = this->View.GetFlips(triangle);
    item.Rank = FindRank(shape, shape.IsSharperThan(this->View.Goals.Cotangent));
    item.Place = this->View.Round(shape.FindCenter(this->View.Goals.OffCenter));
    item.SquaredRadius = TriangleShape::GetSquaredDistance(item.Place, shape.From);
    item.Found.Triangle = triangle;
  }

  /// Locates the place for a triangle, and claims the triangles that it would split. If the place
  /// is on or beyond a subsegment, requests that this is split instead.
  DELAUNAYFLIP_HOST_DEVICE void LocateAndClaim(std::int64_t i) const
  {
    RefinementItem& item = this->Items[i];
    item.State = ItemState::Dropped;
    HalfEdgeId blocked = NoHalfEdge;
    if (IsFinite(item.Place))
    {
      blocked = this->Locate(item);
    }
    const bool isBlocked = blocked != NoHalfEdge;
    const bool isHopeless = !IsFinite(item.Place) || item.Found.FindVertexSlot() >= 0;
    const bool isStuck = isBlocked && !this->View.CanSplit(blocked);
    const bool staysOut =
      isStuck && !(this->View.IsKeptBoundary(blocked) && this->MoveInside(item));
    if (isHopeless || staysOut)
    {
      this->View.SetShape(item.Source, ShapeKind::Left);
      return;
    }
    if (isBlocked && !isStuck)
    {
      this->View.Request(blocked);
      item.Found.Triangle = item.Source;
      return;
    }
    item.State = ItemState::Waiting;
    this->Claim(i);
  }

  /// Finds the cavity of a place that has won its triangles. If the place is in the diametral
  /// circle of a subsegment that can be split, it is not inserted, and requests that split.
  DELAUNAYFLIP_HOST_DEVICE void FindCavity(std::int64_t i) const
  {
    RefinementItem& item = this->Items[i];
    if (item.State != ItemState::Waiting)
    {
      return;
    }
    if (!this->HoldsClaims(item))
    {
      item.State = ItemState::Dropped;
    }
    else if (this->GrowCavity(item, this->Cavities[i]))
    {
      item.State = ItemState::Encroaches;
    }
  }

  /// Makes the place that splits the subsegment of an item, and claims its triangles. The place is
  /// rounded, so it is not exactly on the segment. It must be between the ends, and it must not
  /// turn triangles over, as it may where a vertex is within rounding of the segment. Then a place
  /// beside it is taken, or else one that cuts a sliver off.
  DELAUNAYFLIP_HOST_DEVICE void ProposeForSegment(std::int64_t i) const
  {
    const PlaneMesh& mesh = this->View.Mesh;
    const std::uint32_t segment = this->Items[i].Source;
    const CornerId corner = mesh.Edges.CornerOfHalfEdge[this->View.GetSide(segment)];
    RefinementItem& item = this->Items[i];
    item.State = ItemState::Waiting;
    item.IsOnSegment = true;
    item.CutsSliver = false;
    item.Rank = 0; // lower than the rank of any triangle
    item.Found.Triangle = TriangleOf(corner);
    item.Found.OnEdges = 1 << SlotOf(corner);
    item.Place = this->View.FindSplit(segment);
    const bool isShort = this->IsShort(item);
    const bool isBetween = IsFinite(item.Place) &&
      this->View.IsInDiametralCircle(this->View.GetSide(segment), item.Place);
    const bool fits = isBetween &&
      (this->FitsBoth(item) || (!isShort && (this->MoveBeside(item) || this->CutSliverOff(item))));
    item.SquaredRadius = TriangleShape::GetSquaredDistance(
      item.Place, mesh.GetPoint(mesh.GetVertex(PlaneMesh::Next(corner))));
    if (!fits)
    {
      item.State = ItemState::Dropped;
      this->View.Marks[segment] = isShort ? CannotSplit : DoesNotFit;
      return;
    }
    this->Claim(i);
  }

  /// Decides whether a place wins. It does if no place with a lower key splits the same triangle,
  /// and none in its cavity or beside the cavity is near. @returns 1 if it wins, else 0.
  DELAUNAYFLIP_HOST_DEVICE int Decide(std::int64_t i) const
  {
    RefinementItem& item = this->Items[i];
    if (AtomicLoad(&item.State) != ItemState::Waiting)
    {
      return 0;
    }
    bool wins = this->HoldsClaims(item);
    const int count = item.IsOnSegment ? 0 : this->Cavities[i].Count;
    for (int k = 0; k < count && wins; ++k)
    {
      const CornerId reached = this->Cavities[i].Corners[k];
      wins = this->MayInsert(item, TriangleOf(reached));
      this->ForNeighbors(
        reached, [&](TriangleId other) { wins = wins && this->MayInsert(item, other); });
    }
    AtomicStore(&item.State, wins ? ItemState::Wins : ItemState::Dropped);
    return int(wins);
  }

  /// Prefetches what FindCavity will read for this item, and for earlier ones, see RefinementView.
  void PrefetchCavity(std::int64_t i) const
  {
    const TriangleId triangle = this->Items[i].Found.Triangle;
    this->View.PrefetchTriangle(triangle);
    Prefetch(&this->Claims[triangle]);
    if (i < RefinementView::Fifth)
    {
      return;
    }
    const RefinementItem& second = this->Items[i - RefinementView::Second];
    if (this->HoldsFirst(second))
    {
      this->View.PrefetchCorners(second.Found.Triangle);
    }
    const RefinementItem& third = this->Items[i - RefinementView::Third];
    if (this->HoldsFirst(third))
    {
      this->View.PrefetchNeighbors(third.Found.Triangle);
    }
    const RefinementItem& fourth = this->Items[i - RefinementView::Fourth];
    if (this->HoldsFirst(fourth))
    {
      this->View.PrefetchBeyond(fourth.Found.Triangle);
    }
    const RefinementItem& fifth = this->Items[i - RefinementView::Fifth];
    if (this->HoldsFirst(fifth))
    {
      this->View.PrefetchSecondNeighbors(fifth.Found.Triangle);
    }
  }

  /// Likewise for Decide: the triangles of the cavity, their edges, and the claims beyond.
  void PrefetchDecision(std::int64_t i) const
  {
    if (i < RefinementView::Third)
    {
      return;
    }
    this->ForCavity(i,
      [this](TriangleId triangle)
      {
        Prefetch(&this->View.Mesh.Edges.Triangles[triangle]);
        Prefetch(&this->Claims[triangle]);
      });
    this->ForCavity(i - RefinementView::Second,
      [this](TriangleId triangle)
      {
        for (const HalfEdgeId side : this->View.Mesh.Edges.Triangles[triangle].HalfEdges)
        {
          this->View.PrefetchEdge(side);
        }
      });
    this->ForCavity(i - RefinementView::Third,
      [this](TriangleId triangle)
      {
        for (const HalfEdgeId side : this->View.Mesh.Edges.Triangles[triangle].HalfEdges)
        {
          const CornerId across = this->View.Mesh.Edges.CornerOfHalfEdge[side ^ 1u];
          if (across != NoCorner)
          {
            Prefetch(&this->Claims[TriangleOf(across)]);
          }
        }
      });
  }

private:
  /// Whether a place for a triangle has won the triangle that it is in.
  bool HoldsFirst(const RefinementItem& item) const
  {
    return this->Claims[item.Found.Triangle] == item.Key;
  }

  /// Calls visit(triangle) for the cavity of a place for a triangle, if it has been found.
  template <typename Visit>
  void ForCavity(std::int64_t i, const Visit& visit) const
  {
    const RefinementItem& item = this->Items[i];
    const bool isWaiting = AtomicLoad(&item.State) == ItemState::Waiting;
    const int count = isWaiting ? this->Cavities[i].Count : 0;
    for (int k = 0; k < count; ++k)
    {
      visit(TriangleOf(this->Cavities[i].Corners[k]));
    }
  }

  /// Moves the place for a triangle to its centroid, if that helps. @returns whether it does.
  DELAUNAYFLIP_HOST_DEVICE bool MoveInside(RefinementItem& item) const
  {
    if (!this->View.CanSplitInside(item.Source))
    {
      return false;
    }
    const TriangleShape shape(this->View.Mesh, item.Source);
    item.Place = this->View.Round(shape.FindCentroid());
    item.SquaredRadius = INFINITY;
    const PlanePoint corners[3] = { shape.Apex, shape.From, shape.To };
    for (const PlanePoint& corner : corners)
    {
      const double squared = TriangleShape::GetSquaredDistance(item.Place, corner);
      item.SquaredRadius = squared < item.SquaredRadius ? squared : item.SquaredRadius;
    }
    item.Found.Triangle = item.Source;
    return this->Locate(item) == NoHalfEdge && item.Found.FindVertexSlot() < 0;
  }

  /// Walks to the place.
  /// @returns a side of the subsegment that the place is on or beyond, or NoHalfEdge.
  DELAUNAYFLIP_HOST_DEVICE HalfEdgeId Locate(RefinementItem& item) const
  {
    PlaneMesh mesh = this->View.Mesh;
    mesh.IsInFilterRange = mesh.IsInFilterRange && IsInFilterRange(item.Place);
    WalkEnd end = WalkWithinSegments(mesh, item.Place, item.Found.Triangle);
    if (end.Blocked != NoHalfEdge && item.Found.Triangle != item.Source)
    {
      end = WalkWithinSegments(mesh, item.Place, item.Source);
    }
    item.Found = end.Found;
    const int edgeSlot = end.Found.FindEdgeSlot();
    if (end.Blocked == NoHalfEdge && edgeSlot >= 0)
    {
      const HalfEdgeId side = mesh.GetHalfEdge(MakeCorner(end.Found.Triangle, edgeSlot));
      return mesh.IsFixed(side) ? side : NoHalfEdge;
    }
    return end.Blocked;
  }

  DELAUNAYFLIP_HOST_DEVICE void Claim(std::int64_t i) const
  {
    RefinementItem& item = this->Items[i];
    item.Key = RefinementKey::Make(this->Round, item.Rank, i);
    this->ForSplit(
      item.Found, [&](TriangleId triangle) { AtomicMin(&this->Claims[triangle], item.Key); });
  }

  DELAUNAYFLIP_HOST_DEVICE bool HoldsClaims(const RefinementItem& item) const
  {
    bool holds = true;
    this->ForSplit(item.Found,
      [&](TriangleId triangle) { holds = holds && this->Claims[triangle] == item.Key; });
    return holds;
  }

  /// Whether an item may be inserted beside the place that would split a triangle, if there is one.
  /// It may if that place has a higher key, or is far enough away.
  DELAUNAYFLIP_HOST_DEVICE bool MayInsert(const RefinementItem& item, TriangleId triangle) const
  {
    const std::uint64_t key = this->Claims[triangle];
    if (key >= item.Key) // keys of earlier rounds are larger, too
    {
      return true;
    }
    const RefinementItem& other = this->Items[RefinementKey::GetItem(key)];
    const double radius =
      item.SquaredRadius > other.SquaredRadius ? item.SquaredRadius : other.SquaredRadius;
    // In measurements a factor of 1 needed a fifth fewer rounds, but 1 to 4 % more points.
    constexpr double Factor = 2.0;
    const bool isFar = TriangleShape::GetSquaredDistance(item.Place, other.Place) > Factor * radius;
    return isFar || AtomicLoad(&other.State) == ItemState::Encroaches;
  }

  /// Finds the cavity of a place. @returns whether the place is in the diametral circle of a
  /// subsegment that can be split.
  DELAUNAYFLIP_HOST_DEVICE bool GrowCavity(const RefinementItem& item, Cavity& cavity) const
  {
    const PlaneMesh& mesh = this->View.Mesh;
    const int edgeSlot = item.Found.FindEdgeSlot();
    cavity.Count = 0;
    cavity.Add(MakeCorner(item.Found.Triangle, edgeSlot < 0 ? Cavity::NoSlot : edgeSlot));
    if (edgeSlot >= 0)
    {
      cavity.Add(TriangleSplitter(mesh.Edges).FindAcross(item.Found));
    }
    bool encroaches = false;
    for (int k = 0; k < cavity.Count; ++k)
    {
      const CornerId reached = cavity.Corners[k];
      const TriangleRecord& triangle = mesh.Edges.Triangles[TriangleOf(reached)];
      for (int slot = 0; slot < 3; ++slot)
      {
        const HalfEdgeId side = triangle.HalfEdges[slot];
        if (slot == SlotOf(reached))
        {
          continue;
        }
        if (mesh.IsFixed(side))
        {
          const bool isNear =
            this->View.IsInDiametralCircle(side, item.Place) && this->View.CanSplit(side);
          if (isNear)
          {
            this->View.Request(side);
            encroaches = true;
          }
          continue;
        }
        const CornerId across = mesh.Edges.CornerOfHalfEdge[side ^ 1u];
        if (this->IsInCircumcircle(TriangleOf(across), item.Place))
        {
          cavity.Add(across);
        }
      }
    }
    return encroaches;
  }

  /// Whether a place is in the circumcircle of a triangle. Floating-point arithmetic suffices,
  /// because the answer does not affect whether the mesh is valid.
  DELAUNAYFLIP_HOST_DEVICE bool IsInCircumcircle(TriangleId triangle, const PlanePoint& place) const
  {
    const PlaneMesh& mesh = this->View.Mesh;
    double u[3], v[3], squared[3];
    for (int slot = 0; slot < 3; ++slot)
    {
      const PlanePoint corner = mesh.GetPoint(mesh.Edges.Triangles[triangle].Vertices[slot]);
      u[slot] = corner.U - place.U;
      v[slot] = corner.V - place.V;
      squared[slot] = u[slot] * u[slot] + v[slot] * v[slot];
    }
    const double sum = squared[0] * (u[1] * v[2] - u[2] * v[1]) +
      squared[1] * (u[2] * v[0] - u[0] * v[2]) + squared[2] * (u[0] * v[1] - u[1] * v[0]);
    return sum > 0.0;
  }

  /// Whether a subsegment has only a few roundings. Such a one bounds no good triangles.
  DELAUNAYFLIP_HOST_DEVICE bool IsShort(const RefinementItem& item) const
  {
    constexpr double Short = 1024.0; // in roundings
    const double least = Short * this->View.GetRounding(item.Place);
    const HalfEdgeId side = this->View.GetSide(item.Source);
    const double squared =
      TriangleShape::GetSquaredDistance(this->View.Mesh.GetPoint(this->View.Mesh.GetStart(side)),
        this->View.Mesh.GetPoint(this->View.Mesh.GetEnd(side)));
    return squared < least * least;
  }

  /// Moves a place on a segment so that it turns no triangle over.
  /// @returns whether there is such a place.
  DELAUNAYFLIP_HOST_DEVICE bool MoveBeside(RefinementItem& item) const
  {
    return this->MoveUntil(item, [&] { return this->FitsBoth(item); });
  }

  /// Moves a place on a segment into the kept triangle there, if the triangle on the other side is
  /// removed. That one may be a sliver: where a corner of an outline is a rounding inside of the
  /// hull, there may be no number between the two. Then the domain loses a sliver instead.
  /// @returns whether there is such a place.
  DELAUNAYFLIP_HOST_DEVICE bool CutSliverOff(RefinementItem& item) const
  {
    const PlaneMesh& mesh = this->View.Mesh;
    const CornerPair corners = mesh.Edges.GetCorners(this->View.Segments[item.Source]);
    const bool hasTwo = corners.A != NoCorner && corners.B != NoCorner;
    if (!hasTwo ||
      this->View.IsKept(TriangleOf(corners.A)) == this->View.IsKept(TriangleOf(corners.B)))
    {
      return false;
    }
    const CornerId kept = this->View.IsKept(TriangleOf(corners.A)) ? corners.A : corners.B;
    item.Found.Triangle = TriangleOf(kept);
    item.Found.OnEdges = 1 << SlotOf(kept);
    item.CutsSliver = this->MoveUntil(item, [&] { return this->IsInside(item.Place, kept); });
    return item.CutsSliver;
  }

  /// Moves a place on a segment by a rounding, or by up to an eighth of the segment along it, until
  /// it fits. @returns whether it does in the end.
  template <typename Fitting>
  DELAUNAYFLIP_HOST_DEVICE bool MoveUntil(RefinementItem& item, const Fitting& fitting) const
  {
    constexpr double Shift = 1.0 / 64.0;
    constexpr int Directions = 9, Shifts = 17; // 8 forward and 8 back
    const PlanePoint place = item.Place;
    const double rounding = this->View.GetRounding(place);
    const HalfEdgeId side = this->View.GetSide(item.Source);
    const PlanePoint a = this->View.Mesh.GetPoint(this->View.Mesh.GetStart(side));
    const PlanePoint b = this->View.Mesh.GetPoint(this->View.Mesh.GetEnd(side));
    bool fits = false;
    for (int k = 0; k < Shifts * Directions && !fits; ++k)
    {
      const int shift = k / Directions, u = k % 3 - 1, v = k % Directions / 3 - 1;
      const double along = Shift * (shift % 2 == 0 ? shift / 2 : -(shift + 1) / 2);
      item.Place = this->View.Round({ place.U + along * (b.U - a.U) + u * rounding,
        place.V + along * (b.V - a.V) + v * rounding, 0.0 });
      fits = this->View.IsInDiametralCircle(side, item.Place) && fitting();
    }
    if (!fits)
    {
      item.Place = place;
    }
    return fits;
  }

  /// Whether a place on a segment splits the triangles there into counter-clockwise ones.
  DELAUNAYFLIP_HOST_DEVICE bool FitsBoth(const RefinementItem& item) const
  {
    const CornerPair corners = this->View.Mesh.Edges.GetCorners(this->View.Segments[item.Source]);
    const bool fitsA = corners.A == NoCorner || this->Fits(item.Place, corners.A);
    return fitsA && (corners.B == NoCorner || this->Fits(item.Place, corners.B));
  }

  /// Whether a place splits the triangle at an edge into two counter-clockwise ones.
  DELAUNAYFLIP_HOST_DEVICE bool Fits(const PlanePoint& place, CornerId opposite) const
  {
    const PlaneMesh& mesh = this->View.Mesh;
    const PlanePoint apex = mesh.GetPoint(mesh.GetVertex(opposite));
    const PlanePoint from = mesh.GetPoint(mesh.GetVertex(PlaneMesh::Next(opposite)));
    const PlanePoint to = mesh.GetPoint(mesh.GetVertex(PlaneMesh::Previous(opposite)));
    return mesh.RequireSign(FindOrientation(from, place, apex)) > 0 &&
      mesh.RequireSign(FindOrientation(place, to, apex)) > 0;
  }

  /// Whether a place is inside of the triangle of a corner.
  DELAUNAYFLIP_HOST_DEVICE bool IsInside(const PlanePoint& place, CornerId opposite) const
  {
    const PlaneMesh& mesh = this->View.Mesh;
    const PlanePoint from = mesh.GetPoint(mesh.GetVertex(PlaneMesh::Next(opposite)));
    const PlanePoint to = mesh.GetPoint(mesh.GetVertex(PlaneMesh::Previous(opposite)));
    return mesh.RequireSign(FindOrientation(from, to, place)) > 0 && this->Fits(place, opposite);
  }

  /// Calls visit(triangle) for the triangles that a place splits.
  template <typename Visit>
  DELAUNAYFLIP_HOST_DEVICE void ForSplit(const FoundPlace& found, const Visit& visit) const
  {
    visit(found.Triangle);
    if (found.FindEdgeSlot() >= 0)
    {
      const CornerId across = TriangleSplitter(this->View.Mesh.Edges).FindAcross(found);
      if (across != NoCorner)
      {
        visit(TriangleOf(across));
      }
    }
  }

  /// Calls visit(triangle) for the neighbours of a triangle of a cavity across edges that are not
  /// subsegments, except for the triangle from which it was reached.
  template <typename Visit>
  DELAUNAYFLIP_HOST_DEVICE void ForNeighbors(CornerId reached, const Visit& visit) const
  {
    const PlaneMesh& mesh = this->View.Mesh;
    const TriangleRecord& triangle = mesh.Edges.Triangles[TriangleOf(reached)];
    for (int slot = 0; slot < 3; ++slot)
    {
      const HalfEdgeId side = triangle.HalfEdges[slot];
      if (slot != SlotOf(reached) && !mesh.IsFixed(side))
      {
        visit(TriangleOf(mesh.Edges.CornerOfHalfEdge[side ^ 1u]));
      }
    }
  }
};

}

#endif
