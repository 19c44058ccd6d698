// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef MapperMesh_h
#define MapperMesh_h

#include "TriangleMesh.h"

#include "vtkAOSDataArrayTemplate.h"
#include "vtkBoundingBox.h"
#include "vtkCellArray.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkSMPThreadLocal.h"
#include "vtkTypeInt32Array.h"
#include "vtkTypeInt64Array.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

/// @file
/// What vtkDelaunayFlipMapper reads of meshes.

namespace delaunayflip
{

/// Calls visit(first, last) with the ids of points of cells.
template <typename Visit>
void VisitIds(vtkCellArray* cells, const Visit& visit)
{
  vtkDataArray* array = cells->GetConnectivityArray();
  const vtkIdType count = array->GetNumberOfValues();
  if (auto* longIds = vtkArrayDownCast<vtkTypeInt64Array>(array))
  {
    visit(longIds->GetPointer(0), longIds->GetPointer(0) + count);
  }
  else if (auto* ids = vtkArrayDownCast<vtkTypeInt32Array>(array))
  {
    visit(ids->GetPointer(0), ids->GetPointer(0) + count);
  }
  else
  {
    const vtkNew<vtkIdTypeArray> copy;
    copy->DeepCopy(array);
    visit(copy->GetPointer(0), copy->GetPointer(0) + count);
  }
}

/// Copies the ids of points of cells. vtkDataArray::DeepCopy takes ten times as long if types
/// differ.
inline void CopyIds(vtkCellArray* cells, vtkTypeInt32Array* ids)
{
  ids->SetNumberOfValues(cells->GetNumberOfConnectivityIds());
  VisitIds(cells,
    [&](const auto* first, const auto* last)
    {
      std::transform(first, last, ids->GetPointer(0),
        [](vtkIdType id) { return static_cast<std::int32_t>(id); });
    });
}

/// The box of the points that are used and finite, for vtkSMPTools.
struct BoxOfPoints
{
  PointArray Points;
  const unsigned char* AreUsed; ///< By point.
  vtkBoundingBox& Box; ///< Receives it.
  vtkSMPThreadLocal<vtkBoundingBox> Parts;

  void Initialize() { this->Parts.Local().Reset(); }
  void operator()(vtkIdType begin, vtkIdType end)
  {
    vtkBoundingBox& part = this->Parts.Local();
    double low[3] = { INFINITY, INFINITY, INFINITY }, high[3] = { -INFINITY, -INFINITY, -INFINITY };
    for (vtkIdType i = begin; i < end; ++i)
    {
      const double x[3] = { this->Points.Get(i, 0), this->Points.Get(i, 1),
        this->Points.Get(i, 2) };
      const bool isFinite = std::isfinite(x[0]) && std::isfinite(x[1]) && std::isfinite(x[2]);
      if (isFinite && this->AreUsed[i] != 0)
      {
        for (int axis = 0; axis < 3; ++axis)
        {
          low[axis] = std::min(low[axis], x[axis]);
          high[axis] = std::max(high[axis], x[axis]);
        }
      }
    }
    if (low[0] <= high[0])
    {
      part.AddBox({ low[0], high[0], low[1], high[1], low[2], high[2] });
    }
  }
  void Reduce()
  {
    for (const vtkBoundingBox& part : this->Parts)
    {
      if (part.IsValid())
      {
        this->Box.AddBox(part);
      }
    }
  }
};

}

#endif
