// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PLYPLAN_H
#define DELAUNAYFLIP_PLYPLAN_H

#include "PlyHeader.h"

#include <vtkType.h>

#include <string>
#include <vector>

class vtkAbstractArray;
class vtkDataArray;
class vtkDataSetAttributes;

namespace delaunayflip
{

/// A scalar property of a .ply: one component of an array.
struct PlyOutput
{
  std::string Name;
  PlyType Type;
  vtkDataArray* Array;
  int Component;
};

/// How the arrays of points or cells become properties of an element.
struct PlyPlan
{
  std::vector<PlyOutput> Properties;
  std::vector<vtkAbstractArray*> Left; ///< What a .ply cannot hold.

  bool Holds(vtkAbstractArray* array) const;
};

/// @param size how many tuples the arrays must have
/// @param taken names that the element's properties already have
PlyPlan PlanPly(vtkDataSetAttributes* data, vtkIdType size, std::vector<std::string> taken);

}

#endif
