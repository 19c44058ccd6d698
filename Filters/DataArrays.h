// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DataArrays_h
#define DataArrays_h

#include "EngineExport.h"
#include "FlipReport.h"
#include "PointTriangulation.h"
#include "TriangleMesh.h"

#include "vtkCellArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <array>
#include <set>
#include <string>
#include <vector>

class vtkPoints;
class vtkUnsignedCharArray;

/// @file
/// The arrays of a vtkPolyData: views, checks, and copies of tuples.

namespace delaunayflip
{

/// A shallow copy that keeps as many cells as there are now, whatever observers of the filter
/// append to the input's cell arrays.
DELAUNAYFLIP_EXPORT vtkSmartPointer<vtkPolyData> ShareMesh(vtkPolyData* mesh);

/// A shallow copy.
inline vtkSmartPointer<vtkPolyData> CopyShallow(vtkPolyData* mesh)
{
  auto copy = vtkSmartPointer<vtkPolyData>::New();
  copy->ShallowCopy(mesh);
  return copy;
}

/// A view of the points if the engine can read their layout, else of a copy in `storage`.
/// @throws InvalidMesh if points do not have three coordinates.
DELAUNAYFLIP_EXPORT PointArray ViewPoints(vtkPolyData* mesh, std::vector<double>& storage);

/// A copy. Threads make it if the engine can read the layout of the points.
DELAUNAYFLIP_EXPORT vtkSmartPointer<vtkPoints> CopyPoints(vtkPoints* points);

/// The places of longitudes and latitudes on the unit sphere.
DELAUNAYFLIP_EXPORT vtkSmartPointer<vtkPoints> PlacePoints(vtkPoints* degrees);

/// A view of their x and y.
inline PlaneArray ViewPlane(const PointArray& points)
{
  if (points.Floats)
  {
    return { points.Floats, points.Count, 3 };
  }
  return { points.Doubles, points.Count, 3 };
}

/// Whether both have the same number of points and the same bits.
bool HaveSameBits(const PointArray& points, const PointArray& others);

/// Checks one cell array of a vtkPolyData before any of its ids is used.
struct PointIdCheck
{
  const char* What; ///< What messages call a cell, e.g. "cell".
  vtkIdType FirstCell; ///< The cell id, in the vtkPolyData, of the array's first cell.
  vtkIdType NumberOfPoints;

  /// @throws InvalidMesh when offsets and connectivity of `cells` contradict each other.
  DELAUNAYFLIP_EXPORT void RequireValid(vtkCellArray* cells) const;

  /// @throws InvalidMesh when `id`, named by cell `cell` of the array, is not a point.
  void RequireInRange(vtkIdType cell, vtkIdType id) const
  {
    if (id < 0 || id >= this->NumberOfPoints)
    {
      this->ThrowOutOfRange(cell, id);
    }
  }

private:
  [[noreturn]] DELAUNAYFLIP_EXPORT void ThrowOutOfRange(vtkIdType cell, vtkIdType id) const;
};

/// Calls visit(cell, ids) for the cells of an array, after checks.
/// @throws InvalidMesh.
template <typename Visit>
void VisitCells(vtkCellArray* cells, const PointIdCheck& check, const Visit& visit)
{
  check.RequireValid(cells);
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < cells->GetNumberOfCells(); ++cell)
  {
    cells->GetCellAtId(cell, ids);
    for (const vtkIdType id : *ids)
    {
      check.RequireInRange(cell, id);
    }
    visit(cell, ids.Get());
  }
}

/// Calls visit(cell, from, to, isClosed) for the edges along cells, after checks. If `areClosed`,
/// cells of three and more points are closed: the last edge joins the last point and the first one.
/// @throws InvalidMesh.
template <typename Visit>
void VisitEdges(vtkCellArray* cells, bool areClosed, const PointIdCheck& check, const Visit& visit)
{
  VisitCells(cells, check,
    [&](vtkIdType cell, vtkIdList* ids)
    {
      const vtkIdType count = ids->GetNumberOfIds();
      const bool isClosed = areClosed && count > 2;
      const vtkIdType edges = isClosed ? count : count - 1;
      for (vtkIdType i = 0; i < edges; ++i)
      {
        visit(cell, ids->GetId(i), ids->GetId((i + 1) % count), isClosed);
      }
    });
}

//------------------------------------------------------------------------------
/// The point array with the longest edges near points, which SizeArray names.
/// @throws InvalidOptions if there is none of one number for each of `count` points.
vtkDataArray* FindSizes(vtkPolyData* mesh, const std::string& name, vtkIdType count);

/// Region seeds, from x, y, label and largest area of each.
/// @throws InvalidOptions if a label is no 32-bit integer.
std::vector<RegionSeed> ReadRegionSeeds(const std::vector<std::array<double, 4>>& regions);

/// The values, or null if there are none.
template <typename Value>
const Value* ViewValues(const std::vector<Value>& values)
{
  return values.empty() ? nullptr : values.data();
}

