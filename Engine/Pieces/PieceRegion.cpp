// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PieceRegion.h"

#include <algorithm>
#include <numeric>

namespace delaunayflip
{

namespace
{
/// The triangles of the piece at flagged points.
std::vector<std::int64_t> FindFlagged(const PieceMesh& mesh, const PointFlags& flags)
{
  std::vector<std::int64_t> found;
  for (std::size_t t = 0; t < mesh.Triangles.size(); ++t)
  {
    if (flags.Count(mesh.Triangles[t]) > 0)
    {
      found.push_back(static_cast<std::int64_t>(t));
    }
  }
  return found;
}
}

PieceRegion::PieceRegion(const PieceMesh& mesh, const std::vector<std::int32_t>& points,
  PointFlags& flags, const PieceSurvey& survey)
  : Whole(survey.Whole),
    Points(survey.IsFloat)
{
  this->Collect(mesh, points, flags);
  this->Describe(mesh, survey);
}

PieceRegion::PieceRegion(const PieceMesh& mesh, const PieceSurvey& survey)
  : Whole(survey.Whole),
    Triangles(mesh.Triangles.size()),
    PointOf(mesh.GetNumberOfPoints()),
    Inner(mesh.GetNumberOfPoints(), 1),
    Points(survey.IsFloat)
{
  std::iota(this->Triangles.begin(), this->Triangles.end(), 0);
  std::iota(this->PointOf.begin(), this->PointOf.end(), 0);
  for (const PieceTriangle& triangle : mesh.Triangles)
  {
    this->Ids.insert(this->Ids.end(), triangle.Points, triangle.Points + 3);
  }
  this->Describe(mesh, survey);
}

void PieceRegion::Describe(const PieceMesh& mesh, const PieceSurvey& survey)
{
  this->ListFixedEdges(mesh);
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
        (mesh.Shared[this->PointOf[i]] ? Elsewhere : 0) | (this->Inner[i] ? 0 : Outside)));
    }
  }
}

void PieceRegion::Collect(
  const PieceMesh& mesh, const std::vector<std::int32_t>& points, PointFlags& flags)
{
  const auto flag = [&](const std::vector<std::int64_t>& triangles, bool set)
  {
    for (const std::int64_t t : triangles)
    {
      for (const std::int32_t point : mesh.Triangles[t].Points)
      {
        set ? flags.Set(point) : flags.Clear(point);
      }
    }
  };
  std::for_each(points.begin(), points.end(), [&](std::int32_t point) { flags.Set(point); });
  const std::vector<std::int64_t> near = FindFlagged(mesh, flags);
  flag(near, true);
  this->Triangles = FindFlagged(mesh, flags);
  this->NumberPoints(mesh);
  for (const std::int32_t point : this->PointOf)
  {
    this->Inner.push_back(flags.Has(point) ? 1 : 0);
  }
  flag(near, false);
  std::for_each(points.begin(), points.end(), [&](std::int32_t point) { flags.Clear(point); });
}

void PieceRegion::NumberPoints(const PieceMesh& mesh)
{
  for (const std::int64_t t : this->Triangles)
  {
    const std::int32_t(&points)[3] = mesh.Triangles[t].Points;
    this->PointOf.insert(this->PointOf.end(), points, points + 3);
  }
  this->Ids = this->PointOf;
  std::sort(this->PointOf.begin(), this->PointOf.end());
  this->PointOf.erase(std::unique(this->PointOf.begin(), this->PointOf.end()), this->PointOf.end());
  for (std::int32_t& id : this->Ids)
  {
    id = static_cast<std::int32_t>(
      std::lower_bound(this->PointOf.begin(), this->PointOf.end(), id) - this->PointOf.begin());
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
  PairMap<unsigned char> marks;
  for (const std::int64_t t : this->Triangles)
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
  for (std::size_t i = 0; i < this->Triangles.size(); ++i)
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
  }
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
  std::sort(next.begin(), next.end());
  next.erase(std::unique(next.begin(), next.end()), next.end());
  return next;
}

}
