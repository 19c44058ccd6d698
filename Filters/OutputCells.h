// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef OutputCells_h
#define OutputCells_h

#include "vtkSmartPointer.h"

class vtkCellArray;
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

}

#endif
