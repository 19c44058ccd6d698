// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef CellAttributes_h
#define CellAttributes_h

#include <cstdint>
#include <vector>

class vtkPolyData;

namespace delaunayflip
{

class TriangleSlots;
struct PointArray;

/// Gives every cell of `output` the cell data of the cell of `mesh` that it comes from. Shares the
/// arrays where no cell changed its place. Where cells were divided, global ids become pedigree
/// ids, or a plain array beside pedigree ids that the mesh has already.
void PassCellData(vtkPolyData* mesh, const TriangleSlots& slots, vtkPolyData* output);

/// Computes the active cell normals of `output` anew for the triangles whose points are not those
/// of their slot. A normal that pointed against the winding does so again.
void RenewNormals(const PointArray& points, const TriangleSlots& slots, vtkPolyData* output);

/// A cell array to be.
template <typename ArrayT>
struct TriangleArrayValues
{
  using Value = typename ArrayT::ValueType;

  const char* Name;
  std::vector<Value> Values; ///< One per triangle of the slots.
  Value Elsewhere; ///< For cells that are no triangles.
};

/// Adds a cell array to the output. ArrayT: vtkIntArray or vtkDoubleArray.
template <typename ArrayT>
void AddTriangleArray(
  const TriangleArrayValues<ArrayT>& source, const TriangleSlots& slots, vtkPolyData* output);

}

#endif
