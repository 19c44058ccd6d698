// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "HeightField.h"

#include "Predicates.h"

#include <vtkCellArray.h>
#include <vtkCellArrayIterator.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

namespace delaunayflip
{

namespace
{

int TurnOf(vtkPoints* points, const vtkIdType corners[3])
{
  double xyz[3][3];
  for (int corner = 0; corner < 3; ++corner)
  {
    points->GetPoint(corners[corner], xyz[corner]);
  }
  return Orientation(xyz[0], xyz[1], xyz[2]);
}

}

bool IsHeightField(vtkPolyData* mesh)
{
  int common = 0;
  const auto cell = vtk::TakeSmartPointer(mesh->GetPolys()->NewIterator());
  for (cell->GoToFirstCell(); !cell->IsDoneWithTraversal(); cell->GoToNextCell())
  {
    vtkIdType count = 0;
    const vtkIdType* corners = nullptr;
    cell->GetCurrentCell(count, corners);
    const int turn = count == 3 ? TurnOf(mesh->GetPoints(), corners) : 0;
    if (turn == 0 || turn == -common)
    {
      return false;
    }
    common = turn;
  }
  return common != 0;
}

}
