// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef PointIds_h
#define PointIds_h

#include "vtkType.h"

class vtkCellArray;
class vtkIdList;

namespace delaunayflip
{

/// Guards one cell array of a vtkPolyData before anything follows its ids.
struct PointIdCheck
{
  const char* What; ///< How errors call a cell, e.g. "cell".
  vtkIdType FirstCell; ///< The cell id, in the vtkPolyData, of the array's first cell.
  vtkIdType NumberOfPoints;

  /// @throws InvalidMesh when offsets and connectivity of `cells` contradict each other.
  void RequireValid(vtkCellArray* cells) const;

  /// @throws InvalidMesh when `id`, named by cell `cell` of the array, is no point.
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
