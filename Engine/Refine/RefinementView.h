// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_REFINEMENTVIEW_H
#define DELAUNAYFLIP_REFINEMENTVIEW_H

#include "Atomics.h"
#include "PlaceWalk.h"
#include "RefinementPlan.h"
#include "TriangleShape.h"

#include <cmath>
#include <cstdint>

/// @file
/// What refinement knows of a mesh, for functions of both backends: which triangles are to be
/// improved, and which segments are to be split. Edges that the loop keeps (EdgeState::Fixed) are
/// subsegments: pieces of the segments there were at first, which include the boundary.

namespace delaunayflip
{

/// What is known of a subsegment.
enum SegmentMark : std::uint8_t
{
  SplitRequested = 1, ///< A vertex or a place is in its diametral circle, or a place beyond it.
  CannotSplit = 2, ///< It must not be split.
  FixedMeanwhile = 4, ///< It is fixed for refinement alone, and may flip afterwards.
  KeptBoundary = 8, ///< It must not be split only because FlipOptions::KeepBoundary says so.
  /// Where it was to be split, rounding would have turned a triangle over. So it is split only if a
  /// new triangle requests that.
  DoesNotFit = 16
};

/// In place of the number of a subsegment: the edge is on none.
constexpr std::uint32_t NoSegment = 0xFFFFFFFFu;
/// In place of the number of a subsegment: the edge is fixed for refinement alone.
constexpr std::uint32_t FixedForNow = 0xFFFFFFFEu;

/// What is known of a vertex.
enum CornerMark : std::uint8_t
{
  SharpCorner = 1, ///< Segments meet there at less than 60 degrees.
  LoneSharpCorner = 2 ///< A sharp corner with triangles only between its two segments.
};

/// What is known of a triangle.
enum class ShapeKind : std::uint32_t
{
  Unknown,
  Good,
  Bad,
  Left ///< Bad, but nothing can be done.
};

/// The least feature at the vertices of a triangle.
DELAUNAYFLIP_HOST_DEVICE inline double FindLeastFeature(
  const double* features, const TriangleRecord& triangle)
{
  double least = INFINITY;
  for (const VertexId vertex : triangle.Vertices)
  {
    least = features[vertex] < least ? features[vertex] : least;
  }
  return least;
}

/// The arrays of a refinement.
struct RefinementView
{
  PlaneMesh Mesh;
  RefinementGoals Goals;
  bool AreFloats; ///< Whether places have single precision.
  double Smallest; ///< Coordinates that are nearer to 0 become 0.
  /// By triangle: ShapeKind, and above it TriangleRecord::Flips at that time.
  std::uint32_t* Shapes;
  /// By triangle: the number of its region, see RemovedRegion. Null: all are in region 0.
  const std::int32_t* Regions;
  const double* AreaOfRegion; ///< The largest area there, or null.
  const double* Sizes; ///< By vertex: the longest edge there, or null.
  const EdgeId* Segments; ///< The edges that are subsegments.
  std::uint8_t* Marks; ///< By subsegment: SegmentMarks.
  const std::uint32_t* Origins; ///< By subsegment: the number of its segment.
  /// By fixed edge: the number of its subsegment or, in a mesh of the caller, NoSegment or
  /// FixedForNow.
  const std::uint32_t* SegmentOfEdge;
  const std::uint32_t* OriginOfVertex; ///< By vertex: the segment that it has split, or NoOrigin.
  const VertexId* Ends; ///< By segment, two.
  const std::uint8_t* IsSharp; ///< By vertex: CornerMark, or 0.
  /// By vertex: the square of the least feature there. Null: see RefinementGoals::MayNotEnd.
  const double* Features;

  DELAUNAYFLIP_HOST_DEVICE bool IsKept(TriangleId triangle) const
  {
    return !this->Regions || this->Regions[triangle] >= 0;
  }

  //------------------------------------------------------------------------------
  // Triangles.

