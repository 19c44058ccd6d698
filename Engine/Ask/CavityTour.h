// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_CAVITYTOUR_H
#define DELAUNAYFLIP_CAVITYTOUR_H

#include "PlaceCavity.h"

#include <cmath>

namespace delaunayflip
{

/// Finds the natural weights of a place in a tour along the boundary of its cavity. They have the
/// bits of VisitNaturalWeights, but a tour is faster on a host. It sees each triangle, edge and
/// vertex once, and keeps them. Its arrays are apart, so that a compiler can keep all else in
/// registers.
template <typename Frame>
class CavityTour
{
public:
  struct Arrays;

  DELAUNAYFLIP_HOST_DEVICE CavityTour(const Frame& frame, Arrays& arrays)
    : Seen(frame),
      Kept(arrays),
      Current(arrays.Triangles)
  {
  }

  /// @param triangle has the place inside.
  /// @returns false if the cavity is too large. Then there are no weights.
  DELAUNAYFLIP_HOST_DEVICE DELAUNAYFLIP_ALWAYS_INLINE bool Run(TriangleId triangle)
  {
    if (!this->Seen.IsInFilterRange())
    {
      return false;
    }
    this->Begin(triangle);
    while (this->NumberOfEdges > 0)
    {
      --this->NumberOfEdges;
      Edge edge = this->Kept.Edges[this->NumberOfEdges];
      this->ReturnTo(edge.Owner);
      while (this->GoAcross(edge))
      {
        if (this->NumberOfTriangles == MostTriangles)
        {
          return false;
        }
      }
      this->AddBoundaryEdge(edge);
    }
    this->End();
    return true;
  }

  /// Calls visit(vertex, weight).
  template <typename Visit>
  DELAUNAYFLIP_HOST_DEVICE void VisitWeights(const Visit& visit) const
  {
    for (int i = 0; i < this->NumberOfWeights; ++i)
    {
      visit(this->Kept.Weights[i].Vertex, this->Kept.Weights[i].Value);
    }
  }

  DELAUNAYFLIP_HOST_DEVICE bool AreGood() const { return this->Check.IsGood(); }

private:
  static constexpr int MostTriangles = 16;

  struct Vertex
  {
    VertexId Id;
    SeenPoint Seen;
  };

  /// A triangle of the cavity.
  struct Triangle
  {
    AreaCorner Centre;
    const Triangle* Before; ///< The triangle from which this one was entered.
    AreaStep Step; ///< From that one's centre to this one's.
  };

  /// An edge of a triangle of the cavity.
  struct Edge
  {
    CornerId Opposite;
    const Vertex* From;
    const Vertex* To;
    const Triangle* Owner;
    CrossProduct Cross; ///< That of the offsets of its ends.
  };

  struct Weight
  {
    VertexId Vertex;
    double Value;
  };

public:
  struct Arrays
  {
    Vertex Vertices[MostTriangles + 3];
    Edge Edges[MostTriangles + 3]; ///< Edges to go across; the next one is last.
    Triangle Triangles[MostTriangles];
    Weight Weights[MostTriangles + 2];
  };

private:
  /// Begins with the triangle that has the place.
  DELAUNAYFLIP_HOST_DEVICE DELAUNAYFLIP_ALWAYS_INLINE void Begin(TriangleId triangle)
  {
    const Vertex* ends[3];
    for (int slot = 0; slot < 3; ++slot)
    {
      ends[slot] = this->See(MakeCorner(triangle, slot));
      ++this->NumberOfVertices;
    }
    this->Kept.Triangles[0].Centre =
      FindCentre(this->Seen, ends[0]->Seen.Point, ends[1]->Seen.Point, ends[2]->Seen.Point);
    this->NumberOfTriangles = 1;
    for (const int slot : { 2, 1, 0 })
    {
      const Vertex* from = ends[NextSlot(slot)];
      const Vertex* to = ends[PreviousSlot(slot)];
      this->Push(
        { MakeCorner(triangle, slot), from, to, this->Kept.Triangles, FindCross(from, to) });
    }
  }

  /// Stores the vertex of a corner after the others.
  DELAUNAYFLIP_HOST_DEVICE DELAUNAYFLIP_ALWAYS_INLINE const Vertex* See(CornerId corner)
  {
    Vertex* vertex = this->Kept.Vertices + this->NumberOfVertices;
    vertex->Id = this->Seen.GetVertex(corner);
    vertex->Seen = SeenPoint(this->Seen.GetPoint(vertex->Id), this->Seen.GetPlace());
    return vertex;
  }

  DELAUNAYFLIP_HOST_DEVICE static CrossProduct FindCross(const Vertex* from, const Vertex* to)
  {
    return CrossProduct(from->Seen.Offset, to->Seen.Offset);
  }

  DELAUNAYFLIP_HOST_DEVICE DELAUNAYFLIP_ALWAYS_INLINE void Push(const Edge& edge)
  {
    this->Kept.Edges[this->NumberOfEdges] = edge;
    ++this->NumberOfEdges;
  }

  /// Goes back to a triangle that was entered before.
  DELAUNAYFLIP_HOST_DEVICE DELAUNAYFLIP_ALWAYS_INLINE void ReturnTo(const Triangle* triangle)
  {
    while (this->Current != triangle)
    {
      const Triangle& left = *this->Current;
      this->Twice = left.Step.AddBack(this->Twice, left.Centre, left.Before->Centre);
      this->Current = left.Before;
    }
  }

