// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef OutputCells_h
#define OutputCells_h

#include "DelaunayFlip.h"
#include "EngineExport.h"
#include "TriangleMesh.h"
#include "TriangleSlots.h"

#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <cstdint>
#include <functional>
#include <limits>
#include <type_traits>
#include <vector>

/// @file
/// The cells of outputs, and their data.

namespace delaunayflip
{

constexpr double NaN = std::numeric_limits<double>::quiet_NaN();

/// Room for triangles as cells.
/// @param areWide whether ids have 64 bits, even where 32 would do.
vtkSmartPointer<vtkCellArray> MakeRoomForTriangles(vtkIdType count, bool areWide);

/// The memory of such cells; none for null.
std::vector<ResultMemory> ListMemory(vtkCellArray* room);

/// Writes the session's triangles to such cells.
/// @param areOrdered whether by FlipSession::StoreOrderedTriangles.
void FillTriangles(const FlipSession& session, vtkCellArray* room, bool areOrdered = false);

/// Whether the ids of the polygons of a mesh, or of its strips if it has no polygons, have 64 bits.
DELAUNAYFLIP_EXPORT bool UsesWideIds(vtkPolyData* mesh);

/// Cells for the polygons of an output, with ids as wide as those of the mesh.
/// @param triangles the ids of those that are triangles.
DELAUNAYFLIP_EXPORT vtkSmartPointer<vtkCellArray> BuildPolygons(
  const std::vector<OutputPolygon>& polygons, const TriangleArray& triangles, vtkPolyData* mesh);

/// Writes the cells of an output, and their data, that are made from cells of the mesh: verts,
/// lines, the data of polygons, and strips.
/// @param received the data of the last polygons, which are not made from cells of this mesh.
DELAUNAYFLIP_EXPORT void StoreCells(vtkPolyData* mesh, const TriangleSlots& slots,
  const std::vector<OutputPolygon>& polygons, vtkDataSetAttributes* received, vtkPolyData* output);

/// Whether flips have changed this triangle, a polygon of an output. @param ids its points.
/// @param before receives its points before the flips; they stay `ids` if these are not known.
using FindChange =
  std::function<bool(vtkIdType polygon, const std::int64_t ids[3], std::int64_t before[3])>;

/// Recomputes the active cell normals of changed triangles, for an output that has normals. One
/// that pointed against the winding of the triangle before points against that of the new one.
/// Normals with too few tuples stay as they are.
DELAUNAYFLIP_EXPORT void RenewNormals(vtkPolyData* output, const FindChange& findChange);

/// Adds a cell array to an output: vtkIntArray for integers, else vtkDoubleArray. It is no
/// attribute, also if it replaces one.
/// @param values one per triangle. @param elsewhere the value for cells that are not triangles.
/// @param triangleOf the triangle of a polygon of the output, or a negative number.
template <typename Value, typename TriangleOf>
void AddTriangleArray(const char* name, const std::vector<Value>& values, Value elsewhere,
  const TriangleOf& triangleOf, vtkPolyData* output)
{
  vtkNew<std::conditional_t<std::is_integral<Value>::value, vtkIntArray, vtkDoubleArray>> array;
  array->SetName(name);
  array->SetNumberOfTuples(output->GetNumberOfCells());
  array->FillValue(elsewhere);
  const vtkIdType first = output->GetNumberOfVerts() + output->GetNumberOfLines();
  for (vtkIdType polygon = 0; polygon < output->GetNumberOfPolys(); ++polygon)
  {
    const vtkIdType triangle = triangleOf(polygon);
    if (triangle >= 0)
    {
      array->SetValue(first + polygon, values[triangle]);
    }
  }
  output->GetCellData()->RemoveArray(name); // or it would be global ids, if those had its name
  output->GetCellData()->AddArray(array);
}

}

#endif
