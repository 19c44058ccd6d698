// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_VERTEXREMOVAL_H
#define DELAUNAYFLIP_VERTEXREMOVAL_H

#include "HullChange.h"

#include <cstdint>

/// @file
/// Removes vertices from a triangulation, one after the other, on one thread. If a vertex is
/// inside, others of the same polygon replace the triangles around it. If it is on the boundary,
/// its triangles are removed, and triangles are added until the boundary is convex.

namespace delaunayflip
{

/// The triangles around a vertex, counter-clockwise. On the boundary they begin at its side.
struct VertexFan
{
  static constexpr int Most = 64;

  int Count = 0;
  VertexId Link[Most + 1]; ///< Triangle i has the vertex, Link[i] and Link[i + 1].
  HalfEdgeId Outer[Most]; ///< The half-edge of triangle i from Link[i] to Link[i + 1].
  TriangleId Triangles[Most];
  EdgeId Spokes[Most + 1]; ///< Spoke i runs to Link[i].
};

/// Sorts a few numbers in ascending order.
DELAUNAYFLIP_HOST_DEVICE inline void SortNumbers(std::uint32_t* numbers, int count)
{
  for (int i = 1; i < count; ++i)
  {
    const std::uint32_t own = numbers[i];
    int to = i;
    for (; to > 0 && numbers[to - 1] > own; --to)
    {
      numbers[to] = numbers[to - 1];
    }
    numbers[to] = own;
  }
}

/// Removes vertices. The last vertices take the numbers of removed ones.
template <typename Real>
class VertexRemover : public HullEditor
{
public:
  /// @param vertices the number of vertices. Those to remove, and as many of the last ones, must be
  /// tracked.
  DELAUNAYFLIP_HOST_DEVICE VertexRemover(
    const HullView& hull, HullSizes* sizes, Real* coordinates, VertexId* ids, std::int64_t vertices)
    : HullEditor(hull, sizes),
      Coordinates(coordinates),
      Ids(ids),
      Vertices(static_cast<VertexId>(vertices))
  {
  }

  /// Removes the first `count` of the tracked vertices.
  /// @param pending as for FillUp.
  DELAUNAYFLIP_HOST_DEVICE void Remove(std::int64_t count, VertexId* pending)
  {
    for (std::int64_t i = 0; i < count && this->Sizes.HasFailed == 0; ++i)
    {
      const TrackedVertex removed = this->Hull.Tracked[i];
      VertexFan fan;
      if (!this->Collect(removed, fan))
      {
        this->Sizes.HasFailed = 1;
      }
      else if (this->Hull.IsInside(removed.Vertex))
      {
        this->FillStar(fan);
      }
      else
      {
        this->CutFan(removed.Vertex, fan, pending);
      }
      if (this->Sizes.HasFailed == 0)
      {
        this->DropVertex(removed.Vertex);
      }
    }
    *this->Result = this->Sizes;
  }

private:
  DELAUNAYFLIP_HOST_DEVICE bool Collect(const TrackedVertex& removed, VertexFan& fan) const
  {
    CornerId first = removed.Corner;
    if (!this->Hull.IsInside(removed.Vertex))
    {
      first = this->Hull.FindCorner(removed.Vertex);
    }
    CornerId corner = first;
    do
    {
      if (fan.Count == VertexFan::Most)
      {
        return false;
      }
      const TriangleRecord& triangle = this->Edges.Triangles[TriangleOf(corner)];
      const int slot = SlotOf(corner), next = NextSlot(slot), previous = PreviousSlot(slot);
      fan.Triangles[fan.Count] = TriangleOf(corner);
      fan.Link[fan.Count] = triangle.Vertices[next];
      fan.Outer[fan.Count] = triangle.HalfEdges[slot];
      fan.Spokes[fan.Count] = EdgeOf(triangle.HalfEdges[previous]);
      ++fan.Count;
      fan.Link[fan.Count] = triangle.Vertices[previous];
      fan.Spokes[fan.Count] = EdgeOf(triangle.HalfEdges[next]);
      corner = this->Hull.Mesh.FindNextAround(corner);
    } while (corner != NoCorner && corner != first);
    return true;
  }

