// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ConstraintEdges.h"

#include "PlaceMatch.h"
#include "PointIds.h"
#include "PointViews.h"

#include "vtkCellArray.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPolyData.h"

#include <algorithm>

namespace delaunayflip
{
namespace
{

void AddPaths(
  vtkCellArray* cells, bool closed, const PointIdCheck& check, std::vector<PointPair>& pairs)
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
      AddPair(ids->GetId(i - 1), ids->GetId(i), pairs);
    }
    if (closed && count > 2)
    {
      AddPair(ids->GetId(count - 1), ids->GetId(0), pairs);
    }
  }
}

/// Adds the edges along lines and polygons of the second input, whose ids must be below
/// `numberOfPoints`.
void AddOtherPaths(vtkPolyData* others, vtkIdType numberOfPoints, std::vector<PointPair>& pairs)
{
  PointIdCheck check{ "constraint cell", others->GetNumberOfVerts(), numberOfPoints };
  AddPaths(others->GetLines(), false, check, pairs);
  check.FirstCell += others->GetNumberOfLines();
  AddPaths(others->GetPolys(), true, check, pairs);
}

void AddOthers(const ConstraintSource& source, ConstraintEdges& edges)
{
  std::vector<double> storage;
  const PointArray points = ViewPoints(source.Others, storage);
  if (points.Count == 0 || HaveSameBits(points, source.Points))
  {
    AddOtherPaths(source.Others, source.Points.Count, edges.Pairs);
    return;
  }
  std::vector<PointPair> pairs;
  AddOtherPaths(source.Others, points.Count, pairs);
  PlaceMatch(points, pairs, source.Points).AddEdges(source.Triangles, edges);
}

}

void AddPair(std::int64_t a, std::int64_t b, std::vector<PointPair>& pairs)
{
  if (a != b)
  {
    pairs.push_back({ std::min(a, b), std::max(a, b) });
  }
}

void SortPairs(std::vector<PointPair>& pairs)
{
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
}

ConstraintEdges FindConstraintEdges(const ConstraintSource& source)
{
  ConstraintEdges edges;
  if (source.Lines)
  {
    const PointIdCheck check{ "line cell", source.Lines->GetNumberOfVerts(), source.Points.Count };
    AddPaths(source.Lines->GetLines(), false, check, edges.Pairs);
  }
  if (source.Others)
  {
    AddOthers(source, edges);
  }
  SortPairs(edges.Pairs);
  return edges;
}

}
