// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef TriangleSlots_h
#define TriangleSlots_h

#include "FlipReport.h"
#include "TriangleMesh.h"

#include "vtkPolyData.h"

#include <cstdint>
#include <vector>

namespace delaunayflip
{

/// A polygon of an output: one of the triangles, or a cell of the mesh that stays as it is.
struct OutputPolygon
{
  vtkIdType Cell; ///< The cell of the mesh from which it is made, or TriangleSlots::None.
  vtkIdType Triangle; ///< The triangle of the mesh, or TriangleSlots::None.
};

/// The triangles of a vtkPolyData: from which cell each is made, and which output cell it becomes.
///
/// If all polygons are triangles, they are viewed in place. Otherwise polygons and strips are
/// copied as the triangles into which they split, without those triangles of strips that name a
/// point twice, as strips do to continue elsewhere. The output has these triangles in place of the
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

  /// The cell of the mesh from which `triangle` is made.
  vtkIdType GetCell(vtkIdType triangle) const
  {
    return this->InPlace ? this->FirstPolygon + triangle : this->Cells[triangle];
  }

  vtkIdType GetNumberOfPolygons() const
  {
    return this->InPlace ? this->Triangles.Count : static_cast<vtkIdType>(this->Polygons.size());
  }

  OutputPolygon GetPolygon(vtkIdType polygon) const
  {
    return this->InPlace ? OutputPolygon{ this->FirstPolygon + polygon, polygon }
                         : this->Polygons[polygon];
  }

  /// Whether output polygon i is triangle i for every i, and there are no others, though cells are
  /// not used in place.
  bool ArePolygonsTriangles() const;

  bool InPlace = false; ///< The cells of the output correspond one to one to those of the mesh.
  bool AreDivided = false; ///< Some cell is replaced by more than one.
  vtkIdType FirstPolygon; ///< The cell id of the mesh's first polygon.
  vtkIdType FirstStrip;
  TriangleArray Triangles; ///< For the engine: a view of an array of this object or of the mesh.
  std::vector<unsigned char> Frozen; ///< One flag per triangle: it stays. Empty if none does.
  std::vector<vtkIdType> Strips; ///< The cells of the mesh that become the strips of the output.
  std::vector<OutputPolygon> Polygons; ///< Empty if viewed in place, as the following ones.
  /// Polygons of more than three points, of which fewer than three differ; by cell. They are no
  /// triangle, and only in the output if `triangulate` is off.
  Defect NoTriangles;

private:
  void AddTriangles(vtkIdType cell, vtkIdType count, bool stays);
  void CountNoTriangle(vtkIdType cell);
  void SplitStrip(vtkIdType cell, vtkIdList* ids, bool triangulate);

  std::vector<std::int64_t> Ids; ///< Three per triangle.
  std::vector<vtkIdType> Cells; ///< One per triangle.
};

}

#endif
