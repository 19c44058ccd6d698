// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "InputRepair.h"

#include "DataArrays.h"
#include "Formats.h"

#include <vtkCellData.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyDataNormals.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <set>
#include <vector>

namespace delaunayflip
{

namespace
{

/// The arrays with at least `tuples` tuples.
std::vector<vtkAbstractArray*> ListWhole(vtkFieldData* data, vtkIdType tuples)
{
  std::vector<vtkAbstractArray*> whole;
  for (int index = 0; index < data->GetNumberOfArrays(); ++index)
  {
    vtkAbstractArray* const array = data->GetAbstractArray(index);
    if (array->GetNumberOfTuples() >= tuples)
    {
      whole.push_back(array);
    }
  }
  return whole;
}

/// A copy of `given` with the tuples of some ids alone. A warning names arrays that are too short.
/// @param kind "point" or "cell".
void CopyTuples(vtkDataSetAttributes* given, vtkIdType tuples, vtkIdList* ids,
  const std::string& kind, vtkDataSetAttributes* data, std::vector<std::string>& warnings)
{
  const std::string lost =
    LostArrays("left out " + kind + " data with too few tuples", given, ListWhole(given, tuples));
  if (!lost.empty())
  {
    warnings.push_back(lost);
  }
  const vtkIdType count = ids->GetNumberOfIds();
  data->Initialize();
  AddTuples(TakeWholeArrays(given, tuples), ids, MakeRange(0, count), count, data);
}

/// Leaves out the polygons for which `isLeftOut(size, ids)` holds, with their data.
/// @returns how many these are.
template <typename IsLeftOut>
vtkIdType LeaveOut(vtkPolyData* mesh, const IsLeftOut& isLeftOut, FileMesh& result)
{
  const vtkIdType cells = mesh->GetNumberOfCells();
  const vtkNew<vtkCellArray> polygons;
  vtkIdType cell = mesh->GetNumberOfVerts() + mesh->GetNumberOfLines();
  const auto ids = MakeRange(0, cell);
  ForEachCell(mesh->GetPolys(),
    [&](vtkIdType size, const vtkIdType* corners)
    {
      if (!isLeftOut(size, corners))
      {
        polygons->InsertNextCell(size, corners);
        ids->InsertNextId(cell);
      }
      ++cell;
    });
  for (; cell < cells; ++cell) // strips
  {
    ids->InsertNextId(cell);
  }
  result.Mesh->ShallowCopy(mesh);
  const vtkIdType count = cells - ids->GetNumberOfIds();
  if (count > 0)
  {
    result.Mesh->SetPolys(polygons);
    CopyTuples(
      mesh->GetCellData(), cells, ids, "cell", result.Mesh->GetCellData(), result.Warnings);
  }
  return count;
}

/// The corners without those that are the same as the one before them.
void DropRepeats(std::vector<vtkIdType>& corners)
{
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  while (corners.size() > 1 && corners.front() == corners.back())
  {
    corners.pop_back();
  }
}

vtkSmartPointer<vtkCellArray> Renumber(
  vtkCellArray* cells, const std::vector<vtkIdType>& numbers, bool arePolygons)
{
  auto made = vtkSmartPointer<vtkCellArray>::New();
  std::vector<vtkIdType> corners;
  ForEachCell(cells,
    [&](vtkIdType size, const vtkIdType* ids)
    {
      corners.resize(size);
      std::transform(
        ids, ids + size, corners.begin(), [&numbers](vtkIdType id) { return numbers[id]; });
      if (arePolygons && size > 2)
      {
        DropRepeats(corners);
      }
      made->InsertNextCell(static_cast<vtkIdType>(corners.size()), corners.data());
    });
  return made;
}

}

//------------------------------------------------------------------------------
RepairedMesh MergeEqualPoints(vtkPolyData* mesh)
{
  RepairedMesh merged;
  const vtkIdType before = mesh->GetNumberOfPoints();
  std::vector<vtkIdType> numbers(before); // at first of places
  PlaceNumbers known;
  vtkIdType places = 0;
  for (vtkIdType point = 0; point < before; ++point)
  {
    std::array<double, 3> place;
    mesh->GetPoint(point, place.data());
    numbers[point] = known.Number(place);
    places = std::max(places, numbers[point] + 1);
  }
  std::vector<vtkIdType> corners;
  const auto hasCollapsed = [&](vtkIdType size, const vtkIdType* ids)
  {
    corners.resize(size);
    std::transform(
      ids, ids + size, corners.begin(), [&numbers](vtkIdType id) { return numbers[id]; });
    DropRepeats(corners);
    return size > 2 && corners.size() < 3;
  };
  FileMesh& result = merged.Result;
  const vtkIdType collapsed = LeaveOut(mesh, hasCollapsed, result);
  const std::vector<bool> isUsed = FindUsed(result.Mesh,
    { result.Mesh->GetVerts(), result.Mesh->GetLines(), result.Mesh->GetPolys(),
      result.Mesh->GetStrips() });
  const vtkNew<vtkIdList> kept;
  std::vector<vtkIdType> pointAt(places, -1);
  for (vtkIdType point = 0; point < before; ++point)
  {
    vtkIdType& there = pointAt[numbers[point]];
    if (isUsed[point] && there < 0)
    {
      there = kept->InsertNextId(point);
    }
    numbers[point] = there; // which a point without cells may not have
  }
  const vtkNew<vtkPoints> points;
  points->SetDataType(mesh->GetPoints()->GetDataType());
  points->SetNumberOfPoints(kept->GetNumberOfIds());
  mesh->GetPoints()->GetPoints(kept, points);
  result.Mesh->SetPoints(points);
  CopyTuples(
    mesh->GetPointData(), before, kept, "point", result.Mesh->GetPointData(), result.Warnings);
  result.Mesh->SetVerts(Renumber(result.Mesh->GetVerts(), numbers, false));
  result.Mesh->SetLines(Renumber(result.Mesh->GetLines(), numbers, false));
  result.Mesh->SetPolys(Renumber(result.Mesh->GetPolys(), numbers, true));
  result.Mesh->SetStrips(Renumber(result.Mesh->GetStrips(), numbers, false));
  merged.Note = "of " + Counted(before, "point") + " " + std::to_string(kept->GetNumberOfIds()) +
    " are left after merging";
  if (collapsed > 0)
  {
    merged.Note += "; " + Counted(collapsed, "polygon") + " left out, because " +
      (collapsed == 1 ? "its" : "their") + " corners are fewer than three places";
  }
  return merged;
}

RepairedMesh DropDuplicates(vtkPolyData* mesh)
{
  std::set<std::vector<vtkIdType>> known;
  const auto isKnown = [&known](vtkIdType size, const vtkIdType* ids)
  {
    // From the smallest corner to its smaller neighbour.
    std::vector<vtkIdType> corners(ids, ids + size);
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    if (size > 2 && corners[1] > corners.back())
    {
      std::reverse(corners.begin() + 1, corners.end());
    }
    return !known.insert(corners).second;
  };
  RepairedMesh repaired;
  const vtkIdType count = LeaveOut(mesh, isKnown, repaired.Result);
  repaired.Note = Counted(count, "polygon") + " left out as duplicates";
  return repaired;
}

RepairedMesh Orient(vtkPolyData* mesh)
{
  const vtkNew<vtkPolyData> polygons;
  polygons->SetPoints(mesh->GetPoints());
  polygons->SetPolys(mesh->GetPolys());
  const vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputData(polygons);
  normals->SplittingOff();
  normals->ConsistencyOn();
  normals->NonManifoldTraversalOff();
  normals->Update();
  RepairedMesh repaired;
  repaired.Result.Mesh->ShallowCopy(mesh);
  vtkCellArray* const oriented = normals->GetOutput()->GetPolys();
  vtkIdType turned = 0;
  if (oriented->GetNumberOfCells() == mesh->GetNumberOfPolys())
  {
    const vtkNew<vtkIdList> before, after;
    for (vtkIdType cell = 0; cell < oriented->GetNumberOfCells(); ++cell)
    {
      mesh->GetPolys()->GetCellAtId(cell, before);
      oriented->GetCellAtId(cell, after);
      if (!std::equal(before->begin(), before->end(), after->begin()))
      {
        ++turned;
      }
    }
    repaired.Result.Mesh->SetPolys(oriented);
  }
  repaired.Note = Counted(turned, "polygon") + " turned over to be wound like " +
    (turned == 1 ? "its" : "their") + " neighbours";
  return repaired;
}

}
