// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef PointViews_h
#define PointViews_h

#include "TriangleMesh.h"

#include "vtkType.h"

#include <vector>

class vtkCellArray;
class vtkIdList;
class vtkPolyData;

namespace delaunayflip
{

/// A view of the points if the engine can read their layout, else of a copy in `storage`.
/// @throws InvalidMesh if points do not have three coordinates.
PointArray ViewPoints(vtkPolyData* mesh, std::vector<double>& storage);

/// Whether both have the same number of points and the same bits.
bool HaveSameBits(const PointArray& points, const PointArray& others);

/// Checks one cell array of a vtkPolyData before any of its ids is used.
struct PointIdCheck
{
  const char* What; ///< What messages call a cell, e.g. "cell".
  vtkIdType FirstCell; ///< The cell id, in the vtkPolyData, of the array's first cell.
  vtkIdType NumberOfPoints;

  /// @throws InvalidMesh when offsets and connectivity of `cells` contradict each other.
  void RequireValid(vtkCellArray* cells) const;

  /// @throws InvalidMesh when `id`, named by cell `cell` of the array, is not a point.
  void RequireInRange(vtkIdType cell, vtkIdType id) const
  {
    if (id < 0 || id >= this->NumberOfPoints)
    {
      this->ThrowOutOfRange(cell, id);
    }
  }
  void RequireInRange(vtkIdType cell, vtkIdList* ids) const;

private:
  [[noreturn]] void ThrowOutOfRange(vtkIdType cell, vtkIdType id) const;
};

}

#endif
