// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_OBJPLAN_H
#define DELAUNAYFLIP_OBJPLAN_H

#include "ObjParser.h"

#include <array>

class vtkAbstractArray;
class vtkDataArray;
class vtkPolyData;
class vtkStringArray;

namespace delaunayflip
{

/// The ids of the cells and the names that they number; null where there are none.
struct ObjLabelArrays
{
  vtkDataArray* Ids = nullptr;
  vtkStringArray* Names = nullptr;
};

/// The arrays of a mesh that a .obj can hold. Null: none.
struct ObjPlan
{
  explicit ObjPlan(vtkPolyData* mesh);

  bool Holds(vtkAbstractArray* array) const;

  vtkDataArray* Texture = nullptr; ///< Of the points.
  vtkDataArray* PointNormals = nullptr;
  vtkDataArray* CellNormals = nullptr; ///< If there are none of the points.
  vtkDataArray* Colors = nullptr; ///< Of the points.
  std::array<ObjLabelArrays, ObjLabels.size()> Labels;
  vtkStringArray* Libraries = nullptr; ///< Files of materials.
};

}

#endif