  //------------------------------------------------------------------------------
  // A vertex inside.

  /// Cuts ears off the polygon around the vertex until it is a triangle. Then there are two
  /// triangles and three edges fewer.
  DELAUNAYFLIP_HOST_DEVICE void FillStar(VertexFan& fan)
  {
    const int all = fan.Count;
    int made = 0;
    for (int left = all; left > 3; --left)
    {
      const int ear = this->FindEar(fan, left);
      if (ear < 0)
      {
        this->Sizes.HasFailed = 1;
        return;
      }
      const int before = (ear + left - 1) % left, after = (ear + 1) % left;
      const EdgeId diagonal = fan.Spokes[made];
      const VertexId corners[3] = { fan.Link[before], fan.Link[ear], fan.Link[after] };
      const HalfEdgeId sides[3] = { fan.Outer[ear], 2 * diagonal, fan.Outer[before] };
      this->StoreTriangle(fan.Triangles[made++], corners, sides);
      fan.Outer[before] = 2 * diagonal + 1;
      for (int i = ear; i + 1 < left; ++i)
      {
        fan.Link[i] = fan.Link[i + 1];
        fan.Outer[i] = fan.Outer[i + 1];
      }
    }
    if (this->Hull.Mesh.FindOrientation(fan.Link[0], fan.Link[1], fan.Link[2]) <= 0)
    {
      this->Sizes.HasFailed = 1;
      return;
    }
    const VertexId corners[3] = { fan.Link[0], fan.Link[1], fan.Link[2] };
    const HalfEdgeId sides[3] = { fan.Outer[1], fan.Outer[2], fan.Outer[0] };
    this->StoreTriangle(fan.Triangles[made], corners, sides);
    this->DropAll(fan.Triangles + all - 2, 2, fan.Spokes + all - 3, 3);
  }

  /// Finds an ear of a polygon: a convex corner with a triangle that has no other corner inside or
  /// on its boundary.
  /// @returns -1 if there is none.
  DELAUNAYFLIP_HOST_DEVICE int FindEar(const VertexFan& fan, int size) const
  {
    const PlaneMesh& mesh = this->Hull.Mesh;
    for (int ear = 0; ear < size; ++ear)
    {
      const int before = (ear + size - 1) % size, after = (ear + 1) % size;
      const VertexId a = fan.Link[before], b = fan.Link[ear], c = fan.Link[after];
      bool isEar = mesh.FindOrientation(a, b, c) > 0;
      for (int i = 0; i < size && isEar; ++i)
      {
        const VertexId other = fan.Link[i];
        isEar = i == before || i == ear || i == after || mesh.FindOrientation(a, b, other) < 0 ||
          mesh.FindOrientation(b, c, other) < 0 || mesh.FindOrientation(c, a, other) < 0;
      }
      if (isEar)
      {
        return ear;
      }
    }
    return -1;
  }

  DELAUNAYFLIP_HOST_DEVICE void StoreTriangle(
    TriangleId number, const VertexId (&corners)[3], const HalfEdgeId (&sides)[3])
  {
    TriangleRecord triangle = this->Edges.Triangles[number];
    for (int slot = 0; slot < 3; ++slot)
    {
      triangle.Vertices[slot] = corners[slot];
      triangle.HalfEdges[slot] = sides[slot];
      this->Edges.CornerOfHalfEdge[sides[slot]] = MakeCorner(number, slot);
      EdgeState& state = this->Edges.States[EdgeOf(sides[slot])];
      if (state != EdgeState::Fixed)
      {
        state = EdgeState::Candidate;
      }
    }
    this->Edges.Triangles[number] = triangle;
    this->Track(number);
  }

  /// Drops triangles and edges, the largest numbers first, so that the others in the lists keep
  /// their numbers.
  DELAUNAYFLIP_HOST_DEVICE void DropAll(
    TriangleId* triangles, int numberOfTriangles, EdgeId* edges, int numberOfEdges)
  {
    SortNumbers(triangles, numberOfTriangles);
    for (int i = numberOfTriangles - 1; i >= 0; --i)
    {
      this->DropTriangle(triangles[i]);
    }
    SortNumbers(edges, numberOfEdges);
    for (int i = numberOfEdges - 1; i >= 0; --i)
    {
      this->DropEdge(edges[i]);
    }
  }