  DELAUNAYFLIP_HOST_DEVICE std::uint32_t GetFlips(TriangleId triangle) const
  {
    return this->Mesh.Edges.Triangles[triangle].Flips / OneFlip;
  }
  DELAUNAYFLIP_HOST_DEVICE ShapeKind GetShape(TriangleId triangle) const
  {
    return static_cast<ShapeKind>(this->Shapes[triangle] % OneFlip);
  }
  DELAUNAYFLIP_HOST_DEVICE void SetShape(TriangleId triangle, ShapeKind kind) const
  {
    this->Shapes[triangle] = this->GetFlips(triangle) * OneFlip + static_cast<std::uint32_t>(kind);
  }
  /// Whether a triangle has not changed since it was judged.
  DELAUNAYFLIP_HOST_DEVICE bool IsJudged(TriangleId triangle) const
  {
    const std::uint32_t shape = this->Shapes[triangle];
    return shape / OneFlip == this->GetFlips(triangle) &&
      static_cast<ShapeKind>(shape % OneFlip) != ShapeKind::Unknown;
  }

  /// Finds what is known of a triangle, or judges it.
  DELAUNAYFLIP_HOST_DEVICE ShapeKind FindShape(TriangleId triangle) const
  {
    if (this->IsJudged(triangle))
    {
      return this->GetShape(triangle);
    }
    if (!this->IsKept(triangle))
    {
      return ShapeKind::Good;
    }
    const TriangleShape shape(this->Mesh, triangle);
    if (!shape.IsMeasurable())
    {
      return ShapeKind::Left;
    }
    const bool isSharp = shape.IsSharperThan(this->Goals.Cotangent);
    if (this->IsTooLarge(triangle, shape))
    {
      return ShapeKind::Bad;
    }
    if (isSharp)
    {
      const bool isLeft = this->IsFlat(shape) || this->IsAcrossSharpCorner(triangle, shape) ||
        this->IsBelowFeatures(triangle, shape);
      return isLeft ? ShapeKind::Left : ShapeKind::Bad;
    }
    return ShapeKind::Good;
  }

  /// Whether the height of a triangle is only a few roundings. Places near it are rounded so much
  /// that angles there need not get better, and refinement might not end.
  DELAUNAYFLIP_HOST_DEVICE bool IsFlat(const TriangleShape& shape) const
  {
    const double least = this->GetLeastHeight(shape.From);
    return shape.Cross * shape.Cross < least * least * shape.SquaredLongest;
  }

  /// Judges a triangle if it has changed, and requests that its subsegments are split if the
  /// opposite vertices encroach upon them. No other vertices need be tested: because the mesh is
  /// constrained Delaunay, the opposite vertices are the nearest to the middle of a subsegment.
  DELAUNAYFLIP_HOST_DEVICE ShapeKind Judge(TriangleId triangle) const
  {
    const bool isNew = !this->IsJudged(triangle);
    const ShapeKind kind = this->FindShape(triangle);
    if (isNew)
    {
      this->SetShape(triangle, kind);
      for (int slot = 0; slot < 3 && this->IsKept(triangle); ++slot)
      {
        const CornerId corner = MakeCorner(triangle, slot);
        const HalfEdgeId side = this->Mesh.GetHalfEdge(corner);
        if (this->Mesh.IsFixed(side) &&
          this->IsEncroached(side, this->Mesh.GetPoint(this->Mesh.GetVertex(corner))))
        {
          this->Request(side);
        }
      }
    }
    return kind;
  }

  DELAUNAYFLIP_HOST_DEVICE bool IsTooLarge(TriangleId triangle, const TriangleShape& shape) const
  {
    return this->HasTooMuchArea(triangle, shape) || this->IsTooLong(triangle, shape);
  }

  DELAUNAYFLIP_HOST_DEVICE bool HasTooMuchArea(
    TriangleId triangle, const TriangleShape& shape) const
  {
    double area = this->Goals.Area;
    if (this->AreaOfRegion)
    {
      const double ofRegion = this->AreaOfRegion[GetRegion(this->Regions[triangle])];
      area = ofRegion < area ? ofRegion : area;
    }
    return shape.GetArea() > area;
  }

