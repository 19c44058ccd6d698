// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "TriangleSlots.h"

#include "DataArrays.h"
#include "FlipError.h"
#include "PolygonSplit.h"
#include "UpdateReport.h"

#include "vtkAOSDataArrayTemplate.h"
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

/// Views cells as triangles, if all of them are. VTK has ids of type VtkId, and the engine of Id.
template <typename VtkId, typename Id>
bool ViewTriangles(vtkCellArray* cells, TriangleArray& triangles)
{
  using ArrayT = vtkAOSDataArrayTemplate<VtkId>;
  auto* ids = vtkArrayDownCast<ArrayT>(cells->GetConnectivityArray());
  if (!ids || ids->GetNumberOfValues() != 3 * cells->GetNumberOfCells())
  {
    return false;
  }
  auto* offsets = vtkArrayDownCast<ArrayT>(cells->GetOffsetsArray()); // null: not in plain memory
  const bool areTriangles = offsets
    ? AreTriangleOffsets(offsets->GetPointer(0), offsets->GetNumberOfValues())
    : cells->IsValid() && cells->IsHomogeneous() == 3;
  if (!areTriangles)
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
  this->NoTriangles = Defect(DefectKind::PolygonsTooSmall);
  if (triangulate)
  {
    this->NoTriangles.Detail = ", left out";
  }
  WorkProgress split(progress,
    polygons->GetNumberOfConnectivityIds() + mesh->GetStrips()->GetNumberOfConnectivityIds());
  VisitCells(polygons, check(this->FirstPolygon),
    [&](vtkIdType polygon, vtkIdList* ids)
    {
      constexpr vtkIdType LargePolygon = 1000; // takes a while to split
      const vtkIdType size = ids->GetNumberOfIds();
      const bool stays = size < 3 || (size > 3 && !triangulate);
      const std::size_t before = this->Ids.size();
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
        ProgressObserver observer;
        if (size >= LargePolygon)
        {
          observer = split.ForNext(size);
        }
        if (!SplitPolygon(points, corners.data(), size, this->Ids, observer))
        {
          throw RunAborted();
        }
      }
      const auto made = static_cast<vtkIdType>(this->Ids.size() - before) / 3;
      this->AddTriangles(this->FirstPolygon + polygon, made, stays);
      if (size > 3 && made == 0)
      {
        this->CountNoTriangle(this->FirstPolygon + polygon);
      }
      split.Add(size);
    });
  VisitCells(mesh->GetStrips(), check(this->FirstStrip),
    [&](vtkIdType strip, vtkIdList* ids)
    {
      this->SplitStrip(this->FirstStrip + strip, ids, triangulate);
      split.Add(ids->GetNumberOfIds());
    });
  this->Triangles = TriangleArray(static_cast<const std::int64_t*>(this->Ids.data()),
    static_cast<std::int64_t>(this->Cells.size()));
}

/// Leaves out triangles that name a point twice, by which strips continue elsewhere.
void TriangleSlots::SplitStrip(vtkIdType cell, vtkIdList* ids, bool triangulate)
{
  const vtkIdType size = ids->GetNumberOfIds();
  const bool stays = size < 3 || !triangulate;
  if (stays)
  {
    this->Strips.push_back(cell);
  }
  vtkIdType made = 0;
  for (vtkIdType i = 0; i + 2 < size; ++i)
  {
    // Every other triangle of a strip is wound the other way.
    const vtkIdType odd = i % 2;
    const vtkIdType a = ids->GetId(i + odd), b = ids->GetId(i + 1 - odd), c = ids->GetId(i + 2);
    if (a != b && b != c && c != a)
    {
      this->Ids.insert(this->Ids.end(), { a, b, c });
      ++made;
    }
  }
  this->AddTriangles(cell, made, stays);
}

void TriangleSlots::CountNoTriangle(vtkIdType cell)
{
  constexpr std::size_t Most = 3; // named in the warning
  ++this->NoTriangles.Count;
  if (this->NoTriangles.FirstIds.size() < Most)
  {
    this->NoTriangles.FirstIds.push_back(cell);
  }
}

void TriangleSlots::AddTriangles(vtkIdType cell, vtkIdType count, bool stays)
{
  for (vtkIdType i = 0; i < count; ++i)
  {
    if (!stays)
    {
      this->Polygons.push_back({ cell, static_cast<vtkIdType>(this->Cells.size()) });
    }
    this->Cells.push_back(cell);
    this->Frozen.push_back(static_cast<unsigned char>(stays));
  }
  this->AreDivided = this->AreDivided || (count > 1 && !stays);
}

bool TriangleSlots::ArePolygonsTriangles() const
{
  return this->Polygons.size() == this->Cells.size() &&
    std::all_of(this->Polygons.begin(), this->Polygons.end(),
      [](const OutputPolygon& polygon) { return polygon.Triangle != None; });
}

}
