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
#include <numeric>

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

/// Keeps the first of equal pairs; it is to be inserted if any of them is.
void RemoveRepeated(ConstraintEdges& edges)
{
  const std::vector<std::size_t> first = FindFirst(edges.Pairs);
  for (std::size_t i = 0; i < first.size(); ++i)
  {
    edges.ToInsert[first[i]] |= edges.ToInsert[i];
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < first.size(); ++i)
  {
    if (first[i] == i)
    {
      edges.Pairs[kept] = edges.Pairs[i];
      edges.ToInsert[kept++] = edges.ToInsert[i];
    }
  }
  edges.Pairs.resize(kept);
  edges.ToInsert.resize(kept);
}

}

void AddPair(std::int64_t a, std::int64_t b, std::vector<PointPair>& pairs)
{
  if (a != b)
  {
    pairs.push_back({ std::min(a, b), std::max(a, b) });
  }
}

std::vector<std::size_t> FindFirst(const std::vector<PointPair>& pairs)
{
  std::vector<std::size_t> order(pairs.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::sort(order.begin(), order.end(),
    [&](std::size_t a, std::size_t b)
    { return pairs[a] != pairs[b] ? pairs[a] < pairs[b] : a < b; });
  std::vector<std::size_t> first(pairs.size());
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    const bool isRepeated = i > 0 && pairs[order[i]] == pairs[order[i - 1]];
    first[order[i]] = isRepeated ? first[order[i - 1]] : order[i];
  }
  return first;
}

ConstraintEdges FindConstraintEdges(const ConstraintSource& source)
{
  ConstraintEdges edges;
  if (source.Lines)
  {
    const PointIdCheck check{ "line cell", source.Lines->GetNumberOfVerts(), source.Points.Count };
    AddPaths(source.Lines->GetLines(), false, check, edges.Pairs);
    edges.ToInsert.resize(edges.Pairs.size(), source.InsertLines ? 1 : 0);
  }
  if (source.Others)
  {
    AddOthers(source, edges);
    edges.ToInsert.resize(edges.Pairs.size(), source.InsertOthers ? 1 : 0);
  }
  RemoveRepeated(edges);
  return edges;
}

}
