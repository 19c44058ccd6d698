// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "OutputCells.h"

#include "DataArrays.h"
#include "PolygonSplit.h"

#include "vtkFieldData.h"
#include "vtkMath.h"
#include "vtkSMPTools.h"

#include <algorithm>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace delaunayflip
{
namespace
{

/// Asks for pages of 2 MiB instead of 4 KiB in new memory, because each page is allocated and
/// cleared on first use. Measured in an earlier version: for the connectivity alone, this took an
/// update of 5 M points on a GPU from 63 to 56 ms.
void UseHugePages([[maybe_unused]] vtkDataArray* values)
{
#if defined(__linux__)
  constexpr std::uintptr_t HugePage = std::uintptr_t(2) << 20;
  const auto begin = reinterpret_cast<std::uintptr_t>(values->GetVoidPointer(0));
  const std::uintptr_t first = (begin + HugePage - 1) / HugePage * HugePage;
  const std::uintptr_t end = begin + values->GetNumberOfValues() * values->GetDataTypeSize();
  if (first + HugePage <= end)
  {
    madvise(reinterpret_cast<void*>(first), (end - first) / HugePage * HugePage, MADV_HUGEPAGE);
  }
#endif
}

}

vtkSmartPointer<vtkCellArray> MakeRoomForTriangles(vtkIdType count, bool areWide)
{
  // Offsets are not shared with the input. Its cells may grow in place later, and the output would
  // then have more offsets than connectivity.
  auto room = vtkSmartPointer<vtkCellArray>::New();
  // There may be more connectivity than 32-bit offsets can number.
  const bool needsWide = areWide || 3 * count > std::numeric_limits<std::int32_t>::max();
  SetWidth(room, needsWide);
  room->ResizeExact(count, 3 * count);
  UseHugePages(room->GetOffsetsArray());
  UseHugePages(room->GetConnectivityArray());
  return room;
}

std::vector<ResultMemory> ListMemory(vtkCellArray* room)
{
  std::vector<ResultMemory> memory;
  if (room)
  {
    for (vtkDataArray* array : { room->GetOffsetsArray(), room->GetConnectivityArray() })
    {
      const vtkIdType bytes = array->GetNumberOfValues() * array->GetDataTypeSize();
      memory.push_back({ array->GetVoidPointer(0), bytes });
    }
  }
  return memory;
}

void FillTriangles(const FlipSession& session, vtkCellArray* room, bool areOrdered)
{
  const vtkIdType count = room->GetNumberOfCells();
  const auto fill = [&](auto* offsets, auto* ids)
  {
    vtkSMPTools::For(0, count + 1,
      [offsets](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType i = begin; i < end; ++i)
        {
          offsets[i] = static_cast<std::decay_t<decltype(*offsets)>>(3 * i);
        }
      });
    const MutableTriangleArray triangles(ids, count);
    if (areOrdered)
    {
      session.StoreOrderedTriangles(triangles);
    }
    else
    {
      session.StoreTriangles(triangles);
    }
  };
  void* offsets = room->GetOffsetsArray()->GetVoidPointer(0);
  void* ids = room->GetConnectivityArray()->GetVoidPointer(0);
  if (room->IsStorage64Bit())
  {
    fill(static_cast<std::int64_t*>(offsets), static_cast<std::int64_t*>(ids));
  }
  else
  {
    fill(static_cast<std::int32_t*>(offsets), static_cast<std::int32_t*>(ids));
  }
}

bool UsesWideIds(vtkPolyData* mesh)
{
  vtkCellArray* cells = mesh->GetNumberOfPolys() > 0 ? mesh->GetPolys() : mesh->GetStrips();
  return cells->GetConnectivityArray()->GetDataTypeSize() == 8;
}

vtkSmartPointer<vtkCellArray> BuildPolygons(
  const std::vector<OutputPolygon>& polygons, const TriangleArray& triangles, vtkPolyData* mesh)
{
  const vtkIdType first = mesh->GetNumberOfVerts() + mesh->GetNumberOfLines();
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  SetWidth(cells, UsesWideIds(mesh));
  cells->AllocateEstimate(static_cast<vtkIdType>(polygons.size()), 3);
  vtkNew<vtkIdList> ids;
  for (const OutputPolygon& polygon : polygons)
  {
    if (polygon.Triangle == TriangleSlots::None)
    {
      mesh->GetPolys()->GetCellAtId(polygon.Cell - first, ids);
      cells->InsertNextCell(ids);
    }
    else
    {
      cells->InsertNextCell({ triangles.Get(polygon.Triangle, 0),
        triangles.Get(polygon.Triangle, 1), triangles.Get(polygon.Triangle, 2) });
    }
  }
  return cells;
}

