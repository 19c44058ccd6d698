// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "OutputCells.h"

#include "DelaunayFlip.h"
#include "MalformedArrays.h"
#include "PolygonSplit.h"
#include "TriangleSlots.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkIdList.h"
#include "vtkIntArray.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkSMPTools.h"
#include "vtkSmartPointer.h"
#include "vtkTypeInt32Array.h"
#include "vtkTypeInt64Array.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <new>
#include <numeric>
#include <vector>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace delaunayflip
{
namespace
{

/// Hints to Linux to back new memory with pages of 2 MiB instead of 4 KiB, which are each allocated
/// and cleared on first use: an update of 5 M points on a GPU takes 56 ms instead of 63.
template <typename ArrayT>
void AskForHugePages(ArrayT* array)
{
#if defined(__linux__)
  constexpr std::uintptr_t HugePage = std::uintptr_t(2) << 20;
  const auto begin = reinterpret_cast<std::uintptr_t>(array->GetPointer(0));
  const std::uintptr_t end = begin + array->GetNumberOfValues() * array->GetDataTypeSize();
  const std::uintptr_t first = (begin + HugePage - 1) / HugePage * HugePage;
  if (first + HugePage <= end)
  {
    madvise(reinterpret_cast<void*>(first), (end - first) / HugePage * HugePage, MADV_HUGEPAGE);
  }
#else
  (void)array;
#endif
}

/// Offsets of triangles. Not shared with the input, whose cells may grow in place later: the output
/// would then have more offsets than connectivity.
template <typename ArrayT>
vtkSmartPointer<ArrayT> MakeOffsets(vtkIdType count)
{
  using Value = typename ArrayT::ValueType;
  auto offsets = vtkSmartPointer<ArrayT>::New();
  offsets->SetNumberOfTuples(count + 1);
  Value* values = offsets->GetPointer(0);
  vtkSMPTools::For(0, count + 1,
    [values](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType i = begin; i < end; ++i)
      {
        values[i] = static_cast<Value>(3 * i);
      }
    });
  return offsets;
}

/// Triangle cells, whose connectivity the session writes directly. Id is the engine's type for the
/// values of ArrayT.
template <typename ArrayT, typename Id>
vtkSmartPointer<vtkCellArray> BuildTriangles(const FlipSession& session, vtkIdType count)
{
  const vtkSmartPointer<ArrayT> offsets = MakeOffsets<ArrayT>(count);
  vtkNew<ArrayT> connectivity;
  connectivity->SetNumberOfTuples(3 * count);
  AskForHugePages(connectivity.Get());
  session.StoreTriangles(
    MutableTriangleArray(reinterpret_cast<Id*>(connectivity->GetPointer(0)), count));
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  cells->SetData(offsets, connectivity);
  return cells;
}

/// Cells with room for so many, so that inserting them asks for no memory: VTK 9.6 may abort then.
vtkSmartPointer<vtkCellArray> MakeRoom(bool isWide, vtkIdType count, vtkIdType points)
{
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  isWide ? cells->Use64BitStorage() : cells->Use32BitStorage();
  if (!cells->AllocateExact(count, points))
  {
    throw std::bad_alloc();
  }
  return cells;
}

/// How many points the polygons have that stay as they are.
vtkIdType CountKeptPoints(const TriangleSlots& slots, vtkCellArray* polygons)
{
  vtkIdType count = 0;
  for (vtkIdType polygon = 0; polygon < slots.GetNumberOfPolygons(); ++polygon)
  {
    if (slots.GetTriangle(polygon) == TriangleSlots::None)
    {
      count += polygons->GetCellSize(slots.GetCellOfPolygon(polygon) - slots.GetFirstPolygon());
    }
  }
  return count;
}

/// Triangles of the session, and between them the polygons that stay as they are.
vtkSmartPointer<vtkCellArray> BuildMixedPolygons(
  const FlipSession& session, const TriangleSlots& slots, vtkPolyData* mesh)
{
  const vtkIdType count = slots.GetTriangles().Count;
  std::vector<std::int64_t> storage(3 * count);
  const MutableTriangleArray triangles(storage.data(), count);
  session.StoreTriangles(triangles);

  const vtkSmartPointer<vtkCellArray> cells = MakeRoom(UsesWideIds(mesh),
    slots.GetNumberOfPolygons(), 3 * count + CountKeptPoints(slots, mesh->GetPolys()));
  vtkNew<vtkIdList> ids;
  for (vtkIdType polygon = 0; polygon < slots.GetNumberOfPolygons(); ++polygon)
  {
    const vtkIdType triangle = slots.GetTriangle(polygon);
    if (triangle == TriangleSlots::None)
    {
      mesh->GetPolys()->GetCellAtId(slots.GetCellOfPolygon(polygon) - slots.GetFirstPolygon(), ids);
      cells->InsertNextCell(ids);
    }
    else
    {
      cells->InsertNextCell(
        { triangles.Get(triangle, 0), triangles.Get(triangle, 1), triangles.Get(triangle, 2) });
    }
  }
  return cells;
}

}

