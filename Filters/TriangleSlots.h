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

class SplitProgress;

/// The triangles of a vtkPolyData: which cell each comes from, and which output cell it becomes.
///
/// Polygons that are triangles all are viewed in place. All else is copied: polygons and strips as
/// the triangles that they split into. A split cell either gives way to its triangles or, with
/// `triangulate` off, stays, and its triangles are frozen and never come out.
class TriangleSlots
{
public:
  static constexpr vtkIdType None = -1;

  /// @throws InvalidMesh when offsets and connectivity contradict each other, or when a polygon
  /// that is copied, or a strip, names a point outside `points`. Those viewed in place are not
  /// checked: the engine does that, much faster.
  /// @param progress hears how much of what has to be copied is.
  /// @throws SplitAborted.
  TriangleSlots(vtkPolyData* mesh, const PointArray& points, bool triangulate,
    const ProgressObserver& progress = {});
  TriangleSlots(const TriangleSlots&) = delete;
  TriangleSlots& operator=(const TriangleSlots&) = delete;

  /// @throws InvalidMesh that names the cell when a triangle names a point that is none.
  void RequireValidIds(vtkIdType numberOfPoints) const;

  /// The triangles for the engine; a view of this object or of the mesh.
  const TriangleArray& GetTriangles() const { return this->Triangles; }

  /// Whether the output's cells are, one to one, those of the mesh.
  bool AreInPlace() const { return this->InPlace; }

  /// Whether a cell gives way to more than one.
  bool DivideCells() const { return this->CellsAreDivided; }

  /// The cell of the mesh that `triangle` comes from.
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

  /// The triangle that output polygon `polygon` is, or None for one that stays as it is.
  vtkIdType GetTriangle(vtkIdType polygon) const
  {
    return this->InPlace ? polygon : this->Polygons[polygon].Triangle;
  }

  /// The cell of the mesh that output polygon `polygon` comes from.
  vtkIdType GetCellOfPolygon(vtkIdType polygon) const
  {
    return this->InPlace ? this->FirstPolygon + polygon : this->Polygons[polygon].Cell;
  }

  /// Cells of the mesh that are the strips of the output.
  const std::vector<vtkIdType>& GetStrips() const { return this->Strips; }

  /// The cell of the mesh that is its first polygon, and its first strip.
  vtkIdType GetFirstPolygon() const { return this->FirstPolygon; }
  vtkIdType GetFirstStrip() const { return this->FirstStrip; }

  /// Whether output polygon i is triangle i, for all of either.
  bool ArePolygonsTriangles() const;

private:
  struct OutputPolygon
  {
    vtkIdType Cell;
    vtkIdType Triangle;
  };

  bool ViewPolygons(vtkCellArray* polygons);
  void ReadPolygons(vtkCellArray* polygons, const PointArray& points, SplitProgress& progress);
  void ReadPolygon(
    vtkIdType cell, vtkIdList* ids, const PointArray& points, SplitProgress& progress);
  void ReadStrips(vtkCellArray* strips, const PointArray& points, SplitProgress& progress);
  void AddStripTriangles(vtkIdList* ids);
  void AddTriangles(vtkIdType cell, vtkIdType count, bool stays);

  bool Triangulate;
  bool InPlace = false;
  bool CellsAreDivided = false;
  vtkIdType FirstPolygon;
  vtkIdType FirstStrip;
  TriangleArray Triangles;

  // Empty in place. One entry per triangle (Ids: three):
  std::vector<std::int64_t> Ids;
  std::vector<vtkIdType> Cells;
  std::vector<unsigned char> Frozen;
  // One entry an output cell:
  std::vector<OutputPolygon> Polygons;
  std::vector<vtkIdType> Strips;
};

}

#endif
