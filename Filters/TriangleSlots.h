// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef TriangleSlots_h
#define TriangleSlots_h

#include "EngineExport.h"
#include "FlipReport.h"
#include "TriangleMesh.h"

#include "vtkType.h"

#include <cstdint>
#include <vector>

class vtkPolyData;

namespace delaunayflip
{

/// The triangles of a vtkPolyData: from which cell each is made, and which output cell it becomes.
///
/// If all polygons are triangles, they are viewed in place. Otherwise polygons and strips are
/// copied as the triangles into which they split. The output has these triangles in place of the
/// cell; with `triangulate` off it has the cell itself, and the triangles are frozen and not part
/// of the output.
class TriangleSlots
{
public:
  static constexpr vtkIdType None = -1;

  /// @throws InvalidMesh when offsets and connectivity contradict each other, or when a polygon
  /// that is copied, or a strip, names a point outside `points`. Polygons viewed in place are
  /// checked by the engine, which is much faster.
  /// @param progress is told the share of cells that are copied.
  /// @throws RunAborted.
  TriangleSlots(vtkPolyData* mesh, const PointArray& points, bool triangulate,
    const ProgressObserver& progress);

  /// @throws InvalidMesh, which names the cell, when a triangle names a point that does not exist.
  DELAUNAYFLIP_EXPORT void RequireValidIds(vtkIdType numberOfPoints) const;

  /// The cell of the mesh from which `triangle` is made.
  vtkIdType GetCell(vtkIdType triangle) const
  {
    return this->InPlace ? this->FirstPolygon + triangle : this->Cells[triangle];
  }

  vtkIdType GetNumberOfPolygons() const
  {
    return this->InPlace ? this->Triangles.Count : static_cast<vtkIdType>(this->Polygons.size());
  }

  /// The triangle of output polygon `polygon`, or None if that is a cell that stays as it is.
  vtkIdType GetTriangle(vtkIdType polygon) const
  {
    return this->InPlace ? polygon : this->Polygons[polygon].Triangle;
  }

  /// The cell of the mesh from which output polygon `polygon` is made.
  vtkIdType GetCellOfPolygon(vtkIdType polygon) const
  {
    return this->InPlace ? this->FirstPolygon + polygon : this->Polygons[polygon].Cell;
  }

  /// Whether output polygon i is triangle i for every i, and there are no others.
  bool ArePolygonsTriangles() const;

  bool InPlace = false; ///< The cells of the output correspond one to one to those of the mesh.
  bool AreDivided = false; ///< Some cell is replaced by more than one.
  vtkIdType FirstPolygon; ///< The cell id of the mesh's first polygon.
  vtkIdType FirstStrip;
  TriangleArray Triangles; ///< For the engine: a view of an array of this object or of the mesh.
  std::vector<unsigned char> Frozen; ///< One flag per triangle: it stays. Or empty.
  std::vector<vtkIdType> Strips; ///< The cells of the mesh that become the strips of the output.

private:
  struct OutputPolygon
  {
    vtkIdType Cell;
    vtkIdType Triangle;
  };

  void AddTriangles(vtkIdType cell, vtkIdType count, bool stays);

  // Empty if viewed in place:
  std::vector<std::int64_t> Ids; ///< Three per triangle.
  std::vector<vtkIdType> Cells; ///< One per triangle.
  std::vector<OutputPolygon> Polygons;
};

}

#endif
