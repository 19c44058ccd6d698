// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PieceRegion.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace delaunayflip
{

namespace
{
/// Collects different things of a rank, each once.
template <typename Id, typename Flag>
class UniqueList
{
public:
  /// @param flags all 0 now, and again in the end.
  explicit UniqueList(std::vector<Flag>& flags)
    : Flags(flags)
  {
  }

  void Add(Id id)
  {
    if (this->Flags[id] == 0)
    {
      this->Flags[id] = 1;
      this->Ids.push_back(id);
    }
  }

  /// Ends the list. @returns it, ascending.
  std::vector<Id> Take()
  {
    std::sort(this->Ids.begin(), this->Ids.end());
    for (const Id id : this->Ids)
    {
      this->Flags[id] = 0;
    }
    return std::move(this->Ids);
  }

private:
  std::vector<Flag>& Flags;
  std::vector<Id> Ids;
};

std::vector<std::int32_t> FindPointsOf(
  const PieceMesh& mesh, const std::vector<std::int64_t>& triangles, RegionScratch& scratch)
{
  UniqueList<std::int32_t, std::int32_t> points(scratch.Points);
  for (const std::int64_t t : triangles)
  {
    for (const std::int32_t point : mesh.Triangles[t].Points)
    {
      points.Add(point);
    }
  }
  return points.Take();
}

std::vector<std::int64_t> FindTrianglesAt(
  const PieceMesh& mesh, const std::vector<std::int32_t>& points, RegionScratch& scratch)
{
  UniqueList<std::int64_t, unsigned char> triangles(scratch.Triangles);
  for (const std::int32_t point : points)
  {
    mesh.ForEachAt(point, [&](std::int64_t t) { triangles.Add(t); });
  }
  return triangles.Take();
}
}

PieceRegion::PieceRegion(const PieceMesh& mesh, const std::vector<std::int32_t>& points,
  const PieceSurvey& survey, RegionScratch& scratch)
  : Whole(survey.Whole),
    Points(survey.IsFloat)
{
  scratch.Points.resize(mesh.GetNumberOfPoints());
  scratch.Triangles.resize(mesh.Triangles.size());
  this->Collect(mesh, points, scratch);
  this->NumberPoints(mesh, scratch);
  this->Describe(mesh, survey);
}

PieceRegion::PieceRegion(const PieceMesh& mesh, std::vector<std::int64_t> triangles,
  const PieceSurvey& survey, RegionScratch& scratch)
  : Whole(survey.Whole),
    Triangles(std::move(triangles)),
    Points(survey.IsFloat)
{
  scratch.Points.resize(mesh.GetNumberOfPoints());
  this->PointOf = FindPointsOf(mesh, this->Triangles, scratch);
  this->Inner.resize(this->PointOf.size());
  this->NumberPoints(mesh, scratch);
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

void PieceRegion::Collect(
  const PieceMesh& mesh, const std::vector<std::int32_t>& points, RegionScratch& scratch)
{
  const std::vector<std::int32_t> inner =
    FindPointsOf(mesh, FindTrianglesAt(mesh, points, scratch), scratch);
  this->Triangles = FindTrianglesAt(mesh, inner, scratch);
  this->PointOf = FindPointsOf(mesh, this->Triangles, scratch);
  for (const std::int32_t point : this->PointOf)
  {
    this->Inner.push_back(std::binary_search(inner.begin(), inner.end(), point) ? 1 : 0);
  }
}

void PieceRegion::NumberPoints(const PieceMesh& mesh, RegionScratch& scratch)
{
  for (std::size_t i = 0; i < this->PointOf.size(); ++i)
  {
    scratch.Points[this->PointOf[i]] = static_cast<std::int32_t>(i);
  }
  this->Ids.reserve(3 * this->Triangles.size());
  for (const std::int64_t t : this->Triangles)
  {
    for (const std::int32_t point : mesh.Triangles[t].Points)
    {
      this->Ids.push_back(scratch.Points[point]);
    }
  }
  for (const std::int32_t point : this->PointOf)
  {
    scratch.Points[point] = 0;
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

namespace
{
/// The marks of the edges of some triangles.
PairMap<unsigned char> ListMarks(const PieceMesh& mesh, const std::vector<std::int64_t>& triangles)
{
  PairMap<unsigned char> marks;
  for (const std::int64_t t : triangles)
  {
    for (int slot = 0; slot < 3; ++slot)
    {
      const unsigned char mark = (mesh.Triangles[t].Marks >> slot) & (FixedMark | SeamMark);
      if (mark != 0)
      {
        marks[mesh.Triangles[t].GetEdge(slot)] |= mark;
      }
    }
  }
  return marks;
}
}

void PieceRegion::Store(const std::vector<std::int32_t>& ids,
  const std::vector<std::int32_t>& flips, PieceMesh& mesh) const
{
  std::vector<std::int64_t> changed;
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < this->Triangles.size(); ++i)
  {
    if (flips[i] > 0)
    {
      changed.push_back(this->Triangles[i]);
      places.push_back(i);
    }
  }
  const PairMap<unsigned char> marks = ListMarks(mesh, changed);
  const auto change = [&](std::size_t i)
  {
    PieceTriangle& triangle = mesh.Triangles[this->Triangles[i]];
    triangle.Marks = 0;
    triangle.Flips += flips[i];
    for (int slot = 0; slot < 3; ++slot)
    {
      triangle.Points[slot] = this->PointOf[ids[3 * i + slot]];
    }
    for (int slot = 0; slot < 3; ++slot)
    {
      const auto found = marks.find(triangle.GetEdge(slot));
      triangle.Marks |=
        static_cast<unsigned char>(found != marks.end() ? found->second << slot : 0);
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
