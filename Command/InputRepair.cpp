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
#include <numeric>
#include <set>
#include <tuple>
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

/// The corners without those that are the same as the one before them.
void DropRepeats(std::vector<vtkIdType>& corners)
{
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  while (corners.size() > 1 && corners.front() == corners.back())
  {
    corners.pop_back();
  }
}

/// Whether a polygon has three different corners. Otherwise it is none, and has no edges.
bool IsPolygon(const vtkIdType* ids, vtkIdType size)
{
  const vtkIdType* const second =
    std::find_if(ids, ids + size, [ids](vtkIdType id) { return id != ids[0]; });
  return std::any_of(
    second, ids + size, [=](vtkIdType id) { return id != ids[0] && id != *second; });
}

/// The corners without repeats, from a smallest one on and in the direction that compares as less:
/// equal for polygons with the same boundary.
std::vector<vtkIdType> FindSmallestOrder(std::vector<vtkIdType> corners)
{
  DropRepeats(corners);
  std::vector<vtkIdType> smallest = corners;
  for (int direction = 0; direction < 2; ++direction)
  {
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    for (std::size_t turns = 0; turns < corners.size(); ++turns)
    {
      if (corners.front() == smallest.front() || corners.front() < smallest.front())
      {
        smallest = std::min(smallest, corners);
      }
      std::rotate(corners.begin(), corners.begin() + 1, corners.end());
    }
    std::reverse(corners.begin(), corners.end());
  }
  return smallest;
}

/// The mesh with strips split into triangles. Polygons with at least three different corners lose
/// each corner that repeats the one before it.
FileMesh MakePlain(vtkPolyData* mesh)
{
  const vtkNew<vtkCellArray> polygons;
  vtkIdType cell = mesh->GetNumberOfVerts() + mesh->GetNumberOfLines();
  const auto sources = MakeRange(0, cell);
  bool isPlain = mesh->GetNumberOfStrips() == 0;
  std::vector<vtkIdType> corners;
  ForEachCell(mesh->GetPolys(),
    [&](vtkIdType size, const vtkIdType* given)
    {
      corners.assign(given, given + size);
      if (IsPolygon(given, size))
      {
        DropRepeats(corners);
      }
      const auto left = static_cast<vtkIdType>(corners.size());
      isPlain = isPlain && left == size;
      polygons->InsertNextCell(left, corners.data());
      sources->InsertNextId(cell++);
    });
  ForEachCell(mesh->GetStrips(),
    [&](vtkIdType size, const vtkIdType* given)
    {
      for (vtkIdType i = 0; i + 2 < size; ++i)
      {
        const vtkIdType odd = i % 2; // every other triangle of a strip is wound the other way
        corners = { given[i + odd], given[i + 1 - odd], given[i + 2] };
        if (IsPolygon(corners.data(), 3))
        {
          polygons->InsertNextCell(3, corners.data());
          sources->InsertNextId(cell);
        }
      }
      ++cell;
    });
  FileMesh result;
  result.Mesh->ShallowCopy(mesh);
  if (!isPlain)
  {
    result.Mesh->SetPolys(polygons);
    result.Mesh->SetStrips(vtkNew<vtkCellArray>());
    CopyTuples(
      mesh->GetCellData(), cell, sources, "cell", result.Mesh->GetCellData(), result.Warnings);
    DemoteGlobalIds(result.Mesh->GetCellData());
  }
  return result;
}

