// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PointViews.h"

#include "FlipError.h"

#include "vtkAOSDataArrayTemplate.h"
#include "vtkCellArray.h"
#include "vtkIdList.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <cstring>
#include <sstream>
#include <string>

namespace delaunayflip
{
namespace
{

template <typename Real>
bool HaveSameBits(const Real* coordinates, const Real* others, std::int64_t points)
{
  return coordinates && others &&
    (coordinates == others || std::memcmp(coordinates, others, 3 * points * sizeof(Real)) == 0);
}

}

PointArray ViewPoints(vtkPolyData* mesh, std::vector<double>& storage)
{
  const vtkIdType count = mesh->GetNumberOfPoints();
  if (count == 0)
  {
    return {};
  }
  vtkDataArray* data = mesh->GetPoints()->GetData();
  if (data->GetNumberOfComponents() != 3)
  {
    throw InvalidMesh(
      "Points must have 3 coordinates, not " + std::to_string(data->GetNumberOfComponents()) + ".",
      -1, -1);
  }
  if (auto* floats = vtkArrayDownCast<vtkAOSDataArrayTemplate<float>>(data))
  {
    return { static_cast<const float*>(floats->GetPointer(0)), count };
  }
  if (auto* doubles = vtkArrayDownCast<vtkAOSDataArrayTemplate<double>>(data))
  {
    return { static_cast<const double*>(doubles->GetPointer(0)), count };
  }
  storage.resize(3 * count);
  for (vtkIdType point = 0; point < count; ++point)
  {
    data->GetTuple(point, &storage[3 * point]);
  }
  return { static_cast<const double*>(storage.data()), count };
}

bool HaveSameBits(const PointArray& points, const PointArray& others)
{
  return points.Count == others.Count &&
    (HaveSameBits(points.Floats, others.Floats, points.Count) ||
      HaveSameBits(points.Doubles, others.Doubles, points.Count));
}

void PointIdCheck::RequireValid(vtkCellArray* cells) const
{
  if (!cells->IsValid())
  {
    std::ostringstream message;
    message << "The offsets and the connectivity of the cell array of " << this->What << " "
            << this->FirstCell << " and the following ones contradict each other.";
    throw InvalidMesh(message.str(), this->FirstCell, -1);
  }
}

void PointIdCheck::RequireInRange(vtkIdType cell, vtkIdList* ids) const
{
  for (vtkIdType i = 0; i < ids->GetNumberOfIds(); ++i)
  {
    this->RequireInRange(cell, ids->GetId(i));
  }
}

void PointIdCheck::ThrowOutOfRange(vtkIdType cell, vtkIdType id) const
{
  const vtkIdType cellId = this->FirstCell + cell;
  std::ostringstream message;
  message << "Invalid mesh: " << this->What << " " << cellId << " names point " << id
          << ", but there are " << this->NumberOfPoints << " points, numbered from 0.";
  throw InvalidMesh(message.str(), cellId, id);
}

}
