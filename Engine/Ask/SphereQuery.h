// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_SPHEREQUERY_H
#define DELAUNAYFLIP_SPHEREQUERY_H

#include "PlaceQuery.h"
#include "SphereFrame.h"

#include <cmath>
#include <cstdint>

/// @file
/// What both backends do for one place on a sphere. SphereAsker.h makes what is asked.

namespace delaunayflip
{

/// Where a direction is on the square of an unfolded octahedron. Nearby directions are nearby
/// there, except across four edges.
DELAUNAYFLIP_HOST_DEVICE inline PlanePoint UnfoldDirection(const Vector3& direction)
{
  const double sum = std::fabs(direction.X) + std::fabs(direction.Y) + std::fabs(direction.Z);
  const double u = direction.X / sum, v = direction.Y / sum;
  if (!(direction.Z < 0.0))
  {
    return { u, v, 0.0 };
  }
  return { std::copysign(1.0 - std::fabs(v), u), std::copysign(1.0 - std::fabs(u), v), 0.0 };
}

/// A cap of the sphere. It has all places on the edges of a group.
struct BoundaryCap
{
  Vector3 Center;
  double Radius; ///< A distance in space.
};

/// The boundary of the triangles that a run has kept.
struct SphereBoundaryView
{
  static constexpr std::int64_t GroupSize = 32;

  const Vector3* Directions; ///< By point.
  const BoundaryEdge* Edges;
  std::int64_t NumberOfEdges;
  const BoundaryCap* Caps; ///< One for each group of edges.

  DELAUNAYFLIP_HOST_DEVICE std::int64_t CountGroups() const
  {
    return (this->NumberOfEdges + GroupSize - 1) / GroupSize;
  }

  /// There must be edges.
  DELAUNAYFLIP_HOST_DEVICE NearestOnBoundary FindNearest(const Vector3& place) const
  {
    NearestOnBoundary nearest{ this->Edges[0], 0.0 };
    double least = INFINITY;
    for (std::int64_t group = 0; group < this->CountGroups(); ++group)
    {
      const BoundaryCap& cap = this->Caps[group];
      const double distance = Length(cap.Center - place) - cap.Radius;
      if (distance > 0.0 && distance * distance >= least)
      {
        continue;
      }
      const std::int64_t end = std::min(this->NumberOfEdges, (group + 1) * GroupSize);
      for (std::int64_t i = group * GroupSize; i < end; ++i)
      {
        this->Offer(place, this->Edges[i], least, nearest);
      }
    }
    return nearest;
  }

private:
  /// Takes an edge if it is nearer than the nearest one so far.
  DELAUNAYFLIP_HOST_DEVICE void Offer(
    const Vector3& place, const BoundaryEdge& edge, double& least, NearestOnBoundary& nearest) const
  {
    const Vector3& from = this->Directions[edge.From];
    const Vector3& to = this->Directions[edge.To];
    const auto offer = [&](const Vector3& near, double share)
    {
      const Vector3 offset = near - place;
      const double square = Dot(offset, offset);
      if (square < least)
      {
        least = square;
        nearest = { edge, share };
      }
    };
    offer(from, 0.0);
    offer(to, 1.0);
    const Vector3 normal = Cross(from, to - from);
    const double ofFrom = Dot(Cross(place, to), normal);
    const double ofTo = Dot(Cross(from, place), normal);
    if (ofFrom > 0.0 && ofTo > 0.0)
    {
      const double share = ofTo / (ofFrom + ofTo);
      offer(FindDirection(Vector3{ (1.0 - share) * from.X + share * to.X,
              (1.0 - share) * from.Y + share * to.Y, (1.0 - share) * from.Z + share * to.Z }),
        share);
    }
  }
};

/// A triangulation on a sphere that can be asked.
struct AskedSphere
{
  /// Without the triangles that cannot have places: across an edge of its boundary there is no
  /// triangle. Together these triangles are convex, or they are the whole sphere.
  SphereMesh Mesh;
  DirectedMesh Seen; ///< By frames: across a segment there is no triangle.
  const std::int32_t* Numbers; ///< By triangle, that in the output, -1 if removed; null: its own.
  PlaceGridView Grid; ///< Where walks begin.
  bool HasPlaces; ///< Whether any triangle can have places.
  SphereBoundaryView Boundary; ///< Without edges: what is outside has no value.
  std::int32_t* Failed; ///< Becomes 1 if a device cannot decide an orientation.

  /// The number of a triangle in the output, or -1.
  DELAUNAYFLIP_HOST_DEVICE std::int32_t GetNumber(TriangleId triangle) const
  {
    return this->Numbers ? this->Numbers[triangle] : static_cast<std::int32_t>(triangle);
  }

  /// Finds a place. It is outside if its triangles are removed.
  /// @param direction of the place; NaN for one that is outside by itself.
  /// @param last as for PlaceGridView::FindStart.
  DELAUNAYFLIP_HOST_DEVICE FoundPlace Find(
    const PlanePoint& place, const Vector3& direction, LastPlace& last) const
  {
    if (!this->HasPlaces || !IsFinite(Dot(direction, direction)))
    {
      return FoundPlace();
    }
    const FoundPlace found =
      this->Walk(place, this->Grid.FindStart(UnfoldDirection(direction), last));
    last.Triangle = found.Triangle;
    if (found.IsOutside() || (found.OnEdges == 0 && !this->Numbers))
    {
      return found;
    }
    return ChooseTriangle(this->Mesh, found, this->Numbers);
  }