/// Leaves out the polygons for which `isLeftOut(size, ids)` holds, with their data.
/// @returns the ids of these cells.
template <typename IsLeftOut>
std::vector<vtkIdType> LeaveOut(vtkPolyData* mesh, const IsLeftOut& isLeftOut, FileMesh& result)
{
  const vtkIdType cells = mesh->GetNumberOfCells();
  const vtkNew<vtkCellArray> polygons;
  vtkIdType cell = mesh->GetNumberOfVerts() + mesh->GetNumberOfLines();
  const auto ids = MakeRange(0, cell);
  std::vector<vtkIdType> leftOut;
  ForEachCell(mesh->GetPolys(),
    [&](vtkIdType size, const vtkIdType* corners)
    {
      if (isLeftOut(size, corners))
      {
        leftOut.push_back(cell);
      }
      else
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
  if (!leftOut.empty())
  {
    result.Mesh->SetPolys(polygons);
    CopyTuples(
      mesh->GetCellData(), cells, ids, "cell", result.Mesh->GetCellData(), result.Warnings);
  }
  return leftOut;
}

/// E.g. "4 polygons left out (first: 3, 7, 8)".
std::string DescribeLeftOut(const std::vector<vtkIdType>& cells)
{
  constexpr std::size_t Most = 3; // named
  std::string text = Counted(static_cast<std::int64_t>(cells.size()), "polygon") + " left out";
  for (std::size_t i = 0; i < std::min(Most, cells.size()); ++i)
  {
    text += (i == 0 ? " (first: " : ", ") + std::to_string(cells[i]);
  }
  return cells.empty() ? text : text + ')';
}

/// An edge of exactly two polygons.
struct SharedEdge
{
  vtkIdType First, Second; ///< The polygons.
  bool IsWrong; ///< Whether these are wound differently.
};

std::vector<SharedEdge> ListSharedEdges(vtkCellArray* polygons)
{
  struct Side
  {
    vtkIdType Low, High; ///< The ends.
    vtkIdType Polygon;
    bool IsAscending; ///< Whether the polygon runs from the low end to the high one.
  };
  std::vector<Side> sides;
  vtkIdType polygon = 0;
  ForEachCell(polygons,
    [&](vtkIdType size, const vtkIdType* corners)
    {
      const vtkIdType edges = IsPolygon(corners, size) ? size : 0;
      for (vtkIdType i = 0; i < edges; ++i)
      {
        const vtkIdType start = corners[i];
        const vtkIdType end = corners[(i + 1) % size];
        sides.push_back({ std::min(start, end), std::max(start, end), polygon, start < end });
      }
      ++polygon;
    });
  std::sort(sides.begin(), sides.end(),
    [](const Side& a, const Side& b)
    { return std::tie(a.Low, a.High, a.Polygon) < std::tie(b.Low, b.High, b.Polygon); });
  std::vector<SharedEdge> edges;
  for (auto side = sides.begin(); side != sides.end();)
  {
    const auto end = std::find_if(side, sides.end(),
      [&side](const Side& other) { return other.Low != side->Low || other.High != side->High; });
    if (end - side == 2)
    {
      const Side& other = *std::next(side);
      edges.push_back({ side->Polygon, other.Polygon, side->IsAscending == other.IsAscending });
    }
    side = end;
  }
  return edges;
}

/// A number for each polygon, the same for those that are joined by shared edges.
std::vector<vtkIdType> FindParts(const std::vector<SharedEdge>& edges, vtkIdType polygons)
{
  std::vector<vtkIdType> joined(polygons);
  std::iota(joined.begin(), joined.end(), 0);
  const auto find = [&joined](vtkIdType number)
  {
    for (; joined[number] != number; number = joined[number])
    {
      joined[number] = joined[joined[number]];
    }
    return number;
  };
  for (const SharedEdge& edge : edges)
  {
    const auto [first, last] = std::minmax({ find(edge.First), find(edge.Second) });
    joined[last] = first;
  }
  std::transform(joined.begin(), joined.end(), joined.begin(), find);
  return joined;
}

/// The polygons that VTK turns over. It fails at those that enclose nothing, so it does not see
/// them.
std::vector<bool> FindTurned(vtkPoints* points, vtkCellArray* given)
{
  const vtkNew<vtkCellArray> seen;
  std::vector<vtkIdType> numbers;
  vtkIdType polygon = 0;
  ForEachCell(given,
    [&](vtkIdType size, const vtkIdType* ids)
    {
      if (IsPolygon(ids, size))
      {
        seen->InsertNextCell(size, ids);
        numbers.push_back(polygon);
      }
      ++polygon;
    });
  const vtkNew<vtkPolyData> polygons;
  polygons->SetPoints(points);
  polygons->SetPolys(seen);
  const vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputData(polygons);
  normals->SplittingOff();
  normals->ConsistencyOn();
  normals->NonManifoldTraversalOff();
  normals->Update();
  vtkCellArray* const oriented = normals->GetOutput()->GetPolys();
  std::vector<bool> areTurned(polygon);
  if (oriented->GetNumberOfCells() == seen->GetNumberOfCells())
  {
    const vtkNew<vtkIdList> before, after;
    for (vtkIdType cell = 0; cell < seen->GetNumberOfCells(); ++cell)
    {
      seen->GetCellAtId(cell, before);
      oriented->GetCellAtId(cell, after);
      areTurned[numbers[cell]] = !std::equal(before->begin(), before->end(), after->begin());
    }
  }
  return areTurned;
}

/// If most polygons of a part are to be turned over, turns over the others of it instead. Leaves a
/// part alone if it would have no fewer wrong edges, as a Moebius band.
void TurnFewer(vtkCellArray* polygons, std::vector<bool>& areTurned)
{
  const auto count = static_cast<vtkIdType>(areTurned.size());
  const std::vector<SharedEdge> edges = ListSharedEdges(polygons);
  const std::vector<vtkIdType> parts = FindParts(edges, count);
  std::vector<vtkIdType> surplus(count); // by part, how many more are to be turned over than not
  for (vtkIdType cell = 0; cell < count; ++cell)
  {
    if (areTurned[cell])
    {
      ++surplus[parts[cell]];
    }
    else
    {
      --surplus[parts[cell]];
    }
  }
  std::vector<vtkIdType> gain(count); // by part, how many fewer edges are wrong
  for (const SharedEdge& edge : edges)
  {
    if (areTurned[edge.First] != areTurned[edge.Second])
    {
      gain[parts[edge.First]] += edge.IsWrong ? 1 : -1;
    }
  }
  for (vtkIdType cell = 0; cell < count; ++cell)
  {
    const vtkIdType part = parts[cell];
    areTurned[cell] = gain[part] > 0 && areTurned[cell] != (surplus[part] > 0);
  }
}

/// A copy of the polygons, in which those with a flag are turned over.
vtkSmartPointer<vtkCellArray> TurnOver(vtkCellArray* polygons, const std::vector<bool>& areTurned)
{
  auto made = vtkSmartPointer<vtkCellArray>::New();
  std::vector<vtkIdType> corners;
  ForEachCell(polygons,
    [&](vtkIdType size, const vtkIdType* given)
    {
      corners.assign(given, given + size);
      if (areTurned[made->GetNumberOfCells()])
      {
        std::reverse(corners.begin(), corners.end());
      }
      made->InsertNextCell(size, corners.data());
    });
  return made;
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
    return size > 2 && !IsPolygon(corners.data(), size);
  };
  FileMesh& result = merged.Result;
  const std::vector<vtkIdType> collapsed = LeaveOut(mesh, hasCollapsed, result);
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
  if (!collapsed.empty())
  {
    merged.Note += "; " + DescribeLeftOut(collapsed) + ", because " +
      (collapsed.size() == 1 ? "its" : "their") + " corners are fewer than three places";
  }
  return merged;
}

RepairedMesh DropDuplicates(vtkPolyData* mesh)
{
  std::set<std::vector<vtkIdType>> known;
  const auto isKnown = [&known](vtkIdType size, const vtkIdType* ids) {
    return !known.insert(FindSmallestOrder({ ids, ids + size })).second;
  };
  const FileMesh plain = MakePlain(mesh);
  RepairedMesh repaired;
  repaired.Result.Warnings = plain.Warnings;
  const std::vector<vtkIdType> duplicates = LeaveOut(plain.Mesh, isKnown, repaired.Result);
  const std::size_t count = duplicates.size();
  repaired.Note =
    Counted(count, "polygon") + " left out as " + (count == 1 ? "a duplicate" : "duplicates");
  return repaired;
}

RepairedMesh Orient(vtkPolyData* mesh)
{
  RepairedMesh repaired;
  repaired.Result = MakePlain(mesh);
  vtkCellArray* const given = repaired.Result.Mesh->GetPolys();
  std::vector<bool> areTurned = FindTurned(mesh->GetPoints(), given);
  TurnFewer(given, areTurned);
  const vtkIdType turned = std::count(areTurned.begin(), areTurned.end(), true);
  repaired.Result.Mesh->SetPolys(TurnOver(given, areTurned));
  repaired.Note = Counted(turned, "polygon") + " turned over to be wound like " +
    (turned == 1 ? "its" : "their") + " neighbours";
  return repaired;
}

}
