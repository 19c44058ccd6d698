// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef PolyDataBridge_h
#define PolyDataBridge_h

#include "ConstraintEdges.h"
#include "FlipReport.h"
#include "TriangleMesh.h"
#include "TriangleSlots.h"

#include <cstdint>
#include <string>
#include <vector>

class vtkPolyData;

namespace delaunayflip
{

class FlipSession;

/// Both directions between vtkPolyData and the engine: translates, computes nothing. The mesh must
/// outlive the bridge.
class PolyDataBridge
{
public:
  struct Settings
  {
    bool Triangulate = true;
    bool LinesAsConstraints = true;
    std::string RegionArray; ///< Empty: no regions.
  };

  /// @param constraints may be null.
  /// @param progress hears how much of the splitting of polygons is done, where there are any.
  /// @throws InvalidMesh, InvalidOptions, SplitAborted.
  PolyDataBridge(vtkPolyData* mesh, vtkPolyData* constraints, const Settings& settings,
    const ProgressObserver& progress = {});

  /// Whether polygons had to be split or copied, which takes time.
  bool HasSplit() const { return !this->Slots.AreInPlace(); }

  /// @throws InvalidMesh that names the cell when a triangle names a point that is none.
  void RequireValidIds() const { this->Slots.RequireValidIds(this->Points.Count); }

  /// Edges of the second input where the mesh has none. More may be among GetMesh()'s.
  std::int64_t GetNumberOfUnmatchedConstraints() const { return this->Constraints.Unmatched; }

  /// Views of the mesh or of this bridge, none of them of an output.
  TriangleMesh GetMesh() const;

  /// Writes the session's triangles and all that passes of the mesh.
  void Store(const FlipSession& session, vtkPolyData* output) const;

  /// Adds vtkDelaunayFlipCount to the cells of an output that Store has written.
  void StoreFlipCounts(const FlipSession& session, vtkPolyData* output) const;

  /// Adds vtkDelaunayFlipAngleBefore and vtkDelaunayFlipAngleAfter to the cells of such an output.
  void StoreAngles(const FlipSession& session, int threads, vtkPolyData* output) const;

  /// Turns triangle numbers into ids of the mesh's cells, for warnings.
  void NumberCells(std::vector<Defect>& defects) const;

private:
  void FreezeGhosts();
  void LabelTriangles(const std::string& array);

  vtkPolyData* Mesh;
  std::vector<double> Coordinates; ///< Of points that cannot be viewed in place.
  PointArray Points;
  TriangleSlots Slots;
  ConstraintEdges Constraints;
  std::vector<std::int32_t> Regions; ///< Empty, or one per triangle.
  std::vector<unsigned char> Frozen; ///< Empty, or one a triangle.
};

}

#endif
