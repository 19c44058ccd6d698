// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "MergePoints.h"

#include <vtkCellArray.h>
#include <vtkCellArrayIterator.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <unordered_map>
#include <vector>

namespace delaunayflip
{

namespace
{

using Bits = std::array<std::uint64_t, 3>;

struct BitsHash
{
  std::size_t operator()(const Bits& bits) const
  {
    std::uint64_t hash = 0;
    for (const std::uint64_t word : bits)
    {
      hash = (hash ^ word) * 0x9e3779b97f4a7c15u; // 2^64 / golden ratio: spreads the bits
      hash ^= hash >> 32;
    }
    return static_cast<std::size_t>(hash);
  }
};

/// Coordinates as bits, so that a NaN equals itself; -0 becomes 0.
Bits CoordinateBits(const double point[3])
{
  Bits bits;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double value = point[axis] == 0.0 ? 0.0 : point[axis];
    std::memcpy(&bits[axis], &value, sizeof(value));
  }
  return bits;
}

vtkSmartPointer<vtkCellArray> Renumbered(vtkCellArray* cells, const std::vector<vtkIdType>& ids)
{
  auto renumbered = vtkSmartPointer<vtkCellArray>::New();
  renumbered->AllocateExact(cells->GetNumberOfCells(), cells->GetNumberOfConnectivityIds());
  const auto cell = vtk::TakeSmartPointer(cells->NewIterator());
  for (cell->GoToFirstCell(); !cell->IsDoneWithTraversal(); cell->GoToNextCell())
  {
    vtkIdType count = 0;
    const vtkIdType* corners = nullptr;
    cell->GetCurrentCell(count, corners);
    renumbered->InsertNextCell(static_cast<int>(count));
    for (vtkIdType corner = 0; corner < count; ++corner)
    {
      renumbered->InsertCellPoint(ids[corners[corner]]);
    }
  }
  return renumbered;
}

/// The new id of every point; `kept` receives the old ids of the points that stay.
std::vector<vtkIdType> NumberDistinct(vtkPoints* points, std::vector<vtkIdType>& kept)
{
  std::vector<vtkIdType> ids(points->GetNumberOfPoints());
  std::unordered_map<Bits, vtkIdType, BitsHash> known;
  known.reserve(ids.size());
  for (vtkIdType point = 0; point < points->GetNumberOfPoints(); ++point)
  {
    const auto next = static_cast<vtkIdType>(kept.size());
    const auto [place, isNew] = known.try_emplace(CoordinateBits(points->GetPoint(point)), next);
    if (isNew)
    {
      kept.push_back(point);
    }
    ids[point] = place->second;
  }
  return ids;
}

}

vtkIdType MergeCoincidentPoints(vtkPolyData* mesh)
{
  vtkPoints* points = mesh->GetPoints();
  std::vector<vtkIdType> kept;
  const std::vector<vtkIdType> ids = NumberDistinct(points, kept);
  const auto count = static_cast<vtkIdType>(kept.size());
  if (count == points->GetNumberOfPoints())
  {
    return 0;
  }

  vtkNew<vtkPoints> newPoints;
  newPoints->SetDataType(points->GetDataType());
  newPoints->SetNumberOfPoints(count);
  vtkNew<vtkPointData> newData;
  newData->CopyAllOn();
  newData->CopyAllocate(mesh->GetPointData(), count);
  for (vtkIdType point = 0; point < count; ++point)
  {
    newPoints->SetPoint(point, points->GetPoint(kept[point]));
    newData->CopyData(mesh->GetPointData(), kept[point], point);
  }
  const vtkIdType left = points->GetNumberOfPoints() - count;
  mesh->SetVerts(Renumbered(mesh->GetVerts(), ids));
  mesh->SetLines(Renumbered(mesh->GetLines(), ids));
  mesh->SetPolys(Renumbered(mesh->GetPolys(), ids));
  mesh->SetStrips(Renumbered(mesh->GetStrips(), ids));
  mesh->SetPoints(newPoints);
  mesh->GetPointData()->ShallowCopy(newData);
  return left;
}

}
