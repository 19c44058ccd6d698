// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef PieceInput_h
#define PieceInput_h

#include "Notes.h"
#include "PieceGroup.h"

#include "vtkSmartPointer.h"

#include <cstdint>
#include <string>
#include <vector>

class vtkPolyData;

namespace delaunayflip
{

/// Whether any rank says so. All ranks must call this together, as most functions here.
bool IsOnAnyRank(bool flag, PieceGroup& group);

/// The notes of all ranks, in their order, with the rank's number if there are several ranks.
std::vector<Note> ShareNotes(const std::vector<Note>& own, PieceGroup& group);

/// The mesh without cells that are copies of those of other ranks (vtkGhostType); the mesh itself
/// if it has none.
vtkSmartPointer<vtkPolyData> DropDuplicateCells(vtkPolyData* mesh);

/// The values of vtkGlobalPointIds, one per point; empty if the mesh has none.
std::vector<std::int64_t> ReadPointNumbers(vtkPolyData* mesh);

/// Gives regions the same labels on all ranks.
/// @param labels one per triangle, as LabelRegions has numbered them for the cells of `mesh`.
void ShareRegionLabels(vtkPolyData* mesh, const std::string& array,
  std::vector<std::int32_t>& labels, PieceGroup& group);

/// Constraints, and the mesh whose points they name if they have none of their own; or null.
struct ConstraintsOfMesh
{
  vtkPolyData* Constraints;
  vtkPolyData* Mesh;
};

/// The constraints of several meshes as one; null if there are none.
vtkSmartPointer<vtkPolyData> JoinConstraints(const std::vector<ConstraintsOfMesh>& sources);

/// The constraints of all ranks as one mesh: each rank may have all of them, or a part. Null if
/// they name points of the rank's own mesh by id, or if there are none.
vtkSmartPointer<vtkPolyData> GatherConstraints(
  vtkPolyData* constraints, vtkPolyData* mesh, PieceGroup& group);

}

#endif