  DELAUNAYFLIP_HOST_DEVICE void Interpolate(const AskedValues& values, const Vector3& direction,
    const FoundPlace& found, double* result) const
  {
    if (found.IsOutside())
    {
      this->TakeNearest(values, direction, result);
      return;
    }
    // At vertices, on the boundary and on segments there are no natural weights. Each branch makes
    // its own frame, as AskedValues::Interpolate does.
    double linearShare = 1.0;
    if (values.IsNatural && found.FindVertexSlot() < 0)
    {
      linearShare = values.TakeNatural(
        SphereFrame(this->Seen, direction, found.Triangle, TangentKind::Stereographic),
        found.Triangle, result);
    }
    if (linearShare > 0.0)
    {
      values.AddLinear(
        SphereFrame(this->Seen, direction, found.Triangle, TangentKind::Orthographic), found,
        linearShare, result);
    }
  }

private:
  /// Does what WalkToPlace does.
  DELAUNAYFLIP_HOST_DEVICE FoundPlace Walk(const PlanePoint& place, TriangleId start) const
  {
    FoundPlace found;
    found.Triangle = start;
    std::uint32_t random = start;
    for (;;)
    {
      int beyond = 0;
      found.OnEdges = 0;
      for (int slot = 0; slot < 3; ++slot)
      {
        const int side = this->Mesh.FindSide(place, MakeCorner(found.Triangle, slot));
#if DELAUNAYFLIP_ON_DEVICE
        if (side == UncertainSign)
        {
          *this->Failed = 1;
          return FoundPlace();
        }
#endif
        beyond |= int(side < 0) << slot;
        found.OnEdges |= int(side == 0) << slot;
      }
      if (beyond == 0)
      {
        return found;
      }
      random = random * 1664525u + 1013904223u; // Numerical Recipes' generator
      const int slot = FindFirstSlot(beyond, static_cast<int>((random >> 16) % 3));
      const CornerId across = this->Mesh.FindBeyond(MakeCorner(found.Triangle, slot));
      if (across == NoCorner)
      {
        return FoundPlace();
      }
      found.Triangle = TriangleOf(across);
    }
  }

  DELAUNAYFLIP_HOST_DEVICE void TakeNearest(
    const AskedValues& values, const Vector3& direction, double* result) const
  {
    if (this->Boundary.NumberOfEdges == 0 || !IsFinite(Dot(direction, direction)))
    {
      values.Fill(result, NAN);
      return;
    }
    const NearestOnBoundary nearest = this->Boundary.FindNearest(direction);
    values.TakeAlong(nearest.Edge, nearest.ShareOfTo, result);
  }
};

/// Answers some places of a block.
struct AnswerOnSphere
{
  AskedSphere Asked;
  AskedValues Values;
  PlaceBlock Block;
  bool Degrees; ///< PlaceQuery::Degrees.

  DELAUNAYFLIP_HOST_DEVICE void operator()(std::int64_t i) const { (*this)(i, i + 1); }

  DELAUNAYFLIP_HOST_DEVICE void operator()(std::int64_t begin, std::int64_t end) const
  {
    LastPlace last;
    for (std::int64_t i = begin; i < end; ++i)
    {
      const PlanePoint place = this->GetPlace(i);
      const Vector3 direction = FindDirection(place);
      const FoundPlace found = this->Asked.Find(place, direction, last);
      if (this->Block.Triangles)
      {
        this->Block.Triangles[i] = found.IsOutside() ? -1 : this->Asked.GetNumber(found.Triangle);
      }
      if (this->Block.Results)
      {
        double* const result = this->Block.Results + i * this->Values.Components;
        this->Asked.Interpolate(this->Values, direction, found, result);
      }
    }
  }

  DELAUNAYFLIP_HOST_DEVICE PlanePoint GetPlace(std::int64_t i) const
  {
    const PlanePoint given = this->Block.GetPlace(i);
    const bool areAngles = this->Block.Raster.Columns > 0 || this->Degrees;
    return areAngles ? FindPlaceOnSphere(given.U, given.V)
                     : PlanePoint{ given.U, given.V, this->Block.Places.Get(i, 2) };
  }
};

/// A query, cut into blocks.
inline AnswerOnSphere CutAnswer(
  const AskedSphere& asked, const PlaceQuery& query, std::int64_t first, std::int64_t count)
{
  AnswerOnSphere answer{ asked,
    { query.Values, nullptr, query.Components, query.Method == InterpolationKind::Natural,
      PlaceBoundaryView() },
    CutBlock(query, first, count), query.Degrees };
  if (query.Outside == OutsideKind::NotANumber)
  {
    answer.Asked.Boundary.NumberOfEdges = 0;
  }
  return answer;
}

}

#endif
