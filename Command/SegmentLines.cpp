// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SegmentLines.h"

#include "CommandError.h"
#include "ConstraintEdges.h"
#include "DataArrays.h"
#include "Formats.h"
#include "RasterFile.h"

#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>

#include <algorithm>
#include <array>
#include <map>
#include <regex>
#include <utility>
#include <vector>

namespace delaunayflip
{

namespace
{

using PointIds = std::vector<vtkIdType>;

std::vector<PointIds> ListCells(vtkCellArray* cells)
{
  std::vector<PointIds> lists;
  ForEachCell(
    cells, [&lists](vtkIdType size, const vtkIdType* ids) { lists.emplace_back(ids, ids + size); });
  return lists;
}

/// Makes rings of the lines and polygons of a file. They do not repeat their first point.
class RingReader
{
public:
  RingReader(vtkPolyData* mesh, const std::string& path)
    : Lines(ListCells(mesh->GetLines())),
      Polygons(ListCells(mesh->GetPolys())),
      Path(path)
  {
    PlaceNumbers known;
    for (vtkIdType point = 0; point < mesh->GetNumberOfPoints(); ++point)
    {
      std::array<double, 3> place;
      mesh->GetPoint(point, place.data());
      this->PlaceOf.push_back(known.Number(place));
    }
  }

  std::vector<PointIds> Read()
  {
    this->FindOpenEnds();
    std::vector<PointIds> rings;
    std::vector<bool> areJoined(this->Lines.size());
    for (std::size_t line = 0; line < this->Lines.size(); ++line)
    {
      if (!areJoined[line])
      {
        rings.push_back(this->Join(line, areJoined));
      }
    }
    rings.insert(rings.end(), this->Polygons.begin(), this->Polygons.end());
    for (PointIds& ring : rings)
    {
      if (ring.size() > 1 && this->IsClosed(ring))
      {
        ring.pop_back();
      }
    }
    return rings;
  }

private:
  bool IsClosed(const PointIds& line) const
  {
    return line.empty() || this->PlaceOf[line.front()] == this->PlaceOf[line.back()];
  }

  /// Notes which open lines end where. @throws CommandError where not exactly two do.
  void FindOpenEnds()
  {
    for (std::size_t line = 0; line < this->Lines.size(); ++line)
    {
      const PointIds& ids = this->Lines[line];
      if (!this->IsClosed(ids))
      {
        this->LinesAt[this->PlaceOf[ids.front()]].push_back(line);
        this->LinesAt[this->PlaceOf[ids.back()]].push_back(line);
      }
    }
    for (std::size_t line = 0; line < this->Lines.size(); ++line)
    {
      const PointIds& ids = this->Lines[line];
      if (!this->IsClosed(ids))
      {
        this->RequireTwo(line, ids.front());
        this->RequireTwo(line, ids.back());
      }
    }
  }

  void RequireTwo(std::size_t line, vtkIdType end) const
  {
    const std::size_t count = this->LinesAt.at(this->PlaceOf[end]).size();
    if (count != 2)
    {
      throw CommandError(ExitCode::BadFile,
        this->Path + ": line " + std::to_string(line) + " (the first is line 0)" +
          " does not end where it begins, so it is no ring. Lines are joined to a ring where two "
          "of "
          "them end at the same place. At point " +
          std::to_string(end) + " " +
          (count == 1 ? "only this line ends" : std::to_string(count) + " lines end"));
    }
  }

  /// A line with those that go on from its end until it is closed.
  PointIds Join(std::size_t line, std::vector<bool>& areJoined) const
  {
    PointIds ring = this->Lines[line];
    areJoined[line] = true;
    while (!this->IsClosed(ring))
    {
      const vtkIdType end = this->PlaceOf[ring.back()];
      const std::vector<std::size_t>& here = this->LinesAt.at(end);
      const std::size_t next = areJoined[here.front()] ? here.back() : here.front();
      PointIds more = this->Lines[next];
      if (this->PlaceOf[more.front()] != end)
      {
        std::reverse(more.begin(), more.end());
      }
      ring.insert(ring.end(), more.begin() + 1, more.end());
      areJoined[next] = true;
    }
    return ring;
  }

