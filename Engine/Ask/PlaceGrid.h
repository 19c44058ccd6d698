// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PLACEGRID_H
#define DELAUNAYFLIP_PLACEGRID_H

#include "Array.h"
#include "Atomics.h"
#include "PlaneMesh.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

/// @file
/// Where walks to places begin: a pyramid of square grids over the box of a triangulation. A cell
/// has one of the triangles with a vertex in it.

namespace delaunayflip
{

/// A box around places.
struct PlaceBox
{
  double Low[2] = { INFINITY, INFINITY };
  double High[2] = { -INFINITY, -INFINITY };

  DELAUNAYFLIP_HOST_DEVICE void Include(const PlanePoint& place)
  {
    this->Include(0, place.U, place.U);
    this->Include(1, place.V, place.V);
  }

  DELAUNAYFLIP_HOST_DEVICE PlaceBox& operator+=(const PlaceBox& other)
  {
    this->Include(0, other.Low[0], other.High[0]);
    this->Include(1, other.Low[1], other.High[1]);
    return *this;
  }

  /// Whether a place is in it; one that is not a number is not.
  DELAUNAYFLIP_HOST_DEVICE bool Has(const PlanePoint& place) const
  {
    return place.U >= this->Low[0] && place.U <= this->High[0] && place.V >= this->Low[1] &&
      place.V <= this->High[1];
  }

  bool IsInFilterRange() const
  {
    return delaunayflip::IsInFilterRange({ this->Low[0], this->Low[1], 0.0 }) &&
      delaunayflip::IsInFilterRange({ this->High[0], this->High[1], 0.0 });
  }

private:
  DELAUNAYFLIP_HOST_DEVICE void Include(int axis, double low, double high)
  {
    this->Low[axis] = low < this->Low[axis] ? low : this->Low[axis];
    this->High[axis] = high > this->High[axis] ? high : this->High[axis];
  }
};

/// The box of a triangulation, cut into cells.
struct PlaceGridFrame
{
  static constexpr int MostLevels = 12; ///< 4096 rows
  static constexpr int KeyBits = 2 * MostLevels;

  PlaceBox Box;
  double CellsPerUnit[2] = { 0.0, 0.0 }; ///< In the finest grid; 0 if the box has no usable size.
  int Finest = 0; ///< The finest grid has 2^Finest rows and columns, the coarsest one cell.

  DELAUNAYFLIP_HOST_DEVICE std::uint32_t FindColumn(int axis, double coordinate) const
  {
    const double cell = (coordinate - this->Box.Low[axis]) * this->CellsPerUnit[axis];
    const double last = static_cast<double>((1u << this->Finest) - 1);
    if (!(cell > 0.0)) // or NaN
    {
      return 0;
    }
    return static_cast<std::uint32_t>(cell < last ? cell : last);
  }

  /// A power of two by which coordinates in the box become about 1.
  double GetScale() const
  {
    double largest = 0.0;
    for (int axis = 0; axis < 2; ++axis)
    {
      largest = std::max(largest, std::fabs(this->Box.Low[axis]));
      largest = std::max(largest, std::fabs(this->Box.High[axis]));
    }
    constexpr int Most = 1000; // so that the scale itself is a normal number
    const int exponent = largest > 0.0 ? std::ilogb(largest) : 0;
    return std::scalbn(1.0, -std::clamp(exponent, -Most, Most));
  }

  /// The number of the first cell of a level.
  DELAUNAYFLIP_HOST_DEVICE static std::int64_t GetFirst(int level)
  {
    return ((std::int64_t(1) << (2 * level)) - 1) / 3;
  }

  /// The number of a cell of the finest grid, row by row: KeyBits bits at most.
  DELAUNAYFLIP_HOST_DEVICE std::uint32_t FindKey(const PlanePoint& place) const
  {
    return (this->FindColumn(1, place.V) << this->Finest) + this->FindColumn(0, place.U);
  }
  DELAUNAYFLIP_HOST_DEVICE std::int64_t FindCell(const PlanePoint& place) const
  {
    return GetFirst(this->Finest) + this->FindKey(place);
  }

  /// Whether two places are in the same cell or in neighbouring ones.
  DELAUNAYFLIP_HOST_DEVICE bool AreNear(const PlanePoint& a, const PlanePoint& b) const
  {
    return AreNear(this->FindColumn(0, a.U) - this->FindColumn(0, b.U),
      this->FindColumn(1, a.V) - this->FindColumn(1, b.V));
  }

  /// Whether a place is in a cell of any level or in one beside it.
  DELAUNAYFLIP_HOST_DEVICE bool IsNear(const PlanePoint& place, std::int64_t cell) const
  {
    int level = this->Finest;
    while (cell < GetFirst(level))
    {
      --level;
    }
    const std::int64_t number = cell - GetFirst(level);
    const auto row = static_cast<std::uint32_t>(number >> level);
    const auto column = static_cast<std::uint32_t>(number - (std::int64_t(row) << level));
    return AreNear((this->FindColumn(0, place.U) >> (this->Finest - level)) - column,
      (this->FindColumn(1, place.V) >> (this->Finest - level)) - row);
  }

  /// Whether cells so many columns and rows apart are the same or neighbours.
  DELAUNAYFLIP_HOST_DEVICE static bool AreNear(std::uint32_t columns, std::uint32_t rows)
  {
    return columns + 1 <= 2 && rows + 1 <= 2; // from -1 to 1
  }
};

/// Where the last place was found. The next one is often near.
struct LastPlace
{
  std::uint32_t Column = 0, Row = 0; ///< A cell of the finest grid.
  TriangleId Triangle = NoTriangle;
};

/// The cells, for functions of both backends.
struct PlaceGridView
{
  PlaceGridFrame Frame;
  const TriangleId* Cells;

