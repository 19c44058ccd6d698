// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef OutputCells_h
#define OutputCells_h

#include "vtkSmartPointer.h"

#include <cstdint>
#include <vector>

class vtkCellArray;
class vtkCellData;
class vtkDataArray;
class vtkPolyData;

namespace delaunayflip
{

class FlipSession;
class TriangleSlots;

/// The polygons of the output. Their ids are stored as wide as those of the mesh's polygons, or of
/// its strips if it has no polygons.
vtkSmartPointer<vtkCellArray> BuildPolygons(
  const FlipSession& session, const TriangleSlots& slots, vtkPolyData* mesh);

/// Whether the ids of the polygons of a mesh, or of its strips if it has no polygons, have 64 bits.
bool UsesWideIds(vtkPolyData* mesh);

/// The strips of the output: those of the mesh that were not split.
vtkSmartPointer<vtkCellArray> BuildStrips(const TriangleSlots& slots, vtkPolyData* mesh);

class TriangleSlots;
struct PointArray;

/// Gives every cell of `output` the cell data of the cell of `mesh` from which it was made. Shares
/// the arrays if all cells kept their positions; otherwise leaves out those with too few tuples.
/// Where cells were divided, global ids become pedigree ids, or a plain array if the mesh has
/// pedigree ids already.
void PassCellData(vtkPolyData* mesh, const TriangleSlots& slots, vtkPolyData* output);

/// Turns global ids into pedigree ids: when cells are divided, several share an id.
void DemoteGlobalIds(vtkCellData* data);

/// A copy of the active cell normals, to be changed; null if there are none, or too few.
vtkSmartPointer<vtkDataArray> CopyNormals(vtkPolyData* output);

/// Recomputes the active cell normals of `output` for the triangles that flips have changed. A
/// normal that pointed against the winding of the old triangle points against that of the new one.
/// Normals with too few tuples stay as they are.
void RenewNormals(const PointArray& points, const TriangleSlots& slots, vtkPolyData* output);

/// A cell array to be added.
template <typename ArrayT>
struct TriangleArrayValues
{
  using Value = typename ArrayT::ValueType;

  const char* Name;
  std::vector<Value> Values; ///< One per triangle of the slots.
  Value Elsewhere; ///< The value for cells that are not triangles.
};

/// Adds a cell array to the output. ArrayT: vtkIntArray or vtkDoubleArray.
template <typename ArrayT>
void AddTriangleArray(
  const TriangleArrayValues<ArrayT>& source, const TriangleSlots& slots, vtkPolyData* output);

}

#endif