/// Gives a cell array without cells ids of 64 or 32 bits.
inline void SetWidth(vtkCellArray* cells, bool areWide)
{
  if (areWide)
  {
    cells->Use64BitStorage();
  }
  else
  {
    cells->Use32BitStorage();
  }
}

/// VTK's number of the type of coordinates.
inline int FindPointType(bool areFloats) { return areFloats ? VTK_FLOAT : VTK_DOUBLE; }

/// The name of an array; "" if it has none.
DELAUNAYFLIP_EXPORT std::string GetName(vtkAbstractArray* array);

/// The names of arrays, e.g. "it has \"Side\", \"Material\"".
DELAUNAYFLIP_EXPORT std::string ListNames(vtkDataSetAttributes* data);

/// Names an array, or takes its name away if it is "".
DELAUNAYFLIP_EXPORT void SetName(const std::string& name, vtkAbstractArray* array);

/// A shallow copy without the arrays that have fewer than `tuples` tuples: they would be read past
/// their end.
DELAUNAYFLIP_EXPORT vtkSmartPointer<vtkDataSetAttributes> TakeWholeArrays(
  vtkDataSetAttributes* data, vtkIdType tuples);

/// Whether an array is named as ghost types are, but has not one number of type unsigned char for
/// each tuple. Such an array is ignored.
bool IsWrongGhostArray(vtkAbstractArray* array);

/// The ghost types of the cells, which may be fewer than the cells. Null if there are none or they
/// are ignored.
DELAUNAYFLIP_EXPORT vtkSmartPointer<vtkUnsignedCharArray> FindGhosts(vtkPolyData* mesh);

//------------------------------------------------------------------------------
/// The numbers from `first` on.
DELAUNAYFLIP_EXPORT vtkSmartPointer<vtkIdList> MakeRange(vtkIdType first, vtkIdType count);

/// Which attributes of `data` an array is, one bit for each.
DELAUNAYFLIP_EXPORT int FindAttributes(vtkDataSetAttributes* data, vtkAbstractArray* array);

/// Makes an array these attributes, except those that `data` has.
DELAUNAYFLIP_EXPORT void AddAttributes(vtkDataSetAttributes* data, int index, int attributes);

/// Copies the tuples `sources` of all arrays of `own` to the tuples `places` of `data`. An array
/// that `data` does not have yet is added, with zeros or empty texts for its other tuples. It keeps
/// being an attribute unless `data` has one of that kind. If `data` has an array of the same name,
/// but with another type or number of components, it is added under another name. Arrays without a
/// name are the same if they are alike and in the same order.
/// @param size how many tuples the arrays of `data` have.
/// @returns the names of the arrays of `data` that have got tuples.
DELAUNAYFLIP_EXPORT std::set<std::string> AddTuples(vtkDataSetAttributes* own, vtkIdList* sources,
  vtkIdList* places, vtkIdType size, vtkDataSetAttributes* data);

/// Turns global ids into pedigree ids: when cells are divided or points added, several share an id.
/// If there are pedigree ids already, the array is no attribute any more.
DELAUNAYFLIP_EXPORT void DemoteGlobalIds(vtkDataSetAttributes* data);

/// Writes the tuples of points that the engine has added, from `first` on, interpolated between
/// those of other points. Labels of points are not interpolated.
void InterpolateTuples(
  const std::vector<AddedPoint>& added, vtkIdType first, vtkDataSetAttributes* data);

/// Turns arrays of integers into arrays of doubles, so that interpolated values are not rounded.
void TurnToDoubles(vtkDataSetAttributes* data);

/// Turns arrays of numbers into arrays of floats or doubles where `own` has one of that name, so
/// that AddTuples puts both into one array. Labels stay as they are.
void TurnToRealsOf(vtkDataSetAttributes* own, vtkDataSetAttributes* data);

/// The points of a mesh, then some of `more`: as double, unless those of the mesh are float.
vtkSmartPointer<vtkPoints> ExtendPoints(vtkPolyData* mesh, vtkPoints* more, vtkIdList* ids);

/// Gives `output` the points of a mesh, then some of `more`, with their data.
/// @param ids which of them. @param data of `more`; or null: zeros.
/// @returns the names of the arrays that have got tuples of `data`.
DELAUNAYFLIP_EXPORT std::set<std::string> AppendPoints(vtkPolyData* mesh, vtkPoints* more,
  vtkIdList* ids, vtkDataSetAttributes* data, vtkPolyData* output);

/// Does so for points that the engine has added to those of a triangulation. Their coordinates and
/// data are interpolated.
/// @param hasPlaces whether x and y of the mesh are the engine's.
void AppendAdded(
  const std::vector<AddedPoint>& added, bool hasPlaces, vtkPolyData* mesh, vtkPolyData* output);

/// A copy of x and y, in the storage of their precision.
PlaneArray CopyPlaces(
  const PlaneArray& places, std::vector<float>& floats, std::vector<double>& doubles);

}

#endif