  DELAUNAYFLIP_HOST_DEVICE bool IsTooLong(TriangleId triangle, const TriangleShape& shape) const
  {
    return shape.SquaredLongest > this->FindLongestEdge(triangle);
  }

  /// The square of the longest edge that a triangle may have.
  DELAUNAYFLIP_HOST_DEVICE double FindLongestEdge(TriangleId triangle) const
  {
    double longest = this->Goals.SquaredEdge;
    if (this->Sizes)
    {
      const VertexId* vertices = this->Mesh.Edges.Triangles[triangle].Vertices;
      const double size =
        (this->Sizes[vertices[0]] + this->Sizes[vertices[1]] + this->Sizes[vertices[2]]) / 3.0;
      longest = size * size < longest ? size * size : longest;
    }
    return longest;
  }

  /// Whether a point at the centroid of a triangle helps, where its circumcenter is beyond a
  /// subsegment that cannot be split. It does if the triangle is too large, or if it is not thin
  /// and one of its edges is too long but can get shorter. Then the point is so far from all edges
  /// of the triangle, and so from all other points, that refinement ends.
  DELAUNAYFLIP_HOST_DEVICE bool CanSplitInside(TriangleId triangle) const
  {
    constexpr double Thin = 0.1; // the height over the longest edge, in lengths of that edge
    const TriangleShape shape(this->Mesh, triangle);
    if (this->HasTooMuchArea(triangle, shape))
    {
      return true;
    }
    const double longest = this->FindLongestEdge(triangle);
    bool isTooLong = false;
    for (int slot = 0; slot < 3; ++slot)
    {
      const HalfEdgeId side = this->Mesh.GetHalfEdge(MakeCorner(triangle, slot));
      const double squared =
        TriangleShape::GetSquaredDistance(this->Mesh.GetPoint(this->Mesh.GetStart(side)),
          this->Mesh.GetPoint(this->Mesh.GetEnd(side)));
      const bool mayChange = !this->Mesh.IsFixed(side) || this->CanSplit(side);
      isTooLong = isTooLong || (mayChange && squared > longest);
    }
    return isTooLong && shape.Cross > Thin * shape.SquaredLongest;
  }

  /// Whether a triangle is left as it is because its shortest edge connects two segments that meet
  /// at a small angle, at equal distances from their corner. The angle at the corner itself cannot
  /// get better. Farther from the corner angles can, with about as many points as the inverse of
  /// the angle in radians, but only if no other triangles are at the corner. Otherwise refinement
  /// might not end: small triangles on one side of a segment make those on the other side smaller.
  DELAUNAYFLIP_HOST_DEVICE bool IsAcrossSharpCorner(
    TriangleId triangle, const TriangleShape& shape) const
  {
    const VertexId* vertices = this->Mesh.Edges.Triangles[triangle].Vertices;
    const std::uint32_t a = this->OriginOfVertex[vertices[NextSlot(shape.Slot)]];
    const std::uint32_t b = this->OriginOfVertex[vertices[PreviousSlot(shape.Slot)]];
    if (a == b || a == NoOrigin || b == NoOrigin)
    {
      return false;
    }
    for (int i = 0; i < 4; ++i)
    {
      const VertexId corner = this->Ends[2 * std::size_t(a) + i / 2];
      const bool isCommon = corner == this->Ends[2 * std::size_t(b) + i % 2];
      if (isCommon && this->IsSharp[corner] != 0)
      {
        constexpr double Close = 1.001; // ratio of squared distances, as in the program Triangle
        constexpr double SquaredDegree = 3.046e-4; // the square of a degree in radians
        const PlanePoint place = this->Mesh.GetPoint(corner);
        const double from = TriangleShape::GetSquaredDistance(place, shape.From);
        const double to = TriangleShape::GetSquaredDistance(place, shape.To);
        const bool canRefine = this->IsSharp[corner] == LoneSharpCorner &&
          corner != vertices[shape.Slot] && shape.SquaredShortest > SquaredDegree * from;
        return !canRefine && from < Close * to && to < Close * from;
      }
    }
    return false;
  }