  /// A triangle near a place.
  DELAUNAYFLIP_HOST_DEVICE TriangleId FindStart(const PlanePoint& place) const
  {
    LastPlace none;
    return this->FindStart(place, none);
  }

  /// @param last becomes the cell of this place; its triangle is taken if the cell is near.
  DELAUNAYFLIP_HOST_DEVICE TriangleId FindStart(const PlanePoint& place, LastPlace& last) const
  {
    std::uint32_t column = this->Frame.FindColumn(0, place.U);
    std::uint32_t row = this->Frame.FindColumn(1, place.V);
    const bool isNear = PlaceGridFrame::AreNear(column - last.Column, row - last.Row);
    last.Column = column;
    last.Row = row;
    if (isNear && last.Triangle != NoTriangle)
    {
      return last.Triangle;
    }
    for (int level = this->Frame.Finest; level >= 0; --level, column /= 2, row /= 2)
    {
      const std::int64_t cell =
        PlaceGridFrame::GetFirst(level) + (std::int64_t(row) << level) + column;
      if (this->Cells[cell] != NoTriangle)
      {
        return this->Cells[cell];
      }
    }
    return 0;
  }
};

/// The lowest triangle in the four cells of the next finer level that make a cell.
DELAUNAYFLIP_HOST_DEVICE inline TriangleId FindLowestOfFour(
  const TriangleId* fine, int level, std::int64_t cell)
{
  const std::int64_t row = cell >> level;
  const std::int64_t column = cell - (row << level);
  const TriangleId* lower = fine + (row << (level + 2)) + 2 * column;
  const TriangleId* upper = lower + (std::int64_t(2) << level);
  TriangleId lowest = lower[0];
  for (const TriangleId other : { lower[1], upper[0], upper[1] })
  {
    if (other < lowest)
    {
      lowest = other;
    }
  }
  return lowest;
}

/// The cells, owned.
struct PlaceGrid
{
  PlaceGridFrame Frame;
  Array<TriangleId> Cells;

  PlaceGridView View() const { return { this->Frame, this->Cells.Data() }; }
};

/// @param count how many places the box has.
inline PlaceGridFrame MakePlaceGridFrame(const PlaceBox& box, std::int64_t count)
{
  constexpr std::int64_t PlacesPerCell = 2;
  PlaceGridFrame frame;
  frame.Box = box;
  while (frame.Finest < PlaceGridFrame::MostLevels && (PlacesPerCell << (2 * frame.Finest)) < count)
  {
    ++frame.Finest;
  }
  for (int axis = 0; axis < 2; ++axis)
  {
    const double scale = static_cast<double>(1 << frame.Finest) / (box.High[axis] - box.Low[axis]);
    frame.CellsPerUnit[axis] = IsFinite(scale) ? scale : 0.0;
  }
  return frame;
}

/// Makes the grid of a triangulation with at least one triangle. It stays usable while edges flip.
template <typename Backend>
PlaceGrid BuildPlaceGrid(const PlaneMesh& mesh, std::int64_t triangles, const Backend& backend)
{
  const std::int64_t places = mesh.Places.Count;
  const PlaceBox box = backend.template Sum<PlaceBox>(places,
    [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i, PlaceBox & sum)
    { sum.Include(mesh.GetPoint(static_cast<VertexId>(i))); });
  PlaceGrid grid;
  const PlaceGridFrame frame = MakePlaceGridFrame(box, places);
  grid.Frame = frame;
  const std::int64_t size = PlaceGridFrame::GetFirst(frame.Finest + 1);
  grid.Cells = backend.template MakeArray<TriangleId>(size);
  TriangleId* cells = grid.Cells.Data();
  backend.ForEach(
    size, [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t cell) { cells[cell] = NoTriangle; });
  backend.ForEach(triangles,
    [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t t)
    {
      const VertexId vertex = mesh.Edges.Triangles[t].Vertices[0];
      AtomicMin(&cells[frame.FindCell(mesh.GetPoint(vertex))], static_cast<TriangleId>(t));
    });
  for (int level = frame.Finest - 1; level >= 0; --level)
  {
    TriangleId* coarse = cells + PlaceGridFrame::GetFirst(level);
    const TriangleId* fine = cells + PlaceGridFrame::GetFirst(level + 1);
    backend.ForEach(std::int64_t(1) << (2 * level),
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t cell)
      { coarse[cell] = FindLowestOfFour(fine, level, cell); });
  }
  return grid;
}

/// Brings the grid of a triangulation up to date from which points were removed: a cell forgets its
/// triangle if another one that is not near has its number now, or none. Then a walk begins at the
/// triangle of a larger cell.
template <typename Backend>
void ForgetMovedTriangles(
  PlaceGrid& grid, const PlaneMesh& mesh, std::int64_t triangles, const Backend& backend)
{
  const PlaceGridFrame frame = grid.Frame;
  TriangleId* cells = grid.Cells.Data();
  backend.ForEach(static_cast<std::int64_t>(grid.Cells.Size()),
    [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t cell)
    {
      const TriangleId triangle = cells[cell];
      if (triangle == NoTriangle)
      {
        return;
      }
      bool isNear = triangle < triangles;
      if (isNear)
      {
        const PlanePoint place = mesh.GetPoint(mesh.Edges.Triangles[triangle].Vertices[0]);
        isNear = frame.IsNear(place, cell);
      }
      if (!isNear)
      {
        cells[cell] = NoTriangle;
      }
    });
}

}

#endif
