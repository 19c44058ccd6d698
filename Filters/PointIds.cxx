// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PointIds.h"

#include "FlipError.h"

#include "vtkCellArray.h"
#include "vtkIdList.h"

#include <sstream>

namespace delaunayflip
{

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