  /// Enters the triangle across an edge.
  /// @param edge becomes the next one of that triangle.
  /// @returns whether there is one in the cavity.
  DELAUNAYFLIP_HOST_DEVICE DELAUNAYFLIP_ALWAYS_INLINE bool GoAcross(Edge& edge)
  {
    const CornerId across = this->Seen.FindBeyond(edge.Opposite);
    if (across == NoCorner)
    {
      return false;
    }
    const Vertex* apex = this->See(across);
    const CrossProduct first = FindCross(edge.From, apex), second = FindCross(apex, edge.To);
    if (!this->IsInCircle(edge, first, second, apex, across))
    {
      return false;
    }
    this->Enter(edge, apex, SlotOf(across));
    this->Push({ PlaneMesh::Previous(across), apex, edge.To, this->Current, second });
    edge = { PlaneMesh::Next(across), edge.From, apex, this->Current, first };
    return true;
  }

  /// Whether the place is in the circle through an edge and a vertex beyond.
  /// @param first, second the cross products of the edges to and from that vertex.
  DELAUNAYFLIP_HOST_DEVICE DELAUNAYFLIP_ALWAYS_INLINE bool IsInCircle(const Edge& edge,
    const CrossProduct& first, const CrossProduct& second, const Vertex* apex,
    CornerId across) const
  {
    constexpr double LargestSquare = 1.6e60; // 2^200: no underflow spoils what is certain
    const double a = apex->Seen.Square;
    const double b = edge.To->Seen.Square, c = edge.From->Seen.Square;
    const double determinant = b * first.Value + c * second.Value - a * edge.Cross.Value;
    // The magnitude of a cross product is at most the product of the lengths. So this is at least
    // the permanent, which takes longer.
    const double most = b * c + a * (b + c);
    if (std::fabs(determinant) > GetBound(InCircleBound * most) && a + b + c < LargestSquare)
    {
      return determinant > 0.0;
    }
    return this->Seen.IsInCircle(across);
  }

  /// Enters the triangle of an edge and a vertex beyond, which is at a slot.
  DELAUNAYFLIP_HOST_DEVICE DELAUNAYFLIP_ALWAYS_INLINE void Enter(
    const Edge& edge, const Vertex* apex, int slot)
  {
    const Vertex* ring[5] = { edge.To, edge.From, apex, edge.To, edge.From };
    const Vertex** first = ring + 2 - slot; // the vertex of slot 0
    Triangle* entered = this->Kept.Triangles + this->NumberOfTriangles;
    entered->Centre =
      FindCentre(this->Seen, first[0]->Seen.Point, first[1]->Seen.Point, first[2]->Seen.Point);
    entered->Before = edge.Owner;
    entered->Step = AreaStep(edge.Owner->Centre, entered->Centre);
    this->Twice = entered->Step.Add(this->Twice);
    this->Current = entered;
    ++this->NumberOfTriangles;
    ++this->NumberOfVertices;
  }

  /// Ends the area of the vertex where a boundary edge begins, and begins the one where it ends.
  DELAUNAYFLIP_HOST_DEVICE DELAUNAYFLIP_ALWAYS_INLINE void AddBoundaryEdge(const Edge& edge)
  {
    const AreaCorner& centre = edge.Owner->Centre;
    const AreaCorner ofNew =
      FindCentre(this->Seen.GetPlace(), edge.From->Seen, edge.To->Seen, edge.Cross);
    const AreaStep step(centre, ofNew);
    if (this->IsBegun)
    {
      this->AddWeight(step, edge.From, ofNew);
    }
    else
    {
      this->IsBegun = true;
      this->OwnerOfFirst = edge.Owner;
      this->StepOfFirst = step;
      this->FromOfFirst = edge.From;
      this->CentreOfFirst = ofNew;
    }
    this->Twice = step.AddBack(0.0, ofNew, centre);
    this->Last = ofNew;
  }

  /// Ends the area of a vertex.
  /// @param step to the last corner of the area. @param corner that corner.
  DELAUNAYFLIP_HOST_DEVICE DELAUNAYFLIP_ALWAYS_INLINE void AddWeight(
    const AreaStep& step, const Vertex* vertex, const AreaCorner& corner)
  {
    const double weight = AreaStep(corner, this->Last).Add(step.Add(this->Twice));
    this->Check.Add(weight, vertex->Seen.Offset);
    this->Kept.Weights[this->NumberOfWeights] = { vertex->Id, weight };
    ++this->NumberOfWeights;
  }

  /// Goes once more to the first edge of the boundary.
  DELAUNAYFLIP_HOST_DEVICE DELAUNAYFLIP_ALWAYS_INLINE void End()
  {
    this->ReturnTo(this->Kept.Triangles);
    while (this->Current != this->OwnerOfFirst) // Triangles begin with those on the way there
    {
      ++this->Current;
      this->Twice = this->Current->Step.Add(this->Twice);
    }
    this->AddWeight(this->StepOfFirst, this->FromOfFirst, this->CentreOfFirst);
  }

  const Frame& Seen;
  Arrays& Kept;
  WeightCheck Check;
  int NumberOfVertices = 0, NumberOfEdges = 0, NumberOfTriangles = 0, NumberOfWeights = 0;
  const Triangle* Current; ///< The triangle that the tour is in.
  double Twice = 0.0; ///< The area of a vertex, so far.
  AreaCorner Last; ///< The first corner of that area.
  bool IsBegun = false; ///< Whether there was an edge of the boundary.
  const Triangle* OwnerOfFirst = nullptr;
  const Vertex* FromOfFirst = nullptr;
  AreaStep StepOfFirst;
  AreaCorner CentreOfFirst;
};

}

#endif
