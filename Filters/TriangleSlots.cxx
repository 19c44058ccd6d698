// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "TriangleSlots.h"

#include "DataArrays.h"
#include "PolygonSplit.h"
#include "UpdateProgress.h"

#include "vtkAOSDataArrayTemplate.h"
#include "vtkPolyData.h"
#include "vtkSMPTools.h"

#include <algorithm>
#include <atomic>

namespace delaunayflip
{
namespace
{

/// Whether offsets are 0, 3, 6, ...; checked by all threads.
template <typename Id>
bool AreTriangleOffsets(const Id* offsets, vtkIdType count)
{
  std::atomic<bool> are{ true };
  vtkSMPTools::For(0, count,
    [&are, offsets](vtkIdType begin, vtkIdType end)
    {
      bool areTriangles = true;
      for (vtkIdType i = begin; i < end; ++i)
      {
        areTriangles = areTriangles && offsets[i] == 3 * i;
      }
      if (!areTriangles)
      {
        are = false;
      }
    });
  return are;
}

/// Views cells whose ids are of type VtkId, for the engine of type Id, if all are triangles.
template <typename VtkId, typename Id>
bool ViewTriangles(vtkCellArray* cells, TriangleArray& triangles)
{
  using ArrayT = vtkAOSDataArrayTemplate<VtkId>;
  auto* ids = vtkArrayDownCast<ArrayT>(cells->GetConnectivityArray());
  auto* offsets = vtkArrayDownCast<ArrayT>(cells->GetOffsetsArray());
  if (!ids || ids->GetNumberOfValues() != 3 * cells->GetNumberOfCells() ||
    !(offsets ? AreTriangleOffsets(offsets->GetPointer(0), offsets->GetNumberOfValues())
              : cells->IsValid() && cells->IsHomogeneous() == 3))
  {
    return false;
  }
  // vtkTypeInt64 (long long) and std::int64_t (long) are distinct types of the same representation.
  triangles =
    TriangleArray(reinterpret_cast<const Id*>(ids->GetPointer(0)), cells->GetNumberOfCells());
  return true;
}

}

TriangleSlots::TriangleSlots(
  vtkPolyData* mesh, const PointArray& points, bool triangulate, const ProgressObserver& progress)
  : FirstPolygon(mesh->GetNumberOfVerts() + mesh->GetNumberOfLines()),
    FirstStrip(FirstPolygon + mesh->GetNumberOfPolys())
{
  const auto check = [&](vtkIdType first) { return PointIdCheck{ "cell", first, points.Count }; };
  check(0).RequireValid(mesh->GetVerts());
  check(mesh->GetNumberOfVerts()).RequireValid(mesh->GetLines());
  check(this->FirstStrip).RequireValid(mesh->GetStrips());
  vtkCellArray* polygons = mesh->GetPolys();
  this->InPlace = mesh->GetNumberOfStrips() == 0 &&
    (ViewTriangles<vtkTypeInt32, std::int32_t>(polygons, this->Triangles) ||
      ViewTriangles<vtkTypeInt64, std::int64_t>(polygons, this->Triangles));
  if (this->InPlace)
  {
    return;
  }
  WorkProgress split(progress,
    polygons->GetNumberOfConnectivityIds() + mesh->GetStrips()->GetNumberOfConnectivityIds());
  VisitCells(polygons, check(this->FirstPolygon),
    [&](vtkIdType polygon, vtkIdList* ids)
    {
      constexpr vtkIdType LargePolygon = 1000; // takes a while to split
      const vtkIdType size = ids->GetNumberOfIds();
      const bool stays = size < 3 || (size > 3 && !triangulate);
      if (stays)
      {
        this->Polygons.push_back({ this->FirstPolygon + polygon, None });
      }
      if (size == 3)
      {
        this->Ids.insert(this->Ids.end(), ids->begin(), ids->end());
      }
      else if (size > 3)
      {
        const std::vector<std::int64_t> corners(ids->begin(), ids->end());
        const ProgressObserver observer =
          size < LargePolygon ? ProgressObserver() : split.ForNext(size);
        if (!SplitPolygon(points, corners.data(), size, this->Ids, observer))
        {
          throw RunAborted();
        }
      }
      this->AddTriangles(this->FirstPolygon + polygon, size - 2, stays);
      split.Add(size);
    });
  VisitCells(mesh->GetStrips(), check(this->FirstStrip),
    [&](vtkIdType strip, vtkIdList* ids)
    {
      const vtkIdType size = ids->GetNumberOfIds();
      const bool stays = size < 3 || !triangulate;
      if (stays)
      {
        this->Strips.push_back(this->FirstStrip + strip);
      }
      for (vtkIdType i = 0; i + 2 < size; ++i)
      {
        // Every other triangle of a strip is wound the other way.
        const vtkIdType odd = i % 2;
        this->Ids.insert(
          this->Ids.end(), { ids->GetId(i + odd), ids->GetId(i + 1 - odd), ids->GetId(i + 2) });
      }
      this->AddTriangles(this->FirstStrip + strip, size - 2, stays);
      split.Add(size);
    });
  this->Triangles = TriangleArray(static_cast<const std::int64_t*>(this->Ids.data()),
    static_cast<std::int64_t>(this->Cells.size()));
}

/// @param count may be negative: none.
void TriangleSlots::AddTriangles(vtkIdType cell, vtkIdType count, bool stays)
{
  for (vtkIdType i = 0; i < count; ++i)
  {
    if (!stays)
    {
      this->Polygons.push_back({ cell, static_cast<vtkIdType>(this->Cells.size()) });
    }
    this->Cells.push_back(cell);
    this->Frozen.push_back(stays ? 1 : 0);
  }
  this->AreDivided = this->AreDivided || (count > 1 && !stays);
}

bool TriangleSlots::ArePolygonsTriangles() const
{
  return this->InPlace ||
    (this->Polygons.size() == this->Cells.size() &&
      std::all_of(this->Polygons.begin(), this->Polygons.end(),
        [](const OutputPolygon& polygon) { return polygon.Triangle != None; }));
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

}
