// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef JoinedPartitions_h
#define JoinedPartitions_h

#include "EngineExport.h"

#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <cstdint>
#include <string>
#include <vector>

namespace delaunayflip
{

using MeshList = std::vector<vtkSmartPointer<vtkPolyData>>;

/// One mesh made of the partitions of a dataset: the cells of all but duplicate ghost cells, on
/// points that each appear once, and their data, as AddTuples joins them. Its field data are those
/// of the first one.
/// @param partitions at least two. Ghost arrays that are ignored, and arrays with too few tuples,
/// are left out.
/// @param regions the name of a cell array that all must have, or empty.
/// @param ambiguous receives how many points coincide with others of their partition, and with one
/// of another: it is not known which of them are meant.
/// @throws InvalidMesh when a cell names a point that does not exist; InvalidOptions when a
/// partition lacks the regions, or has them in another type.
vtkSmartPointer<vtkPolyData> JoinPartitions(
  const MeshList& partitions, const std::string& regions, vtkIdType& ambiguous);

/// A mesh without the cells that are marked as copies of cells of other meshes (vtkGhostType), on
/// the same points.
/// @throws InvalidMesh when a cell names a point that does not exist.
vtkSmartPointer<vtkPolyData> DropDuplicateCells(vtkPolyData* mesh);

/// The values of vtkGlobalPointIds, one per point; empty if the mesh has none.
DELAUNAYFLIP_EXPORT std::vector<std::int64_t> ReadPointNumbers(vtkPolyData* mesh);

}

#endif
