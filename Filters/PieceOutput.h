// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef PieceOutput_h
#define PieceOutput_h

#include "PieceFlip.h"
#include "PieceGroup.h"

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <vector>

class vtkCellData;
class vtkDataArray;
class vtkPoints;
class vtkPolyData;

namespace delaunayflip
{

class TriangleSlots;

/// Writes the piece of a rank, with the data of what it has received.
class PieceOutput
{
public:
  /// All must live as long as this object.
  PieceOutput(vtkPolyData* mesh, const TriangleSlots& slots, const FlippedPiece& flipped);

  /// All ranks must call this together.
  /// @param cellData the data of the mesh's cells, perhaps with further arrays.
  /// @param areDivided whether a rank has divided cells, so that their global ids are not unique.
  void Store(vtkCellData* cellData, bool areDivided, PieceGroup& group, vtkPolyData* output) const;

  /// One value per cell of the output: that of its triangle, or another one for other cells.
  template <typename ArrayT, typename Value>
  void AddTriangleArray(
    const char* name, const std::vector<Value>& values, Value elsewhere, vtkPolyData* output) const;

  /// Recomputes the active normals of triangles that took part in a flip, on the side on which they
  /// have been.
  void RenewNormals(vtkPolyData* output) const;

private:
  struct OutputCell
  {
    vtkIdType Source; ///< The cell of the mesh, or -1: received.
    vtkIdType Triangle; ///< Its number in the flipped piece, or -1.
  };

  void ListPolygons();
  vtkIdType CountReceived() const
  {
    return static_cast<vtkIdType>(this->Flipped.ReceivedTriangles.size());
  }
  void StorePoints(PieceGroup& group, vtkPolyData* output) const;
  void StoreCells(vtkPolyData* output) const;
  void StoreCellData(vtkCellData* cellData, vtkCellData* received, vtkPolyData* output) const;
  vtkSmartPointer<vtkPoints> MakePoints() const;
  void RenewNormal(
    vtkIdType cell, vtkIdType triangle, vtkPoints* points, vtkDataArray* normals) const;
  bool IsUnchanged() const;

  vtkPolyData* Mesh;
  const TriangleSlots& Slots;
  const FlippedPiece& Flipped;
  std::vector<OutputCell> Polygons; ///< Of the output.
};

}

#endif
