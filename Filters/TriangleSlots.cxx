// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "TriangleSlots.h"

#include "PointViews.h"
#include "PolygonSplit.h"
#include "UpdateProgress.h"

#include "vtkAOSDataArrayTemplate.h"
#include "vtkCellArray.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkSMPTools.h"

#include <algorithm>
#include <atomic>

namespace delaunayflip
{
namespace
{

/// Whether offsets are 0, 3, 6, ...; checked by all threads.
template <typename ArrayT>
bool AreTriangleOffsets(ArrayT* offsets)
{
  const auto* values = offsets->GetPointer(0);
  std::atomic<bool> are{ true };
  vtkSMPTools::For(0, offsets->GetNumberOfValues(),
    [values, &are](vtkIdType begin, vtkIdType end)
    {
      bool areTriangles = true;
      for (vtkIdType i = begin; i < end; ++i)
      {
        areTriangles = areTriangles && values[i] == 3 * i;
      }
      if (!areTriangles)
      {
        are = false;
      }
    });
  return are;
}

bool HoldsTriangles(vtkCellArray* cells)
{
  vtkDataArray* offsets = cells->GetOffsetsArray();
  if (cells->GetConnectivityArray()->GetNumberOfValues() != 3 * cells->GetNumberOfCells())
  {
    return false;
  }
  if (auto* offsets32 = vtkArrayDownCast<vtkAOSDataArrayTemplate<vtkTypeInt32>>(offsets))
  {
    return AreTriangleOffsets(offsets32);
  }
  if (auto* offsets64 = vtkArrayDownCast<vtkAOSDataArrayTemplate<vtkTypeInt64>>(offsets))
  {
    return AreTriangleOffsets(offsets64);
  }
  return cells->IsValid() && cells->IsHomogeneous() == 3;
}

}

TriangleSlots::TriangleSlots(
  vtkPolyData* mesh, const PointArray& points, bool triangulate, const ProgressObserver& progress)
  : Triangulate(triangulate),
    FirstPolygon(mesh->GetNumberOfVerts() + mesh->GetNumberOfLines()),
    FirstStrip(FirstPolygon + mesh->GetNumberOfPolys())
{
  PointIdCheck{ "cell", 0, points.Count }.RequireValid(mesh->GetVerts());
  PointIdCheck{ "cell", mesh->GetNumberOfVerts(), points.Count }.RequireValid(mesh->GetLines());
  PointIdCheck{ "cell", this->FirstStrip, points.Count }.RequireValid(mesh->GetStrips());
  this->InPlace = mesh->GetNumberOfStrips() == 0 && this->ViewPolygons(mesh->GetPolys());
  if (this->InPlace)
  {
    return;
  }
  PointIdCheck{ "cell", this->FirstPolygon, points.Count }.RequireValid(mesh->GetPolys());
  WorkProgress split(progress,
    mesh->GetPolys()->GetNumberOfConnectivityIds() +
      mesh->GetStrips()->GetNumberOfConnectivityIds());
  this->ReadPolygons(mesh->GetPolys(), points, split);
  this->ReadStrips(mesh->GetStrips(), points, split);
  this->Triangles = TriangleArray(static_cast<const std::int64_t*>(this->Ids.data()),
    static_cast<std::int64_t>(this->Cells.size()));
}

bool TriangleSlots::ArePolygonsTriangles() const
{
  return this->InPlace ||
    (this->Polygons.size() == this->Cells.size() &&
      std::all_of(this->Polygons.begin(), this->Polygons.end(),
        [](const OutputPolygon& polygon) { return polygon.Triangle != None; }));
}

bool TriangleSlots::ViewPolygons(vtkCellArray* polygons)
{
  using Array32 = vtkAOSDataArrayTemplate<vtkTypeInt32>;
  using Array64 = vtkAOSDataArrayTemplate<vtkTypeInt64>;
  if (!HoldsTriangles(polygons))
  {
    return false;
  }
  const vtkIdType count = polygons->GetNumberOfCells();
  vtkDataArray* connectivity = polygons->GetConnectivityArray();
  if (auto* ids32 = vtkArrayDownCast<Array32>(connectivity))
  {
    this->Triangles = TriangleArray(static_cast<const std::int32_t*>(ids32->GetPointer(0)), count);
    return true;
  }
  if (auto* ids64 = vtkArrayDownCast<Array64>(connectivity))
  {
    // vtkTypeInt64 (long long) and std::int64_t (long) are distinct types of the same
    // representation.
    this->Triangles =
      TriangleArray(reinterpret_cast<const std::int64_t*>(ids64->GetPointer(0)), count);
    return true;
  }
  return false;
}

void TriangleSlots::RequireValidIds(vtkIdType numberOfPoints) const
{
  const PointIdCheck check{ "cell", this->FirstPolygon, numberOfPoints };
  for (vtkIdType triangle = 0; triangle < this->Triangles.Count; ++triangle)
  {
    for (int slot = 0; slot < 3; ++slot)
    {
      check.RequireInRange(triangle, this->Triangles.Get(triangle, slot));
    }
  }
}

void TriangleSlots::ReadPolygons(
  vtkCellArray* polygons, const PointArray& points, WorkProgress& progress)
{
  const PointIdCheck check{ "cell", this->FirstPolygon, points.Count };
  vtkNew<vtkIdList> ids;
  for (vtkIdType polygon = 0; polygon < polygons->GetNumberOfCells(); ++polygon)
  {
    polygons->GetCellAtId(polygon, ids);
    check.RequireInRange(polygon, ids);
    this->ReadPolygon(this->FirstPolygon + polygon, ids, points, progress);
    progress.Add(ids->GetNumberOfIds());
  }
}

void TriangleSlots::ReadPolygon(
  vtkIdType cell, vtkIdList* ids, const PointArray& points, WorkProgress& progress)
{
  const vtkIdType size = ids->GetNumberOfIds();
  const ProgressObserver& observer = progress.BeginGroup(size);
  const bool stays = size < 3 || (size > 3 && !this->Triangulate);
  if (stays)
  {
    this->Polygons.push_back({ cell, None });
  }
  if (size == 3)
  {
    this->Ids.insert(this->Ids.end(), ids->begin(), ids->end());
    this->AddTriangles(cell, 1, false);
  }
  else if (size > 3)
  {
    const std::vector<std::int64_t> corners(ids->begin(), ids->end());
    if (!SplitPolygon(points, corners.data(), size, this->Ids, observer))
    {
      throw RunAborted();
    }
    this->AddTriangles(cell, size - 2, stays);
  }
}

void TriangleSlots::ReadStrips(
  vtkCellArray* strips, const PointArray& points, WorkProgress& progress)
{
  const PointIdCheck check{ "cell", this->FirstStrip, points.Count };
  vtkNew<vtkIdList> ids;
  for (vtkIdType strip = 0; strip < strips->GetNumberOfCells(); ++strip)
  {
    strips->GetCellAtId(strip, ids);
    check.RequireInRange(strip, ids);
    const vtkIdType size = ids->GetNumberOfIds();
    const bool stays = size < 3 || !this->Triangulate;
    if (stays)
    {
      this->Strips.push_back(this->FirstStrip + strip);
    }
    if (size >= 3)
    {
      this->AddStripTriangles(ids);
      this->AddTriangles(this->FirstStrip + strip, size - 2, stays);
    }
    progress.Add(size);
  }
}

void TriangleSlots::AddStripTriangles(vtkIdList* ids)
{
  for (vtkIdType i = 0; i + 2 < ids->GetNumberOfIds(); ++i)
  {
    // Every other triangle of a strip is wound the other way.
    const vtkIdType odd = i % 2;
    this->Ids.insert(
      this->Ids.end(), { ids->GetId(i + odd), ids->GetId(i + 1 - odd), ids->GetId(i + 2) });
  }
}

void TriangleSlots::AddTriangles(vtkIdType cell, vtkIdType count, bool stays)
{
  for (vtkIdType i = 0; i < count && !stays; ++i)
  {
    this->Polygons.push_back({ cell, static_cast<vtkIdType>(this->Cells.size()) + i });
  }
  this->Cells.insert(this->Cells.end(), count, cell);
  this->Frozen.insert(this->Frozen.end(), count, stays ? 1 : 0);
  this->CellsAreDivided = this->CellsAreDivided || (count > 1 && !stays);
}

}
