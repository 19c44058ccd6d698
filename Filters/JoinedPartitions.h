// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef JoinedPartitions_h
#define JoinedPartitions_h

#include "EngineExport.h"

#include "vtkIdList.h"
#include "vtkIntArray.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <cstdint>
#include <string>
#include <vector>

namespace delaunayflip
{

using MeshList = std::vector<vtkSmartPointer<vtkPolyData>>;

/// The partitions of a dataset as one mesh.
struct JoinedMesh
{
  vtkSmartPointer<vtkPolyData> Mesh;
  std::vector<vtkSmartPointer<vtkIdList>> Points; ///< For each partition, its points in the mesh.
  vtkSmartPointer<vtkIntArray> Owners; ///< For each cell of the mesh, its partition.

  /// Points that coincide with others of their partition, and with one of another: it is not known
  /// which of them are meant.
  vtkIdType Ambiguous = 0;
};

/// Joins the cells of all partitions but duplicate ghost cells, on points that each appear once,
/// and their data, by AddTuples. The field data are those of the first one.
/// @param partitions at least two. Ghost arrays that are ignored, and arrays with too few tuples,
/// are left out.
/// @param regions the name of a cell array that all must have, or empty.
/// @throws InvalidMesh when a cell names a point that does not exist; InvalidOptions when a
/// partition lacks the regions, or has them in another type.
JoinedMesh JoinPartitions(const MeshList& partitions, const std::string& regions);

/// Divides a joined mesh after its flips. A partition has its own points first, then those that it
/// lacks, with the arrays that the joined mesh has.
/// @param owners for each cell its partition.
MeshList DividePartitions(vtkPolyData* flipped, vtkIntArray* owners, const MeshList& partitions,
  const std::vector<vtkSmartPointer<vtkIdList>>& points);

/// A mesh without the cells that are marked as copies of cells of other meshes (vtkGhostType), on
/// the same points.
/// @throws InvalidMesh when a cell names a point that does not exist.
vtkSmartPointer<vtkPolyData> DropDuplicateCells(vtkPolyData* mesh);

/// The values of vtkGlobalPointIds, one per point; empty if the mesh has none.
DELAUNAYFLIP_EXPORT std::vector<std::int64_t> ReadPointNumbers(vtkPolyData* mesh);

}

#endif
