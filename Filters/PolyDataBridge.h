// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef PolyDataBridge_h
#define PolyDataBridge_h

#include "ConstraintEdges.h"
#include "FlipReport.h"
#include "TriangleMesh.h"
#include "TriangleSlots.h"

#include "vtkSmartPointer.h"

#include <cstdint>
#include <string>
#include <vector>

class vtkPolyData;

namespace delaunayflip
{

class FlipSession;
class UpdatePlan;

/// A shallow copy that keeps as many cells as there are now, whatever observers of the filter
/// append to the input's cell arrays.
vtkSmartPointer<vtkPolyData> ShareMesh(vtkPolyData* mesh);

/// Translates between vtkPolyData and the engine, in both directions; computes nothing. The mesh
/// must outlive the bridge.
class PolyDataBridge
{
public:
  struct Settings
  {
    bool Triangulate = true;
    bool LinesAsConstraints = true;
    bool InsertLines = false;
    bool InsertConstraints = true;
    std::string RegionArray; ///< Empty: no regions.
  };

  /// @param constraints may be null.
  /// @throws InvalidMesh, InvalidOptions, RunAborted.
  PolyDataBridge(
    vtkPolyData* mesh, vtkPolyData* constraints, const Settings& settings, const UpdatePlan& plan);

  /// @throws InvalidMesh, which names the cell, when a triangle names a point that does not exist.
  void RequireValidIds() const { this->Slots.RequireValidIds(this->Points.Count); }

  /// How many edges of the second input have an end where the mesh has no point. GetMesh() may hold
  /// more edges that are unmatched.
  std::int64_t GetNumberOfUnmatchedConstraints() const { return this->Constraints.Unmatched; }

  /// Views of arrays of the mesh or of this bridge, never of an output.
  TriangleMesh GetMesh() const;

  const TriangleSlots& GetSlots() const { return this->Slots; }

  /// One label per triangle, which may be changed; empty without regions.
  std::vector<std::int32_t>& GetRegions() { return this->Regions; }

  /// Writes the session's triangles, and whatever passes from the mesh.
  void Store(const FlipSession& session, vtkPolyData* output) const;

  /// Adds vtkDelaunayFlipCount to the cells of an output that Store has written.
  void StoreFlipCounts(const FlipSession& session, vtkPolyData* output) const;

  /// Adds vtkDelaunayFlipAngleBefore and vtkDelaunayFlipAngleAfter to the cells of such an output.
  /// @throws RunAborted; then there is neither of them.
  void StoreAngles(const FlipSession& session, int threads, const ProgressObserver& progress,
    vtkPolyData* output) const;

  /// Replaces triangle ids by cell ids of the mesh, for warnings.
  void NumberCells(std::vector<Defect>& defects) const;

  /// Adds what is wrong with the arrays of the mesh.
  void AddDefects(std::vector<Defect>& defects) const;

private:
  void FreezeGhosts();
  void LabelTriangles(const std::string& array, const ProgressObserver& progress);

  vtkPolyData* Mesh;
  std::vector<double> Coordinates; ///< A copy of points that cannot be viewed in place.
  PointArray Points;
  TriangleSlots Slots;
  ConstraintEdges Constraints;
  std::vector<std::int32_t> Regions; ///< Empty, or one per triangle.
  std::vector<unsigned char> Frozen; ///< Empty, or one per triangle.
};

}

#endif
