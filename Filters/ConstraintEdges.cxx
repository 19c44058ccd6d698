// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ConstraintEdges.h"

#include "PlaceMatch.h"
#include "PointIds.h"
#include "PointViews.h"
#include "WorkProgress.h"

#include "vtkCellArray.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace delaunayflip
{
namespace
{

/// The cells of a vtkCellArray, as lines or as polygons.
struct Paths
{
  vtkCellArray* Cells;
  bool AreClosed;
};

void AddPaths(const Paths& paths, const PointIdCheck& check, WorkProgress& progress,
  std::vector<PointPair>& pairs)
{
  check.RequireValid(paths.Cells);
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < paths.Cells->GetNumberOfCells(); ++cell)
  {
    paths.Cells->GetCellAtId(cell, ids);
    check.RequireInRange(cell, ids);
    const vtkIdType count = ids->GetNumberOfIds();
    for (vtkIdType i = 1; i < count; ++i)
    {
      AddPair(ids->GetId(i - 1), ids->GetId(i), pairs);
    }
    if (paths.AreClosed && count > 2)
    {
      AddPair(ids->GetId(count - 1), ids->GetId(0), pairs);
    }
    progress.Add(count);
  }
}

void AddLines(
  const ConstraintSource& source, const ProgressObserver& progress, std::vector<PointPair>& pairs)
{
  vtkCellArray* lines = source.Lines->GetLines();
  const PointIdCheck check{ "line, cell", source.Lines->GetNumberOfVerts(), source.Points.Count };
  WorkProgress work(progress, lines->GetNumberOfConnectivityIds());
  AddPaths({ lines, false }, check, work, pairs);
}

/// Adds the edges along lines and polygons of the second input, whose ids must be below
/// `numberOfPoints`.
void AddOtherPaths(vtkPolyData* others, vtkIdType numberOfPoints, const ProgressObserver& progress,
  std::vector<PointPair>& pairs)
{
  WorkProgress work(progress,
    others->GetLines()->GetNumberOfConnectivityIds() +
      others->GetPolys()->GetNumberOfConnectivityIds());
  PointIdCheck check{ "constraint cell", others->GetNumberOfVerts(), numberOfPoints };
  AddPaths({ others->GetLines(), false }, check, work, pairs);
  check.FirstCell += others->GetNumberOfLines();
  AddPaths({ others->GetPolys(), true }, check, work, pairs);
}

void AddOthers(
  const ConstraintSource& source, const ProgressObserver& progress, ConstraintEdges& edges)
{
  std::vector<double> storage;
  const PointArray points = ViewPoints(source.Others, storage);
  if (points.Count == 0 || HaveSameBits(points, source.Points))
  {
    AddOtherPaths(source.Others, source.Points.Count, progress, edges.Pairs);
    return;
  }
  std::vector<PointPair> pairs;
  AddOtherPaths(source.Others, points.Count, MakePart(progress, 0.0, 0.1), pairs);
  PlaceMatch(points, pairs, source.Points, MakePart(progress, 0.1, 0.9))
    .AddEdges(source.Triangles, MakePart(progress, 0.9, 1.0), edges);
}

/// Keeps the first of equal pairs; it is to be inserted if any of them is.
void RemoveRepeated(ConstraintEdges& edges, const ProgressObserver& progress)
{
  const std::vector<std::size_t> first = FindFirst(edges.Pairs, progress);
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

std::vector<std::size_t> FindFirst(
  const std::vector<PointPair>& pairs, const ProgressObserver& progress)
{
  // About as many comparisons as the sort makes.
  constexpr vtkIdType ComparisonsPerItem = 16;
  const auto size = static_cast<double>(pairs.size());
  WorkProgress work(
    progress, static_cast<vtkIdType>(size * std::log2(size + 2.0) / ComparisonsPerItem));
  vtkIdType comparisons = 0;
  std::vector<std::size_t> order(pairs.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::sort(order.begin(), order.end(),
    [&](std::size_t a, std::size_t b)
    {
      work.Add(++comparisons % ComparisonsPerItem == 0 ? 1 : 0);
      return pairs[a] != pairs[b] ? pairs[a] < pairs[b] : a < b;
    });
  std::vector<std::size_t> first(pairs.size());
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    const bool isRepeated = i > 0 && pairs[order[i]] == pairs[order[i - 1]];
    first[order[i]] = isRepeated ? first[order[i - 1]] : order[i];
  }
  return first;
}

ConstraintEdges FindConstraintEdges(
  const ConstraintSource& source, const ProgressObserver& progress)
{
  ConstraintEdges edges;
  if (source.Lines)
  {
    AddLines(source, MakePart(progress, 0.0, source.Others ? 0.0 : 0.5), edges.Pairs);
    edges.ToInsert.resize(edges.Pairs.size(), source.InsertLines ? 1 : 0);
  }
  if (source.Others)
  {
    AddOthers(source, MakePart(progress, 0.0, 0.7), edges);
    edges.ToInsert.resize(edges.Pairs.size(), source.InsertOthers ? 1 : 0);
  }
  RemoveRepeated(edges, MakePart(progress, 0.7, 1.0));
  return edges;
}

}
