// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CellAttributes.h"

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

#include <algorithm>
#include <numeric>

namespace delaunayflip
{
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
