// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef PartitionData_h
#define PartitionData_h

#include "vtkSmartPointer.h"

#include <string>
#include <vector>

class vtkAbstractArray;
class vtkDataSetAttributes;
class vtkIdList;

namespace delaunayflip
{

/// The point or cell data of a mesh in several partitions. It has the arrays of all partitions,
/// with zeros or empty texts where a partition lacks an array. Arrays of one name that differ in
/// type or number of components stay apart.
class PartitionData
{
public:
  /// @param joined receives the arrays; it must live as long as this object. @param size its number
  /// of tuples.
  PartitionData(vtkDataSetAttributes* joined, vtkIdType size)
    : Joined(joined),
      Size(size)
  {
  }

  /// @param own the data of a partition. @param places those of its tuples among all. Arrays with
  /// too few tuples are left out.
  void Add(vtkDataSetAttributes* own, vtkIdList* places);

  /// Writes the data of a partition after the run: first `count` tuples of its own, then those
  /// `places` of the mesh's.
  /// @param flipped the joined data after the run. Arrays that the run has added go to every
  /// partition if count is 0.
  void Store(vtkDataSetAttributes* own, vtkIdType count, vtkDataSetAttributes* flipped,
    vtkIdList* places, vtkDataSetAttributes* result) const;

private:
  /// @returns the name in the joined data of an array of a partition.
  std::string FindName(vtkDataSetAttributes* own, int index) const;
  void AddNewArrays(
    vtkDataSetAttributes* flipped, vtkIdList* places, vtkDataSetAttributes* result) const;

  vtkDataSetAttributes* Joined;
  vtkIdType Size;
};

}

#endif
