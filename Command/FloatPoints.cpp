// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FloatPoints.h"

#include "CommandError.h"
#include "Counted.h"

#include <vtkCellArray.h>
#include <vtkCellArrayIterator.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>
#include <vector>

namespace delaunayflip
{

namespace
{

std::vector<bool> FindUsedPoints(vtkPolyData* mesh)
{
  std::vector<bool> used(mesh->GetNumberOfPoints());
  for (vtkCellArray* cells : { mesh->GetPolys(), mesh->GetStrips() })
  {
    const auto cell = vtk::TakeSmartPointer(cells->NewIterator());
    for (cell->GoToFirstCell(); !cell->IsDoneWithTraversal(); cell->GoToNextCell())
    {
      vtkIdType count = 0;
      const vtkIdType* corners = nullptr;
      cell->GetCurrentCell(count, corners);
      for (vtkIdType corner = 0; corner < count; ++corner)
      {
        used[corners[corner]] = true;
      }
    }
  }
  return used;
}

using Place = std::array<double, 3>;

/// A point as float and as it was.
using RoundedPlace = std::pair<Place, Place>;

/// The points of polygons, if they are double. NaN, which has no order, becomes 0: float has it
/// too.
std::vector<RoundedPlace> RoundPoints(vtkPolyData* mesh)
{
  std::vector<RoundedPlace> places;
  if (mesh->GetNumberOfPoints() == 0 || mesh->GetPoints()->GetDataType() != VTK_DOUBLE)
  {
    return places;
  }
  const std::vector<bool> used = FindUsedPoints(mesh);
  for (vtkIdType point = 0; point < mesh->GetNumberOfPoints(); ++point)
  {
    if (used[point])
    {
      RoundedPlace place;
      mesh->GetPoint(point, place.second.data());
      for (int axis = 0; axis < 3; ++axis)
      {
        double& value = place.second[axis];
        value = std::isnan(value) ? 0.0 : value;
        place.first[axis] = static_cast<float>(value);
      }
      places.push_back(place);
    }
  }
  return places;
}

/// By how much a coordinate of any point changes at most.
double FindLargestMove(const std::vector<RoundedPlace>& places)
{
  double largest = 0.0;
  for (const RoundedPlace& place : places)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      const bool differs = place.first[axis] != place.second[axis];
      const double move = differs ? std::abs(place.first[axis] - place.second[axis]) : 0.0;
      largest = std::max(largest, move);
    }
  }
  return largest;
}

/// How many different places become the same as others.
std::int64_t CountFallen(std::vector<RoundedPlace> places)
{
  std::sort(places.begin(), places.end());
  std::int64_t fallen = 0;
  for (std::size_t i = 1; i < places.size(); ++i)
  {
    fallen += places[i].first == places[i - 1].first && places[i] != places[i - 1] ? 1 : 0;
  }
  return fallen;
}

}

vtkIdType CountUnusedPoints(vtkPolyData* mesh)
{
  const std::vector<bool> used = FindUsedPoints(mesh);
  return std::count(used.begin(), used.end(), false);
}

std::string DescribeRoundingToFloat(vtkPolyData* mesh)
{
  const std::vector<RoundedPlace> places = RoundPoints(mesh);
  const double largest = FindLargestMove(places);
  if (largest == 0.0)
  {
    return {};
  }
  std::array<char, 32> move{};
  std::snprintf(move.data(), move.size(), "%.2g", largest);
  const std::int64_t fallen = CountFallen(places);
  return "double precision of the points (coordinates change by up to " + std::string(move.data()) +
    (fallen > 0 ? ", " + Counted(fallen, "point") + " fall on others)" : ")");
}

void RequireFloatRange(vtkPolyData* mesh)
{
  if (std::isinf(FindLargestMove(RoundPoints(mesh))))
  {
    throw CommandError(ExitCode::BadFile,
      "a coordinate is larger than 3.4e38, too large for this file format; a .vtk, .vtp, .ply or "
      ".obj can hold it");
  }
}

}