bool UsesWideIds(vtkPolyData* mesh)
{
  vtkCellArray* cells = mesh->GetNumberOfPolys() > 0 ? mesh->GetPolys() : mesh->GetStrips();
  return cells->GetConnectivityArray()->GetDataTypeSize() == 8;
}

vtkSmartPointer<vtkCellArray> BuildPolygons(
  const FlipSession& session, const TriangleSlots& slots, vtkPolyData* mesh)
{
  if (!slots.ArePolygonsTriangles())
  {
    return BuildMixedPolygons(session, slots, mesh);
  }
  // Splitting may need more connectivity than 32-bit offsets can number.
  const vtkIdType count = slots.GetTriangles().Count;
  if (UsesWideIds(mesh) || 3 * count > std::numeric_limits<std::int32_t>::max())
  {
    return BuildTriangles<vtkTypeInt64Array, std::int64_t>(session, count);
  }
  return BuildTriangles<vtkTypeInt32Array, std::int32_t>(session, count);
}

vtkSmartPointer<vtkCellArray> BuildStrips(const TriangleSlots& slots, vtkPolyData* mesh)
{
  if (static_cast<vtkIdType>(slots.GetStrips().size()) == mesh->GetNumberOfStrips())
  {
    return mesh->GetStrips();
  }
  vtkCellArray* strips = mesh->GetStrips();
  const vtkSmartPointer<vtkCellArray> cells = MakeRoom(sizeof(vtkIdType) == 8,
    static_cast<vtkIdType>(slots.GetStrips().size()), strips->GetNumberOfConnectivityIds());
  vtkNew<vtkIdList> ids;
  for (const vtkIdType cell : slots.GetStrips())
  {
    strips->GetCellAtId(cell - slots.GetFirstStrip(), ids);
    cells->InsertNextCell(ids);
  }
  return cells;
}

namespace
{

/// Lists, for every cell of the output, the cell of the mesh from which it was made.
void ListSources(const TriangleSlots& slots, vtkIdList* sources)
{
  const vtkIdType before = slots.GetFirstPolygon();
  const vtkIdType polygons = slots.GetNumberOfPolygons();
  const std::vector<vtkIdType>& strips = slots.GetStrips();
  sources->SetNumberOfIds(before + polygons + static_cast<vtkIdType>(strips.size()));
  std::iota(sources->begin(), sources->begin() + before, 0);
  for (vtkIdType polygon = 0; polygon < polygons; ++polygon)
  {
    sources->SetId(before + polygon, slots.GetCellOfPolygon(polygon));
  }
  std::copy(strips.begin(), strips.end(), sources->begin() + before + polygons);
}

void ReadOldTriangle(const TriangleArray& triangles, vtkIdType triangle, std::int64_t ids[3])
{
  for (int slot = 0; slot < 3; ++slot)
  {
    ids[slot] = triangles.Get(triangle, slot);
  }
}

/// A polygon of the output and its point ids.
struct OutputPolygon
{
  vtkIdType Polygon;
  vtkIdList* Ids;
};

/// Recomputes the normal of a triangle that flips have changed. If the old normal pointed against
/// the winding of the old triangle, so does the new one.
void RenewNormal(const PointArray& points, const TriangleSlots& slots, const OutputPolygon& cell,
  vtkDataArray* normals)
{
  const vtkIdType triangle = slots.GetTriangle(cell.Polygon);
  if (triangle == TriangleSlots::None)
  {
    return;
  }
  std::int64_t oldIds[3];
  ReadOldTriangle(slots.GetTriangles(), triangle, oldIds);
  const std::int64_t ids[3] = { cell.Ids->GetId(0), cell.Ids->GetId(1), cell.Ids->GetId(2) };
  const auto exists = [&](std::int64_t id) { return id >= 0 && id < points.Count; };
  const bool exist = std::all_of(oldIds, oldIds + 3, exists); // the input may have been changed
  if (!exist || std::equal(ids, ids + 3, oldIds))
  {
    return;
  }
  double oldNormal[3], normal[3];
  TriangleNormal(points, oldIds, oldNormal);
  normals->GetTuple(slots.GetFirstPolygon() + cell.Polygon, normal);
  const double side = vtkMath::Dot(oldNormal, normal) < 0.0 ? -1.0 : 1.0;
  TriangleNormal(points, ids, normal);
  vtkMath::MultiplyScalar(normal, side);
  normals->SetTuple(slots.GetFirstPolygon() + cell.Polygon, normal);
}

}

