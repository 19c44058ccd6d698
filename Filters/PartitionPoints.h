// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef PartitionPoints_h
#define PartitionPoints_h

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <vector>

class vtkPoints;
class vtkPolyData;

namespace delaunayflip
{

/// The points of a mesh in several partitions, each once.
struct PartitionPoints
{
  std::vector<std::vector<vtkIdType>> Ids; ///< Of each partition's points, among all.
  vtkSmartPointer<vtkPoints> Points; ///< In the order of partitions. Double if those of one are.
  vtkIdType Ambiguous = 0; ///< Coincide with others of their partition, and with one of another.
};

/// Finds the points that several partitions have, by the rules for the pieces of ranks: those with
/// the same global id or, if a partition has no global ids, with equal coordinates if at least one
/// of them is at the border of its partition. Points without cells are not compared.
/// @param partitions with valid point ids.
PartitionPoints JoinPoints(const std::vector<vtkSmartPointer<vtkPolyData>>& partitions);

}

#endif
