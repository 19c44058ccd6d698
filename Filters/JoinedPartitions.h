// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef JoinedPartitions_h
#define JoinedPartitions_h

#include "PartitionData.h"
#include "PartitionPoints.h"

#include "vtkNew.h"
#include "vtkSmartPointer.h"

#include <memory>
#include <string>
#include <vector>

class vtkPolyData;

namespace delaunayflip
{

/// One mesh made of the partitions that a process has, and the way back.
class JoinedPartitions
{
public:
  /// @param partitions at least one. Duplicate ghost cells are dropped.
  /// @param regions the name of a cell array that all must have, or empty.
  /// @param rank of this process.
  /// @throws InvalidMesh when a cell names a point that does not exist; InvalidOptions when a
  /// partition lacks the regions, or has them in another type.
  JoinedPartitions(
    std::vector<vtkSmartPointer<vtkPolyData>> partitions, const std::string& regions, int rank);

  vtkPolyData* GetMesh() const { return this->Mesh; }
  vtkIdType CountAmbiguousPoints() const { return this->Points.Ambiguous; }

  /// The partitions of the mesh after a run; empty ones if `flipped` is empty after a failure.
  /// Every cell is in the partition that it came from. A triangle that came from another process is
  /// in the first partition that has one of its points, else in the first one. Points that a
  /// partition lacks are added behind its own.
  std::vector<vtkSmartPointer<vtkPolyData>> Divide(vtkPolyData* flipped) const;

  /// Removes from a result the array by which this class knows the cells of each partition: another
  /// process may have sent it.
  static void RemoveMarks(vtkPolyData* flipped);

private:
  class Divider;

  void AddCells();
  void AddData();
  void RequireRegions(const std::string& name) const;

  std::vector<vtkSmartPointer<vtkPolyData>> Partitions;
  int Rank;
  PartitionPoints Points;
  vtkNew<vtkPolyData> Mesh;
  std::unique_ptr<PartitionData> PointData, CellData;
  std::vector<std::vector<vtkIdType>> Cells; ///< Of each partition's cells, their ids in Mesh.
};

}

#endif