  const std::vector<PointIds> Lines, Polygons;
  const std::string& Path;
  PointIds PlaceOf; ///< By point, the number of its place.
  std::map<vtkIdType, std::vector<std::size_t>>
    LinesAt; ///< Open ones, by the places of their ends.
};

/// Breaklines. A polygon becomes a closed line.
std::vector<PointIds> ListBreaklines(vtkPolyData* mesh)
{
  std::vector<PointIds> lines = ListCells(mesh->GetLines());
  for (PointIds& ids : ListCells(mesh->GetPolys()))
  {
    if (!ids.empty())
    {
      ids.push_back(ids.front());
    }
    lines.push_back(std::move(ids));
  }
  return lines;
}

/// The points of longitudes and latitudes on the sphere.
vtkSmartPointer<vtkPolyData> PlaceMesh(vtkPolyData* degrees)
{
  auto placed = vtkSmartPointer<vtkPolyData>::New();
  placed->SetPoints(PlacePoints(degrees->GetPoints()));
  return placed;
}

/// The points of segments that a filter adds to those of the input: the first at each place where
/// the input has none.
std::vector<vtkIdType> ListAddedPoints(vtkPolyData* input, vtkPolyData* segments)
{
  std::vector<double> storage, inputStorage;
  const PointArray points = ViewPoints(segments, storage);
  const PointArray given = ViewPoints(input, inputStorage);
  PointPlaces places(points.Floats || given.Floats);
  for (std::int64_t i = 0; i < given.Count; ++i)
  {
    places.Add(given, i);
  }
  std::vector<vtkIdType> added;
  for (std::int64_t i = 0; i < points.Count; ++i)
  {
    const std::int64_t known = places.GetNumberOfPlaces();
    if (places.Add(points, i) == known)
    {
      added.push_back(i);
    }
  }
  return added;
}

}

vtkSmartPointer<vtkPolyData> MakeSegments(
  vtkPolyData* mesh, const std::string& path, bool areBreaklines)
{
  if (mesh->GetNumberOfLines() + mesh->GetNumberOfPolys() == 0)
  {
    throw CommandError(ExitCode::BadFile, path + ": has no lines or polygons");
  }
  const std::vector<PointIds> lists =
    areBreaklines ? ListBreaklines(mesh) : RingReader(mesh, path).Read();
  const vtkNew<vtkCellArray> segments;
  for (const PointIds& ids : lists)
  {
    segments->InsertNextCell(static_cast<vtkIdType>(ids.size()), ids.data());
  }
  auto made = vtkSmartPointer<vtkPolyData>::New();
  made->SetPoints(mesh->GetPoints());
  made->SetStrips(mesh->GetStrips()); // so that the filter warns of them
  made->GetPointData()->ShallowCopy(mesh->GetPointData());
  if (areBreaklines)
  {
    made->SetLines(segments);
  }
  else
  {
    made->SetPolys(segments);
  }
  return made;
}

std::string NamePlaces(
  const std::string& message, vtkPolyData* input, vtkPolyData* segments, bool areAngles)
{
  static const std::regex Numbers(
    "\\(points ([0-9]+) and ([0-9]+)\\)|points? ([0-9]+)(?: and ([0-9]+))?");
  const std::vector<vtkIdType> added = areAngles
    ? ListAddedPoints(PlaceMesh(input), PlaceMesh(segments))
    : ListAddedPoints(input, segments);
  const vtkIdType given = input->GetNumberOfPoints();
  const auto placeOf = [&](const std::string& number)
  {
    vtkIdType id = given;
    ReadNumber(number, id);
    std::array<double, 3> place = {};
    if (id < given)
    {
      input->GetPoint(id, place.data());
    }
    else if (id - given < static_cast<vtkIdType>(added.size()))
    {
      segments->GetPoint(added[id - given], place.data());
    }
    return "(" + TextOf(place[0]) + ", " + TextOf(place[1]) + ", " + TextOf(place[2]) + ")";
  };
  std::string text;
  auto rest = message.begin();
  for (std::sregex_iterator found(message.begin(), message.end(), Numbers), end; found != end;
       ++found)
  {
    const std::smatch& match = *found;
    text.append(rest, match[0].first);
    if (match[1].matched)
    {
      text += "from " + placeOf(match[1]) + " to " + placeOf(match[2]);
    }
    else
    {
      text += placeOf(match[3]) + (match[4].matched ? " and " + placeOf(match[4]) : "");
    }
    rest = match[0].second;
  }
  return text.append(rest, message.end());
}

void TakeExactPlaces(vtkPolyData* mesh, vtkPolyData* input)
{
  std::vector<double> storage, inputStorage;
  const PointArray points = ViewPoints(mesh, storage);
  const PointArray inputPoints = ViewPoints(input, inputStorage);
  if (!points.Floats || inputPoints.Floats)
  {
    return;
  }
  PointPlaces places(true);
  std::vector<std::int64_t> placeOf(points.Count);
  for (std::int64_t i = 0; i < points.Count; ++i)
  {
    placeOf[i] = places.Add(points, i);
  }
  std::vector<std::int64_t> inputAt(places.GetNumberOfPlaces(), PointPlaces::None);
  for (std::int64_t i = inputPoints.Count - 1; i >= 0; --i)
  {
    const std::int64_t place = places.Find(inputPoints, i);
    if (place != PointPlaces::None)
    {
      inputAt[place] = i;
    }
  }
  const vtkNew<vtkPoints> exact;
  exact->SetDataTypeToDouble();
  exact->DeepCopy(mesh->GetPoints());
  for (std::int64_t i = 0; i < points.Count; ++i)
  {
    const std::int64_t same = inputAt[placeOf[i]];
    if (same != PointPlaces::None)
    {
      exact->SetPoint(i, input->GetPoint(same));
    }
  }
  mesh->SetPoints(exact);
}

}
