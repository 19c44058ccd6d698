// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef PolyDataBridge_h
#define PolyDataBridge_h

#include "ConstraintEdges.h"
#include "DelaunayFlip.h"
#include "EngineExport.h"
#include "FlipReport.h"
#include "OutputCells.h"
#include "TriangleMesh.h"
#include "TriangleSlots.h"

#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <array>
#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

namespace delaunayflip
{

class UpdatePlan;

/// How a mesh is read.
struct BridgeSettings : ConstraintSettings
{
  bool Triangulate = true;
  std::string RegionArray; ///< Empty: no regions.
  std::string SizeArray; ///< The name of a point array of longest edges. Empty: none.
  std::vector<std::array<double, 4>> RegionSeeds; ///< x, y, label and largest area of each.
  bool Refines = false; ///< Whether options, SizeArray or areas of regions ask for refinement.
};

inline bool operator==(const BridgeSettings& a, const BridgeSettings& b)
{
  const auto tie = [](const BridgeSettings& s)
  {
    return std::tie(s.Triangulate, s.LinesAsConstraints, s.InsertLines, s.InsertConstraints,
      s.RegionArray, s.SizeArray, s.RegionSeeds, s.Refines);
  };
  return tie(a) == tie(b);
}

/// Translates between vtkPolyData and the engine, in both directions; computes nothing. The mesh
/// must outlive the bridge.
class DELAUNAYFLIP_EXPORT PolyDataBridge
{
public:
  /// @param constraints may be null.
  /// @throws InvalidMesh, InvalidOptions, RunAborted.
  PolyDataBridge(vtkPolyData* mesh, vtkPolyData* constraints, const BridgeSettings& settings,
    const UpdatePlan& plan);
  PolyDataBridge(const PolyDataBridge&) = delete;
  PolyDataBridge& operator=(const PolyDataBridge&) = delete;

  /// @throws InvalidMesh, which names the cell, when a triangle names a point that does not exist.
  void RequireValidIds() const;

  /// Views points at other places, of a mesh that has all else in common with the one that this
  /// bridge reads, and must outlive the bridge.
  /// @param coordinates the memory of the points if they are not those of the mesh; receives the
  /// memory of the points before.
  void MovePoints(vtkPolyData* mesh, const PointArray& points, std::vector<double>& coordinates);

  /// GetMesh() may hold more edges that are unmatched.
  const ConstraintEdges& GetConstraints() const { return this->Constraints; }

  /// Views of arrays of the mesh or of this bridge, never of an output.
  TriangleMesh GetMesh() const;

  const TriangleSlots& GetSlots() const { return this->Slots; }

  /// Whether the session may add points and triangles.
  bool IsRefined() const { return this->Refines; }

  /// Makes new cells for the polygons of an output. Returns null unless all polygons are triangles
  /// of the session, and refinement will add none.
  vtkSmartPointer<vtkCellArray> MakeRoom() const;

  /// Writes the session's triangles, and whatever passes from the mesh.
  /// @param room what MakeRoom() has returned; it becomes part of the output.
  /// @param mesh the one that this bridge reads, perhaps with other attributes by now.
  void Store(const FlipSession& session, const vtkSmartPointer<vtkCellArray>& room,
    vtkPolyData* mesh, vtkPolyData* output) const;

  /// Adds vtkDelaunayFlipCount to the cells of an output that Store has written.
  void StoreFlipCounts(const FlipSession& session, vtkPolyData* output) const;

  /// Adds the labels of region seeds, if there are any, to the cells of such an output.
  void StoreRegions(const FlipSession& session, vtkPolyData* output) const;

  /// Adds the smallest angles before and after to the cells of such an output.
  /// @throws RunAborted; then there is neither of them.
  void StoreAngles(const FlipSession& session, int threads, const ProgressObserver& progress,
    vtkPolyData* output) const;

  /// Replaces triangle ids by cell ids of the mesh, for warnings.
  void NumberCells(std::vector<Defect>& defects) const;

  // Without regions both are empty.
  std::vector<std::int32_t> Regions; ///< A label per triangle. May be changed.
  std::vector<std::string>
    RegionKeys; ///< One per label. Equal values have equal keys in all meshes.

private:
  void FreezeGhosts();
  void LabelRegions(const std::string& name, const ProgressObserver& progress);
  void ReadSizes(const std::string& name);

  /// The polygons of an output of a refined mesh.
  struct RefinedPolygons
  {
    std::vector<std::int32_t> Sources; ///< By triangle: FlipSession::StoreSources.
    std::vector<OutputPolygon> Polygons; ///< Each has the cell of its triangle's source.

    vtkIdType GetSource(vtkIdType polygon) const
    {
      const vtkIdType triangle = this->Polygons[polygon].Triangle;
      return triangle < 0 ? triangle : this->Sources[triangle];
    }
  };
  RefinedPolygons ListRefined(const FlipSession& session) const;
  void AddNumbers(
    const char* name, const std::vector<std::int32_t>& numbers, vtkPolyData* output) const;
  void StoreRefined(const FlipSession& session, vtkPolyData* mesh, vtkPolyData* output) const;
  static void AppendRefinedPoints(
    const FlipSession& session, vtkPolyData* mesh, vtkPolyData* output);

  vtkPolyData* Mesh;
  std::vector<double> Coordinates; ///< A copy of points that cannot be viewed in place.
  PointArray Points;
  std::vector<double> Sizes; ///< By point; empty: no limits.
  std::vector<RegionSeed> RegionSeeds;
  bool AreLinesConstraints;
  bool Refines;
  TriangleSlots Slots;
  ConstraintEdges Constraints;
};

}

#endif