  //------------------------------------------------------------------------------
  // A vertex on the boundary.

  DELAUNAYFLIP_HOST_DEVICE void CutFan(VertexId vertex, VertexFan& fan, VertexId* pending)
  {
    const int count = fan.Count;
    bool isSimple = this->Sizes.Sides + count <= this->Sizes.MostSides;
    for (int i = 0; i < count; ++i)
    {
      const bool isOpen = this->Edges.CornerOfHalfEdge[fan.Outer[i] ^ 1u] != NoCorner;
      isSimple = isSimple && isOpen && (i == 0 || this->Hull.IsInside(fan.Link[i]));
    }
    if (!isSimple) // the rest would be connected by a single vertex
    {
      this->Sizes.HasFailed = 1;
      return;
    }
    this->ReplaceSides(vertex, fan);
    this->DropAll(fan.Triangles, count, fan.Spokes, count + 1);
    for (int i = 0; i <= count; ++i)
    {
      const std::uint32_t track = this->Hull.TrackOf[fan.Link[i]];
      if (track != NoSide)
      {
        this->Hull.Tracked[track].Corner = this->Hull.FindCorner(fan.Link[i]);
      }
      pending[i] = fan.Link[i];
    }
    this->FillUp(pending, count + 1);
  }

  /// Puts the outer edges on the boundary in place of the two sides at the vertex.
  DELAUNAYFLIP_HOST_DEVICE void ReplaceSides(VertexId vertex, const VertexFan& fan)
  {
    BoundarySide* sides = this->Hull.Sides;
    const std::uint32_t own = this->Hull.SideOfVertex[vertex];
    const std::uint32_t after = sides[own].After;
    std::uint32_t number = sides[own].Before;
    this->Hull.SideOfVertex[vertex] = NoSide;
    sides[number].Edge = this->Expose(fan.Outer[fan.Count - 1]);
    for (int i = fan.Count - 2; i >= 0; --i)
    {
      std::uint32_t next = own;
      if (i < fan.Count - 2)
      {
        next = static_cast<std::uint32_t>(this->Sizes.Sides++);
      }
      sides[number].After = next;
      sides[next] = { this->Expose(fan.Outer[i]), number, after };
      this->Hull.SideOfVertex[fan.Link[i + 1]] = next;
      number = next;
    }
    sides[number].After = after;
    sides[after].Before = number;
    if (fan.Count == 1)
    {
      this->DropSide(own);
    }
  }

  //------------------------------------------------------------------------------
  /// Drops a vertex. The last vertex takes its number.
  DELAUNAYFLIP_HOST_DEVICE void DropVertex(VertexId vertex)
  {
    const VertexId last = --this->Vertices;
    if (last == vertex)
    {
      return;
    }
    const std::uint32_t track = this->Hull.TrackOf[last];
    const CornerId first = this->Hull.Tracked[track].Corner;
    const PlaneMesh& mesh = this->Hull.Mesh;
    CornerId corner = first;
    do
    {
      this->Edges.Triangles[TriangleOf(corner)].Vertices[SlotOf(corner)] = vertex;
      corner = mesh.FindNextAround(corner);
    } while (corner != NoCorner && corner != first);
    for (corner = corner == NoCorner ? mesh.FindPreviousAround(first) : NoCorner;
         corner != NoCorner; corner = mesh.FindPreviousAround(corner))
    {
      this->Edges.Triangles[TriangleOf(corner)].Vertices[SlotOf(corner)] = vertex;
    }
    this->Hull.Tracked[track].Vertex = vertex;
    this->Hull.TrackOf[vertex] = track;
    this->Hull.SideOfVertex[vertex] = this->Hull.SideOfVertex[last];
    this->Ids[vertex] = this->Ids[last];
    for (int axis = 0; axis < 2; ++axis)
    {
      this->Coordinates[std::int64_t(2) * vertex + axis] =
        this->Coordinates[std::int64_t(2) * last + axis];
    }
  }

  Real* Coordinates; ///< x and y by vertex.
  VertexId* Ids; ///< By vertex, its point.
  VertexId Vertices;
};

}

#endif
