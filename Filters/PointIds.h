// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef PointIds_h
#define PointIds_h

#include "vtkType.h"

class vtkCellArray;
class vtkIdList;

namespace delaunayflip
{

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
