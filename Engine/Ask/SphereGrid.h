// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_SPHEREGRID_H
#define DELAUNAYFLIP_SPHEREGRID_H

#include "PlaceGrid.h"
#include "SphereMesh.h"
#include "SphereQuery.h"

#include <cstdint>
#include <vector>

/// @file
/// Where walks to places on a sphere begin.

namespace delaunayflip
{

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

  bool HasPlaces() const { return this->NumberOfFacing > 0; }
  PlaceGridView GetCells() const { return { this->Frame, this->Cells.data() }; }
  const std::int32_t* GetNumbers() const
  {
    return this->Numbers.empty() ? nullptr : this->Numbers.data();
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

  SphereMesh Mesh;
  const std::vector<std::int32_t>& Numbers;
  std::int64_t NumberOfFacing = 0;
  std::vector<std::int32_t> Neighbors; ///< The neighbours in Mesh, if some triangles are cut off.
  PlaceGridFrame Frame;
  std::vector<TriangleId> Cells;
};

}

#endif