  /// Whether a triangle is left as it is because it is far smaller than the features of the input
  /// there. Where the angle of a corner is hardly more than a multiple of the goal, triangles that
  /// fill it may not be found, and refinement would go on towards the corner.
  DELAUNAYFLIP_HOST_DEVICE bool IsBelowFeatures(
    TriangleId triangle, const TriangleShape& shape) const
  {
    constexpr double Share = 0x1p-12; // the square of 1/64
    return this->Features &&
      shape.SquaredLongest <
      Share * FindLeastFeature(this->Features, this->Mesh.Edges.Triangles[triangle]);
  }

  // Threads prefetch the data around a triangle in five stages. Each is found by means of the one
  // before it, so it is prefetched some items later. Later rounds insert so few vertices that all
  // data around each comes from memory, and then most of the time is spent waiting for it.
  static constexpr std::int64_t Second = 7, Third = 14, Fourth = 20, Fifth = 26;

  void PrefetchTriangle(TriangleId triangle) const
  {
    Prefetch(&this->Mesh.Edges.Triangles[triangle]);
    Prefetch(&this->Shapes[triangle]);
    if (this->Regions)
    {
      Prefetch(&this->Regions[triangle]);
    }
  }
  void PrefetchCorners(TriangleId triangle) const
  {
    const TriangleRecord& record = this->Mesh.Edges.Triangles[triangle];
    for (int slot = 0; slot < 3; ++slot)
    {
      this->Mesh.PrefetchPoint(record.Vertices[slot]);
      this->PrefetchEdge(record.HalfEdges[slot]);
    }
  }
  void PrefetchNeighbors(TriangleId triangle) const
  {
    for (const HalfEdgeId side : this->Mesh.Edges.Triangles[triangle].HalfEdges)
    {
      this->PrefetchTriangleAcross(side);
    }
  }
  /// The vertices beyond the edges of a triangle, and the other edges there.
  void PrefetchBeyond(TriangleId triangle) const
  {
    for (const HalfEdgeId side : this->Mesh.Edges.Triangles[triangle].HalfEdges)
    {
      const CornerId across = this->Mesh.Edges.CornerOfHalfEdge[side ^ 1u];
      if (across != NoCorner)
      {
        const TriangleRecord& record = this->Mesh.Edges.Triangles[TriangleOf(across)];
        const int slot = SlotOf(across);
        this->Mesh.PrefetchPoint(record.Vertices[slot]);
        this->PrefetchEdge(record.HalfEdges[NextSlot(slot)]);
        this->PrefetchEdge(record.HalfEdges[PreviousSlot(slot)]);
      }
    }
  }
  /// The triangles beyond those edges.
  void PrefetchSecondNeighbors(TriangleId triangle) const
  {
    for (const HalfEdgeId side : this->Mesh.Edges.Triangles[triangle].HalfEdges)
    {
      const CornerId across = this->Mesh.Edges.CornerOfHalfEdge[side ^ 1u];
      if (across != NoCorner)
      {
        const TriangleRecord& record = this->Mesh.Edges.Triangles[TriangleOf(across)];
        const int slot = SlotOf(across);
        this->PrefetchTriangleAcross(record.HalfEdges[NextSlot(slot)]);
        this->PrefetchTriangleAcross(record.HalfEdges[PreviousSlot(slot)]);
      }
    }
  }

  void PrefetchEdge(HalfEdgeId side) const
  {
    Prefetch(&this->Mesh.Edges.CornerOfHalfEdge[side ^ 1u]);
    Prefetch(&this->Mesh.Edges.States[EdgeOf(side)]);
  }
  void PrefetchTriangleAcross(HalfEdgeId side) const
  {
    const CornerId across = this->Mesh.Edges.CornerOfHalfEdge[side ^ 1u];
    if (across != NoCorner)
    {
      this->PrefetchTriangle(TriangleOf(across));
    }
  }

