// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ConstraintEdges.h"

#include "PointIds.h"

#include "vtkCellArray.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPolyData.h"

#include <algorithm>

namespace delaunayflip
{
namespace
{

void AddEdge(vtkIdType a, vtkIdType b, ConstraintEdges& edges)
{
  if (a != b)
  {
    edges.push_back({ std::min<std::int64_t>(a, b), std::max<std::int64_t>(a, b) });
  }
}

void AddPaths(vtkCellArray* cells, bool closed, const PointIdCheck& check, ConstraintEdges& edges)
{
  check.RequireValid(cells);
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < cells->GetNumberOfCells(); ++cell)
  {
    cells->GetCellAtId(cell, ids);
    check.RequireInRange(cell, ids);
    const vtkIdType count = ids->GetNumberOfIds();
    for (vtkIdType i = 1; i < count; ++i)
    {
      AddEdge(ids->GetId(i - 1), ids->GetId(i), edges);
    }
    if (closed && count > 2)
    {
      AddEdge(ids->GetId(count - 1), ids->GetId(0), edges);
    }
  }
}

}

ConstraintEdges CollectConstraintEdges(
  vtkPolyData* mesh, vtkPolyData* constraints, vtkIdType numberOfPoints)
{
  ConstraintEdges edges;
  if (mesh)
  {
    const PointIdCheck check{ "line, cell", mesh->GetNumberOfVerts(), numberOfPoints };
    AddPaths(mesh->GetLines(), false, check, edges);
  }
  if (constraints)
  {
    PointIdCheck check{ "constraint, cell", constraints->GetNumberOfVerts(), numberOfPoints };
    AddPaths(constraints->GetLines(), false, check, edges);
    check.FirstCell += constraints->GetNumberOfLines();
    AddPaths(constraints->GetPolys(), true, check, edges);
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

}
