// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef TriangleSlots_h
#define TriangleSlots_h

#include "FlipReport.h"
#include "TriangleMesh.h"

#include "vtkType.h"

#include <cstdint>
#include <vector>

class vtkCellArray;
class vtkIdList;
class vtkPolyData;

namespace delaunayflip
{

class WorkProgress;

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
    const ProgressObserver& progress = {});
  TriangleSlots(const TriangleSlots&) = delete;
  TriangleSlots& operator=(const TriangleSlots&) = delete;

  /// @throws InvalidMesh, which names the cell, when a triangle names a point that does not exist.
  void RequireValidIds(vtkIdType numberOfPoints) const;

  /// The triangles for the engine: a view of an array of this object or of the mesh.
  const TriangleArray& GetTriangles() const { return this->Triangles; }

  /// Whether the cells of the output correspond one to one to those of the mesh.
  bool AreInPlace() const { return this->InPlace; }

  /// Whether some cell is replaced by more than one.
  bool DivideCells() const { return this->CellsAreDivided; }

  /// The cell of the mesh from which `triangle` is made.
  vtkIdType GetCell(vtkIdType triangle) const
  {
    return this->InPlace ? this->FirstPolygon + triangle : this->Cells[triangle];
  }

  /// Whether `triangle` is part of a cell that stays as it is.
  bool IsFrozen(vtkIdType triangle) const { return !this->InPlace && this->Frozen[triangle] != 0; }

  vtkIdType GetNumberOfPolygons() const
  {
    return static_cast<vtkIdType>(
      this->InPlace ? this->Triangles.Count : static_cast<vtkIdType>(this->Polygons.size()));
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

  /// The cells of the mesh that become the strips of the output.
  const std::vector<vtkIdType>& GetStrips() const { return this->Strips; }

  /// The cell ids of the mesh's first polygon and first strip.
  vtkIdType GetFirstPolygon() const { return this->FirstPolygon; }
  vtkIdType GetFirstStrip() const { return this->FirstStrip; }

  /// Whether output polygon i is triangle i for every i, and there are no others.
  bool ArePolygonsTriangles() const;

private:
  struct OutputPolygon
  {
    vtkIdType Cell;
    vtkIdType Triangle;
  };

  bool ViewPolygons(vtkCellArray* polygons);
  void ReadPolygons(vtkCellArray* polygons, const PointArray& points, WorkProgress& progress);
  void ReadPolygon(
    vtkIdType cell, vtkIdList* ids, const PointArray& points, WorkProgress& progress);
  void ReadStrips(vtkCellArray* strips, const PointArray& points, WorkProgress& progress);
  void AddStripTriangles(vtkIdList* ids);
  void AddTriangles(vtkIdType cell, vtkIdType count, bool stays);

  bool Triangulate;
  bool InPlace = false;
  bool CellsAreDivided = false;
  vtkIdType FirstPolygon;
  vtkIdType FirstStrip;
  TriangleArray Triangles;

  // Empty if viewed in place, else with one entry per triangle (Ids: three):
  std::vector<std::int64_t> Ids;
  std::vector<vtkIdType> Cells;
  std::vector<unsigned char> Frozen;
  // One entry per output cell:
  std::vector<OutputPolygon> Polygons;
  std::vector<vtkIdType> Strips;
};

}

#endif
