// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PieceRegion.h"

#include "FixedPairs.h"
#include "HostDevice.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace delaunayflip
{

PieceRegion::PieceRegion(const PieceMesh& mesh, const std::vector<std::int32_t>& points,
  const PieceSurvey& survey, RegionScratch& scratch)
  : Whole(survey.Whole),
    Points(survey.IsFloat)
{
  scratch.Triangles.Resize(mesh.Triangles.size());
  scratch.Inner.Resize(mesh.GetNumberOfPoints());
  this->Collect(mesh, points, scratch);
  this->CollectPoints(mesh, scratch);
  this->Describe(mesh, survey);
}

PieceRegion::PieceRegion(const PieceMesh& mesh, std::vector<std::int64_t> triangles,
  const PieceSurvey& survey, RegionScratch& scratch)
  : Whole(survey.Whole),
    Triangles(std::move(triangles)),
    Points(survey.IsFloat)
{
  this->CollectPoints(mesh, scratch);
  this->Describe(mesh, survey);
}

PieceRegion::PieceRegion(const PieceMesh& mesh, const PieceSurvey& survey)
  : Whole(survey.Whole),
    PointOf(mesh.GetNumberOfPoints()),
    Inner(mesh.GetNumberOfPoints(), 1),
    Points(survey.IsFloat)
{
  std::iota(this->PointOf.begin(), this->PointOf.end(), 0);
  this->Triangles.reserve(mesh.Triangles.size());
  this->Ids.reserve(3 * mesh.Triangles.size());
  for (std::size_t t = 0; t < mesh.Triangles.size(); ++t)
  {
    const PieceTriangle& triangle = mesh.Triangles[t];
    if (!triangle.HasLeft)
    {
      this->Triangles.push_back(static_cast<std::int64_t>(t));
      this->Ids.insert(this->Ids.end(), triangle.Points, triangle.Points + 3);
    }
  }
  this->Describe(mesh, survey);
}

void PieceRegion::Describe(const PieceMesh& mesh, const PieceSurvey& survey)
{
  this->ListFixedEdges(mesh);
  this->Points.Reserve(static_cast<std::int64_t>(this->PointOf.size()));
  for (std::size_t i = 0; i < this->PointOf.size(); ++i)
  {
    double x[3];
    mesh.GetPosition(this->PointOf[i], x);
    this->Points.Add(x);
    if (survey.NeedsGuard())
    {
      // Edges at it may be on other ranks, or outside the region.
      constexpr int Elsewhere = 1, Outside = 2;
      this->Shared.push_back(static_cast<unsigned char>(
        (mesh.IsShared(this->PointOf[i]) ? Elsewhere : 0) | (this->Inner[i] ? 0 : Outside)));
    }
  }
}

/// Finds the triangles, and the points all of whose triangles they are.
void PieceRegion::Collect(
  const PieceMesh& mesh, const std::vector<std::int32_t>& points, RegionScratch& scratch)
{
  const auto addPoints = [&](std::int64_t t)
  {
    for (const std::int32_t point : mesh.Triangles[t].Points)
    {
      scratch.Inner.Add(point);
    }
  };
  mesh.ForEachAt(points, addPoints);
  mesh.ForEachAt(
    scratch.Inner.List<std::int32_t>(), [&](std::int64_t t) { scratch.Triangles.Add(t); });
  this->Triangles = scratch.Triangles.List<std::int64_t>();
  scratch.Triangles.Clear();
}

/// Finds and numbers the points of the triangles.
void PieceRegion::CollectPoints(const PieceMesh& mesh, RegionScratch& scratch)
{
  constexpr std::size_t PrefetchDistance = 16;
  scratch.Points.Resize(mesh.GetNumberOfPoints());
  scratch.Inner.Resize(mesh.GetNumberOfPoints());
  scratch.Numbers.resize(mesh.GetNumberOfPoints());
  this->Ids.reserve(3 * this->Triangles.size());
  for (std::size_t i = 0; i < this->Triangles.size(); ++i)
  {
    const std::size_t later = std::min(i + PrefetchDistance, this->Triangles.size() - 1);
    Prefetch(&mesh.Triangles[this->Triangles[later]]);
    for (const std::int32_t point : mesh.Triangles[this->Triangles[i]].Points)
    {
      scratch.Points.Add(point);
      this->Ids.push_back(point);
    }
  }
  this->PointOf = scratch.Points.List<std::int32_t>();
  scratch.Points.Clear();
  this->Inner.reserve(this->PointOf.size());
  for (std::size_t i = 0; i < this->PointOf.size(); ++i)
  {
    scratch.Numbers[this->PointOf[i]] = static_cast<std::int32_t>(i);
    this->Inner.push_back(scratch.Inner.Has(this->PointOf[i]) ? 1 : 0);
  }
  scratch.Inner.Clear();
  for (std::int32_t& id : this->Ids)
  {
    id = scratch.Numbers[id];
  }
}

void PieceRegion::ListFixedEdges(const PieceMesh& mesh)
{
  for (std::size_t i = 0; i < this->Triangles.size(); ++i)
  {
    for (int slot = 0; slot < 3; ++slot)
    {
      if (mesh.Triangles[this->Triangles[i]].Has(FixedMark, slot))
      {
        this->FixedEdges.push_back(this->Ids[3 * i + (slot + 1) % 3]);
        this->FixedEdges.push_back(this->Ids[3 * i + (slot + 2) % 3]);
      }
    }
  }
}

std::int64_t PieceRegion::FindPoint(std::int64_t point) const
{
  const auto found = std::lower_bound(this->PointOf.begin(), this->PointOf.end(), point);
  return found != this->PointOf.end() && *found == point ? found - this->PointOf.begin() : -1;
}

TriangleMesh PieceRegion::View() const
{
  TriangleMesh mesh;
  mesh.Points = this->Points.View();
  mesh.Triangles = TriangleArray(this->Ids.data(), this->GetNumberOfTriangles());
  mesh.ConstraintEdges = this->FixedEdges.data();
  mesh.NumberOfConstraintEdges = static_cast<std::int64_t>(this->FixedEdges.size()) / 2;
  mesh.Whole = this->Whole;
  mesh.Whole.SharedPoints = this->Shared.empty() ? nullptr : this->Shared.data();
  return mesh;
}

void PieceRegion::Store(const std::vector<std::int32_t>& ids,
  const std::vector<std::int32_t>& flips, PieceMesh& mesh) const
{
  std::vector<std::int64_t> changed;
  std::vector<std::size_t> places;
  MarkedEdges marks; // by the region's numbers
  for (std::size_t i = 0; i < this->Triangles.size(); ++i)
  {
    if (flips[i] == 0)
    {
      continue;
    }
    changed.push_back(this->Triangles[i]);
    places.push_back(i);
    for (int slot = 0; slot < 3; ++slot)
    {
      const unsigned char mark = mesh.Triangles[changed.back()].GetMarks(slot);
      if (mark != 0)
      {
        marks.Add(
          MakePair(this->Ids[3 * i + (slot + 1) % 3], this->Ids[3 * i + (slot + 2) % 3]), mark);
      }
    }
  }
  const auto change = [&](std::size_t i)
  {
    PieceTriangle& triangle = mesh.Triangles[this->Triangles[i]];
    triangle.Flips += flips[i];
    for (int slot = 0; slot < 3; ++slot)
    {
      triangle.Points[slot] = this->PointOf[ids[3 * i + slot]];
      triangle.SetMarks(slot, marks.Get(ids[3 * i + (slot + 1) % 3], ids[3 * i + (slot + 2) % 3]));
    }
  };
  mesh.ChangeTriangles(changed, [&]() { std::for_each(places.begin(), places.end(), change); });
}

std::vector<std::int32_t> PieceRegion::FindNext(
  const std::vector<std::int32_t>& ids, const std::vector<std::int32_t>& flips) const
{
  std::vector<std::int32_t> next;
  for (std::size_t i = 0; i < ids.size(); ++i)
  {
    if (flips[i / 3] > 0 && this->Inner[ids[i]] == 0)
    {
      next.push_back(this->PointOf[ids[i]]);
    }
  }
  return next;
}

}