  //------------------------------------------------------------------------------
  // Subsegments.

  /// Whether a place is inside the diametral circle of an edge.
  DELAUNAYFLIP_HOST_DEVICE bool IsInDiametralCircle(HalfEdgeId side, const PlanePoint& place) const
  {
    const PlanePoint a = this->Mesh.GetPoint(this->Mesh.GetStart(side));
    const PlanePoint b = this->Mesh.GetPoint(this->Mesh.GetEnd(side));
    return (a.U - place.U) * (b.U - place.U) + (a.V - place.V) * (b.V - place.V) < 0.0;
  }

  /// Whether a vertex encroaches upon an edge: it is inside the diametral circle, but not within a
  /// few roundings of the edge. Two segments so near to each other would split each other until
  /// their pieces are as short.
  DELAUNAYFLIP_HOST_DEVICE bool IsEncroached(HalfEdgeId side, const PlanePoint& place) const
  {
    if (!this->IsInDiametralCircle(side, place))
    {
      return false;
    }
    const PlanePoint a = this->Mesh.GetPoint(this->Mesh.GetStart(side));
    const PlanePoint b = this->Mesh.GetPoint(this->Mesh.GetEnd(side));
    const double cross = (a.U - place.U) * (b.V - place.V) - (a.V - place.V) * (b.U - place.U);
    const double least = this->GetLeastHeight(place);
    return cross * cross >= least * least * TriangleShape::GetSquaredDistance(a, b);
  }

  /// Returns a half-edge of a subsegment that has a triangle.
  DELAUNAYFLIP_HOST_DEVICE HalfEdgeId GetSide(std::int64_t segment) const
  {
    const HalfEdgeId side = 2 * this->Segments[segment];
    return this->Mesh.Edges.CornerOfHalfEdge[side] != NoCorner ? side : side + 1;
  }

  DELAUNAYFLIP_HOST_DEVICE bool CanSplit(HalfEdgeId side) const
  {
    const std::uint32_t segment = this->SegmentOfEdge[EdgeOf(side)];
    if (segment >= FixedForNow)
    {
      return false;
    }
    const int marks = AtomicLoad(&this->Marks[segment]);
    const bool fits = (marks & DoesNotFit) == 0 || (marks & SplitRequested) != 0;
    return fits && (marks & CannotSplit) == 0;
  }

  /// Whether FlipOptions::KeepBoundary alone forbids that a subsegment is split.
  DELAUNAYFLIP_HOST_DEVICE bool IsKeptBoundary(HalfEdgeId side) const
  {
    const std::uint32_t segment = this->SegmentOfEdge[EdgeOf(side)];
    return segment < FixedForNow && (AtomicLoad(&this->Marks[segment]) & KeptBoundary) != 0;
  }

  /// Requests that a subsegment is split.
  DELAUNAYFLIP_HOST_DEVICE void Request(HalfEdgeId side) const
  {
    const std::uint32_t segment = this->SegmentOfEdge[EdgeOf(side)];
    if (segment >= FixedForNow)
    {
      return;
    }
    std::uint8_t* marks = &this->Marks[segment];
    AtomicStore(marks, static_cast<std::uint8_t>(AtomicLoad(marks) | SplitRequested));
  }

  /// Whether a subsegment is to be split.
  DELAUNAYFLIP_HOST_DEVICE bool HasToSplit(std::int64_t segment) const
  {
    return (this->Marks[segment] & ~DoesNotFit) == SplitRequested;
  }