void StoreCells(vtkPolyData* mesh, const TriangleSlots& slots,
  const std::vector<OutputPolygon>& polygons, vtkDataSetAttributes* received, vtkPolyData* output)
{
  output->SetVerts(mesh->GetVerts());
  output->SetLines(mesh->GetLines());
  output->SetStrips(mesh->GetStrips());
  output->GetFieldData()->ShallowCopy(mesh->GetFieldData());
  vtkCellData* data = output->GetCellData();
  const bool areAsBefore = slots.InPlace && !received && polygons.empty();
  if (areAsBefore)
  {
    data->ShallowCopy(mesh->GetCellData());
    return;
  }
  if (static_cast<vtkIdType>(slots.Strips.size()) < mesh->GetNumberOfStrips())
  {
    vtkNew<vtkCellArray> strips;
    vtkNew<vtkIdList> ids;
    for (const vtkIdType cell : slots.Strips)
    {
      mesh->GetStrips()->GetCellAtId(cell - slots.FirstStrip, ids);
      strips->InsertNextCell(ids);
    }
    output->SetStrips(strips);
  }
  const auto sources = MakeRange(0, slots.FirstPolygon);
  for (const OutputPolygon& polygon : polygons)
  {
    if (polygon.Cell != TriangleSlots::None)
    {
      sources->InsertNextId(polygon.Cell);
    }
  }
  const vtkIdType first = sources->GetNumberOfIds(); // the cells received are before the strips
  const vtkIdType count = slots.FirstPolygon + static_cast<vtkIdType>(polygons.size()) - first;
  const auto places = MakeRange(0, first);
  for (const vtkIdType strip : slots.Strips)
  {
    places->InsertNextId(sources->InsertNextId(strip) + count);
  }
  const vtkIdType size = sources->GetNumberOfIds() + count;
  data->Initialize();
  AddTuples(
    TakeWholeArrays(mesh->GetCellData(), mesh->GetNumberOfCells()), sources, places, size, data);
  if (received)
  {
    AddTuples(received, MakeRange(0, count), MakeRange(first, count), size, data);
  }
}

void RenewNormals(vtkPolyData* output, const FindChange& findChange)
{
  vtkDataArray* shared = output->GetCellData()->GetNormals();
  if (shared->GetNumberOfComponents() != 3 ||
    shared->GetNumberOfTuples() < output->GetNumberOfCells())
  {
    return;
  }
  // NewInstance would make an array that cannot be written if this one computes its values.
  const auto normals =
    vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(shared->GetDataType()));
  normals->DeepCopy(shared);
  normals->SetName(shared->GetName()); // an array of bits does not copy it
  std::vector<double> storage;
  const PointArray points = ViewPoints(output, storage);
  const vtkIdType first = output->GetNumberOfVerts() + output->GetNumberOfLines();
  vtkSMPTools::For(0, output->GetNumberOfPolys(),
    [&](vtkIdType begin, vtkIdType end)
    {
      vtkNew<vtkIdList> cell;
      for (vtkIdType polygon = begin; polygon < end; ++polygon)
      {
        output->GetPolys()->GetCellAtId(polygon, cell);
        std::int64_t ids[3] = { -1, -1, -1 };
        std::copy_n(cell->begin(), std::min<vtkIdType>(cell->GetNumberOfIds(), 3), ids);
        std::int64_t before[3] = { ids[0], ids[1], ids[2] };
        const auto exists = [&](std::int64_t id) { return id >= 0 && id < points.Count; };
        // The ids of the input may have been changed.
        if (std::all_of(ids, ids + 3, exists) && findChange(polygon, ids, before) &&
          std::all_of(before, before + 3, exists))
        {
          double normal[3], winding[3];
          TriangleNormal(points, before, winding);
          normals->GetTuple(first + polygon, normal);
          const bool wasReversed = vtkMath::Dot(winding, normal) < 0.0;
          TriangleNormal(points, ids, normal);
          if (wasReversed)
          {
            vtkMath::MultiplyScalar(normal, -1.0);
          }
          normals->SetTuple(first + polygon, normal);
        }
      }
    });
  vtkCellData* data = output->GetCellData();
  const int attributes = FindAttributes(data, shared);
  AddAttributes(data, data->SetNormals(normals), attributes);
}

}
