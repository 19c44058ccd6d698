// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef JoinedPartitions_h
#define JoinedPartitions_h

#include "EngineExport.h"

#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <cstdint>
#include <string>
#include <vector>

class vtkDataSetAttributes;
class vtkIdList;

namespace delaunayflip
{

/// One mesh made of the partitions of a dataset, and the way back.
///
/// It has the arrays of all partitions, with zeros or empty texts where a partition lacks an array.
/// Arrays of one name that differ in type or number of components stay apart.
class DELAUNAYFLIP_EXPORT JoinedPartitions
{
public:
  /// The cell array of the joined mesh that holds the number of each cell's partition. A cell whose
  /// number is negative goes to the first partition that has one of its points, else to the first
  /// one.
  static constexpr const char* MarkName = "vtkDelaunayFlipPartition";

  /// @param partitions at least one. Duplicate ghost cells are dropped.
  /// @param regions the name of a cell array that all must have, or empty.
  /// @throws InvalidMesh when a cell names a point that does not exist; InvalidOptions when a
  /// partition lacks the regions, or has them in another type.
  JoinedPartitions(
    std::vector<vtkSmartPointer<vtkPolyData>> partitions, const std::string& regions);

  vtkPolyData* GetMesh() const { return this->Mesh; }

  /// Points that coincide with others of their partition, and with one of another. It is not known
  /// which of them are meant.
  vtkIdType CountAmbiguousPoints() const { return this->Ambiguous; }

  /// The partitions of the mesh after a run. Points that a partition lacks are added behind its
  /// own.
  std::vector<vtkSmartPointer<vtkPolyData>> Divide(vtkPolyData* flipped) const;

private:
  void JoinPoints();
  void JoinCells();
  void JoinData(vtkDataSetAttributes* own, vtkIdList* places, vtkDataSetAttributes* joined,
    vtkIdType size) const;
  void RequireRegions(const std::string& name) const;
  std::vector<std::vector<vtkIdType>> ListCellsOfPartitions(vtkPolyData* flipped) const;
  void DivideData(vtkDataSetAttributes* own, vtkIdType count, vtkDataSetAttributes* flipped,
    vtkIdList* places, vtkDataSetAttributes* result) const;

  std::vector<vtkSmartPointer<vtkPolyData>> Partitions;
  std::vector<std::vector<vtkIdType>> PointIds; ///< Of each partition's points, among all.
  vtkIdType Ambiguous = 0;
  vtkNew<vtkPolyData> Mesh;
};

/// The values of vtkGlobalPointIds, one per point; empty if the mesh has none.
DELAUNAYFLIP_EXPORT std::vector<std::int64_t> ReadPointNumbers(vtkPolyData* mesh);

/// Whether some of its cells are marked as copies of cells of other meshes (vtkGhostType).
DELAUNAYFLIP_EXPORT bool HasDuplicateCells(vtkPolyData* mesh);

}

#endif
