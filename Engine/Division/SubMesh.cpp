// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SubMesh.h"

#include "InputChecks.h"

#include <algorithm>
#include <utility>

namespace delaunayflip
{

SubMesh::SubMesh(const TriangleMesh& mesh, Array<std::int64_t> slots, const ThreadBackend& backend)
  : Whole(mesh),
    Engine(backend),
    PointIds(mesh.Points.Count, backend),
    Slots(std::move(slots))
{
  const TriangleArray& triangles = mesh.Triangles;
  const std::int64_t count = this->GetNumberOfTriangles();
  this->Engine.ForEach(count,
    [&](std::int64_t i)
    {
      for (int slot = 0; slot < 3; ++slot)
      {
        this->PointIds.Add(triangles.Get(this->Slots[i], slot));
      }
    });
  this->PointIds.Number(this->Engine);
  CheckMeshSize(count, this->PointIds.GetSize());
  this->Ids = this->Engine.MakeArray<std::int32_t>(3 * count);
  this->Engine.ForEach(count,
    [&](std::int64_t i)
    {
      for (int slot = 0; slot < 3; ++slot)
      {
        this->Ids[3 * i + slot] = this->PointIds.GetNumber(triangles.Get(this->Slots[i], slot));
      }
    });
  this->CopyPoints();
  this->CopyLabels();
}

void SubMesh::CopyPoints()
{
  const PointArray& points = this->Whole.Points;
  const std::int64_t count = this->PointIds.GetSize();
  this->PointOf = this->Engine.MakeArray<std::int64_t>(count);
  this->Floats = this->Engine.MakeArray<float>(points.Floats ? 3 * count : 0);
  this->Doubles = this->Engine.MakeArray<double>(points.Floats ? 0 : 3 * count);
  this->PointIds.ForEach(this->Engine,
    [&](std::int64_t point, std::int64_t number)
    {
      this->PointOf[number] = point;
      if (points.Floats)
      {
        std::copy_n(points.Floats + 3 * point, 3, this->Floats.Data() + 3 * number);
      }
      else
      {
        std::copy_n(points.Doubles + 3 * point, 3, this->Doubles.Data() + 3 * number);
      }
    });
}

void SubMesh::CopyLabels()
{
  const std::int64_t count = this->GetNumberOfTriangles();
  if (this->Whole.Regions)
  {
    this->Regions = this->Engine.MakeArray<std::int32_t>(count);
    this->Engine.ForEach(
      count, [&](std::int64_t i) { this->Regions[i] = this->Whole.Regions[this->Slots[i]]; });
  }
  if (this->Whole.FrozenTriangles)
  {
    this->Frozen = this->Engine.MakeArray<unsigned char>(count);
    this->Engine.ForEach(count,
      [&](std::int64_t i) { this->Frozen[i] = this->Whole.FrozenTriangles[this->Slots[i]]; });
  }
}

void SubMesh::FixEdges(const std::vector<std::int64_t>& ends)
{
  for (std::size_t i = 0; i < ends.size(); i += 2)
  {
    const std::int64_t a = ends[i];
    const std::int64_t b = ends[i + 1];
    if (this->PointIds.Has(a) && this->PointIds.Has(b))
    {
      this->Edges.push_back(this->PointIds.GetNumber(a));
      this->Edges.push_back(this->PointIds.GetNumber(b));
    }
  }
}

TriangleMesh SubMesh::ViewWithoutLabels() const
{
  const auto points = static_cast<std::int64_t>(this->PointOf.Size());
  TriangleMesh mesh;
  mesh.Points = this->Whole.Points.Floats ? PointArray(this->Floats.Data(), points)
                                          : PointArray(this->Doubles.Data(), points);
  mesh.Triangles = TriangleArray(this->Ids.Data(), this->GetNumberOfTriangles());
  mesh.ConstraintEdges = this->Edges.data();
  mesh.NumberOfConstraintEdges = static_cast<std::int64_t>(this->Edges.size()) / 2;
  mesh.Whole = this->Whole.Whole;
  mesh.Whole.SharedPoints = this->Shared.Size() > 0 ? this->Shared.Data() : nullptr;
  return mesh;
}

TriangleMesh SubMesh::View() const
{
  TriangleMesh mesh = this->ViewWithoutLabels();
  mesh.Regions = this->Whole.Regions ? this->Regions.Data() : nullptr;
  mesh.FrozenTriangles = this->Whole.FrozenTriangles ? this->Frozen.Data() : nullptr;
  return mesh;
}

void SubMesh::Store(const MutableTriangleArray& triangles) const
{
  this->Engine.ForEach(this->GetNumberOfTriangles(),
    [&](std::int64_t i)
    {
      for (int slot = 0; slot < 3; ++slot)
      {
        triangles.Set(this->Slots[i], slot, this->GetPoint(i, slot));
      }
    });
}

}
