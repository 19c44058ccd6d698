// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef PolyDataBridge_h
#define PolyDataBridge_h

#include "ConstraintEdges.h"
#include "DelaunayFlip.h"
#include "EngineExport.h"
#include "FlipReport.h"
#include "TriangleMesh.h"

#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
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

  /// Whether output polygon i is triangle i for every i, and there are no others.
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

//------------------------------------------------------------------------------
// What outputs have in common.

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

/// Recomputes the active cell normals of changed triangles. A normal that pointed against the
/// winding of the triangle before points against that of the new one. Normals with too few tuples
/// stay as they are.
DELAUNAYFLIP_EXPORT void RenewNormals(vtkPolyData* output, const FindChange& findChange);

/// Adds a cell array to an output: vtkIntArray for integers, else vtkDoubleArray.
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
  output->GetCellData()->AddArray(array);
}

}

#endif