  /// Finds where a subsegment is split: in the middle or, if its segment ends at a sharp corner, at
  /// a simple distance from that corner. So all segments of the corner are split at the same
  /// distances from it, and no piece is in the diametral circle of another one. These are Ruppert's
  /// concentric shells, with simple distances in between, too.
  DELAUNAYFLIP_HOST_DEVICE PlanePoint FindSplit(std::int64_t segment) const
  {
    const HalfEdgeId side = this->GetSide(segment);
    const VertexId start = this->Mesh.GetStart(side), end = this->Mesh.GetEnd(side);
    const PlanePoint a = this->Mesh.GetPoint(start), b = this->Mesh.GetPoint(end);
    const PlanePoint middle = { a.U + 0.5 * (b.U - a.U), a.V + 0.5 * (b.V - a.V), 0.0 };
    const VertexId* ends = this->Ends + 2 * std::size_t(this->Origins[segment]);
    const bool isSharp[2] = { this->IsSharp[ends[0]] != 0, this->IsSharp[ends[1]] != 0 };
    const bool isWhole =
      (start == ends[0] && end == ends[1]) || (start == ends[1] && end == ends[0]);
    const bool needsMiddle = isSharp[0] == isSharp[1] && (isWhole || !isSharp[0]);
    if (needsMiddle)
    {
      return this->Round(middle);
    }
    const PlanePoint places[2] = { this->Mesh.GetPoint(ends[0]), this->Mesh.GetPoint(ends[1]) };
    int corner = isSharp[0] ? 0 : 1;
    if (isSharp[0] && isSharp[1])
    {
      const double first = TriangleShape::GetSquaredDistance(places[0], middle);
      corner = first < TriangleShape::GetSquaredDistance(places[1], middle) ? 0 : 1;
    }
    const PlanePoint &from = places[corner], &to = places[1 - corner];
    const double length = std::sqrt(TriangleShape::GetSquaredDistance(from, to));
    const double one = std::sqrt(TriangleShape::GetSquaredDistance(from, a));
    const double other = std::sqrt(TriangleShape::GetSquaredDistance(from, b));
    const double quarter = 0.25 * (other - one); // negative if b is nearer
    const double low = one + quarter, high = other - quarter;
    const double share = FindSimplest(low < high ? low : high, low < high ? high : low) / length;
    return this->Round({ from.U + share * (to.U - from.U), from.V + share * (to.V - from.V), 0.0 });
  }

  /// The number between two positive ones that is a multiple of the largest power of two.
  DELAUNAYFLIP_HOST_DEVICE static double FindSimplest(double low, double high)
  {
    constexpr double Largest = 1e300, MostSteps = 0x1p50;
    double power = 1.0;
    while (power <= high && power < Largest)
    {
      power *= 2.0;
    }
    while (power > high && power > 1.0 / Largest)
    {
      power *= 0.5;
    }
    double steps = high / power;
    while (steps < MostSteps)
    {
      const double multiple = power * static_cast<double>(static_cast<std::int64_t>(steps));
      if (multiple >= low)
      {
        return multiple;
      }
      power *= 0.5;
      steps = high / power;
    }
    return 0.5 * (low + high);
  }

  /// At least how far coordinates of the same size are from each other.
  DELAUNAYFLIP_HOST_DEVICE double GetRounding(const PlanePoint& place) const
  {
    const double u = std::fabs(place.U), v = std::fabs(place.V);
    return (u > v ? u : v) * (this->AreFloats ? 0x1p-23 : 0x1p-52);
  }

  /// The height of triangles below which they are left as they are. Points in single precision may
  /// be only a few roundings from each other, such as those of a scan with large coordinates.
  DELAUNAYFLIP_HOST_DEVICE double GetLeastHeight(const PlanePoint& place) const
  {
    constexpr double OfFloats = 4.0, OfDoubles = 32.0; // in roundings
    return (this->AreFloats ? OfFloats : OfDoubles) * this->GetRounding(place);
  }

  /// A place in the precision of the others.
  DELAUNAYFLIP_HOST_DEVICE PlanePoint Round(const PlanePoint& place) const
  {
    return { this->Round(place.U), this->Round(place.V), 0.0 };
  }
  DELAUNAYFLIP_HOST_DEVICE double Round(double coordinate) const
  {
    if (std::fabs(coordinate) < this->Smallest)
    {
      return 0.0;
    }
    return this->AreFloats ? double(static_cast<float>(coordinate)) : coordinate;
  }
};

}

#endif
