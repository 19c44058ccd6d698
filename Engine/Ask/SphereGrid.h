// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_SPHEREGRID_H
#define DELAUNAYFLIP_SPHEREGRID_H

#include "PlaceGrid.h"
#include "PlaceWalk.h"
#include "SphereMesh.h"

#include <cmath>
#include <cstdint>
#include <vector>

/// @file
/// Finds the triangle of a place on a sphere: a start from a grid, and a walk.

namespace delaunayflip
{

/// Where a direction is on the square of an unfolded octahedron. Nearby directions are nearby
/// there, except across four edges.
inline PlanePoint UnfoldDirection(const Vector3& direction)
{
  const double sum = std::fabs(direction.X) + std::fabs(direction.Y) + std::fabs(direction.Z);
  const double u = direction.X / sum, v = direction.Y / sum;
  if (!(direction.Z < 0.0))
  {
    return { u, v, 0.0 };
  }
  return { std::copysign(1.0 - std::fabs(v), u), std::copysign(1.0 - std::fabs(u), v), 0.0 };
}

/// A triangulation on a sphere without the triangles that cannot have places, and where walks in it
/// begin. Together the triangles are convex, or they are the whole sphere.
class SphereGrid
{
public:
  /// @param mesh triangles of the convex hull of its points; with segments, between these points.
  /// @param numbers by triangle, its number in the output, or -1 if it is removed. Empty: its own.
  SphereGrid(const SphereMesh& mesh, const std::vector<std::int32_t>& numbers)
    : Mesh(mesh),
      Numbers(numbers)
  {
    std::vector<char> areFacing(mesh.NumberOfTriangles);
    for (std::int64_t t = 0; t < mesh.NumberOfTriangles; ++t)
    {
      areFacing[t] = mesh.FacesOutside(static_cast<TriangleId>(t)) ? 1 : 0;
      this->NumberOfFacing += areFacing[t];
    }
    if (this->NumberOfFacing < mesh.NumberOfTriangles)
    {
      this->CutOff(areFacing);
    }
    this->FillCells(areFacing);
  }
  SphereGrid(const SphereGrid&) = delete;
  SphereGrid& operator=(const SphereGrid&) = delete;

  /// Across an edge of its boundary there is no triangle.
  const SphereMesh& GetMesh() const { return this->Mesh; }

  /// Whether the triangle across the edge opposite a corner is removed, or there is none.
  bool IsOnBoundary(CornerId corner) const
  {
    const CornerId across = this->Mesh.FindBeyond(corner);
    return across == NoCorner || this->GetNumber(TriangleOf(across)) < 0;
  }

  /// The number of a triangle in the output, or -1.
  std::int32_t GetNumber(TriangleId triangle) const
  {
    return this->Numbers.empty() ? static_cast<std::int32_t>(triangle) : this->Numbers[triangle];
  }

  /// Finds a place. It is outside if its triangles are removed.
  /// @param direction of the place; NaN for one that is outside by itself.
  /// @param last as for PlaceGridView::FindStart.
  FoundPlace Find(const PlanePoint& place, const Vector3& direction, LastPlace& last) const
  {
    if (this->NumberOfFacing == 0 || !IsFinite(Dot(direction, direction)))
    {
      return FoundPlace();
    }
    const PlaceGridView view{ this->Frame, this->Cells.data() };
    const FoundPlace found = this->Walk(place, view.FindStart(UnfoldDirection(direction), last));
    last.Triangle = found.Triangle;
    const bool mayBeRemoved = !this->Numbers.empty();
    if (found.IsOutside() || (found.OnEdges == 0 && !mayBeRemoved))
    {
      return found;
    }
    return ChooseTriangle(this->Mesh, found, mayBeRemoved ? this->Numbers.data() : nullptr);
  }

private:
  /// Copies the neighbours, without triangles that cannot have places.
  void CutOff(const std::vector<char>& areFacing)
  {
    const std::int64_t corners = 3 * this->Mesh.NumberOfTriangles;
    this->Neighbors.assign(this->Mesh.Neighbors, this->Mesh.Neighbors + corners);
    for (std::int64_t i = 0; i < corners; ++i)
    {
      std::int32_t& across = this->Neighbors[i];
      const bool isKept = areFacing[i / 3] != 0 && across >= 0 && areFacing[across] != 0;
      across = isKept ? across : -1;
    }
    this->Mesh.Neighbors = this->Neighbors.data();
  }

  void FillCells(const std::vector<char>& areFacing)
  {
    PlaceBox box;
    box.Include({ -1.0, -1.0, 0.0 });
    box.Include({ 1.0, 1.0, 0.0 });
    constexpr std::int64_t TrianglesPerPoint = 2;
    this->Frame = MakePlaceGridFrame(box, this->NumberOfFacing / TrianglesPerPoint);
    this->Cells.assign(PlaceGridFrame::GetFirst(this->Frame.Finest + 1), NoTriangle);
    for (std::int64_t t = this->Mesh.NumberOfTriangles - 1; t >= 0; --t)
    {
      if (areFacing[t] != 0)
      {
        const auto triangle = static_cast<TriangleId>(t);
        const PlanePoint& first = this->Mesh.GetPointAt(MakeCorner(triangle, 0));
        this->Cells[this->Frame.FindCell(UnfoldDirection(FindDirection(first)))] = triangle;
      }
    }
    for (int level = this->Frame.Finest - 1; level >= 0; --level)
    {
      TriangleId* coarse = this->Cells.data() + PlaceGridFrame::GetFirst(level);
      const TriangleId* fine = this->Cells.data() + PlaceGridFrame::GetFirst(level + 1);
      for (std::int64_t cell = 0; cell < std::int64_t(1) << (2 * level); ++cell)
      {
        coarse[cell] = FindLowestOfFour(fine, level, cell);
      }
    }
  }

  /// Does what WalkToPlace does.
  FoundPlace Walk(const PlanePoint& place, TriangleId start) const
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

  SphereMesh Mesh;
  const std::vector<std::int32_t>& Numbers;
  std::int64_t NumberOfFacing = 0;
  std::vector<std::int32_t> Neighbors; ///< The neighbours in Mesh, if some triangles are cut off.
  PlaceGridFrame Frame;
  std::vector<TriangleId> Cells;
};

}

#endif