void DemoteGlobalIds(vtkCellData* data)
{
  vtkSmartPointer<vtkDataArray> ids = data->GetGlobalIds();
  if (!ids)
  {
    return;
  }
  data->SetActiveAttribute(-1, vtkDataSetAttributes::GLOBALIDS);
  if (!data->GetPedigreeIds())
  {
    data->SetPedigreeIds(ids);
  }
}

void PassCellData(vtkPolyData* mesh, const TriangleSlots& slots, vtkPolyData* output)
{
  vtkCellData* data = output->GetCellData();
  if (slots.AreInPlace())
  {
    data->ShallowCopy(mesh->GetCellData());
    return;
  }
  vtkNew<vtkIdList> sources;
  ListSources(slots, sources);
  vtkNew<vtkIdList> targets;
  targets->SetNumberOfIds(sources->GetNumberOfIds());
  std::iota(targets->begin(), targets->end(), 0);

  const vtkSmartPointer<vtkCellData> whole = TakeWholeArrays(mesh);
  data->CopyAllOn();
  data->CopyAllocate(whole, sources->GetNumberOfIds());
  data->CopyData(whole, sources, targets);
  if (slots.DivideCells())
  {
    DemoteGlobalIds(data);
  }
}

vtkSmartPointer<vtkDataArray> CopyNormals(vtkPolyData* output)
{
  vtkDataArray* shared = output->GetCellData()->GetNormals();
  if (!shared || shared->GetNumberOfComponents() != 3 ||
    shared->GetNumberOfTuples() < output->GetNumberOfCells())
  {
    return nullptr;
  }
  // Not its NewInstance, which cannot be written where values are computed.
  auto normals =
    vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(shared->GetDataType()));
  normals->DeepCopy(shared);
  return normals;
}

void RenewNormals(const PointArray& points, const TriangleSlots& slots, vtkPolyData* output)
{
  const vtkSmartPointer<vtkDataArray> normals = CopyNormals(output);
  if (!normals)
  {
    return;
  }
  vtkSMPTools::For(0, slots.GetNumberOfPolygons(),
    [&](vtkIdType begin, vtkIdType end)
    {
      vtkNew<vtkIdList> cell; // vtkSMPThreadLocalObject cannot be destroyed without memory
      for (vtkIdType polygon = begin; polygon < end; ++polygon)
      {
        output->GetPolys()->GetCellAtId(polygon, cell);
        RenewNormal(points, slots, { polygon, cell.Get() }, normals);
      }
    });
  output->GetCellData()->SetNormals(normals);
}

template <typename ArrayT>
void AddTriangleArray(
  const TriangleArrayValues<ArrayT>& source, const TriangleSlots& slots, vtkPolyData* output)
{
  vtkNew<ArrayT> array;
  array->SetName(source.Name);
  array->SetNumberOfTuples(output->GetNumberOfCells());
  array->FillValue(source.Elsewhere);
  for (vtkIdType polygon = 0; polygon < slots.GetNumberOfPolygons(); ++polygon)
  {
    const vtkIdType triangle = slots.GetTriangle(polygon);
    if (triangle != TriangleSlots::None)
    {
      array->SetValue(slots.GetFirstPolygon() + polygon, source.Values[triangle]);
    }
  }
  vtkCellData* data = output->GetCellData();
  data->AllocateArrays(data->GetNumberOfArrays() + 1); // as in ReportTables.cxx
  data->AddArray(array);
}

template void AddTriangleArray(
  const TriangleArrayValues<vtkIntArray>&, const TriangleSlots&, vtkPolyData*);
template void AddTriangleArray(
  const TriangleArrayValues<vtkDoubleArray>&, const TriangleSlots&, vtkPolyData*);

}
