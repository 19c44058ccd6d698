// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PieceRegion.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace delaunayflip
{

PieceRegion::PieceRegion(
  const PieceMesh& mesh, std::vector<std::int64_t> triangles, const PieceSurvey& survey)
  : Whole(survey.Whole),
    Triangles(std::move(triangles)),
    Points(survey.IsFloat)
{
  this->CollectPoints(mesh);
  this->Describe(mesh, survey, false);
}

PieceRegion::PieceRegion(const PieceMesh& mesh, const PieceSurvey& survey)
  : Whole(survey.Whole),
    PointOf(mesh.GetNumberOfPoints()),
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
  this->Describe(mesh, survey, true);
}

void PieceRegion::Describe(const PieceMesh& mesh, const PieceSurvey& survey, bool isWhole)
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
        (mesh.IsShared(this->PointOf[i]) ? Elsewhere : 0) | (isWhole ? 0 : Outside)));
    }
  }
}

/// Finds and numbers the points of the triangles.
void PieceRegion::CollectPoints(const PieceMesh& mesh)
{
  this->Ids.reserve(3 * this->Triangles.size());
  for (const std::int64_t t : this->Triangles)
  {
    this->Ids.insert(this->Ids.end(), mesh.Triangles[t].Points, mesh.Triangles[t].Points + 3);
  }
  this->PointOf = this->Ids;
  std::sort(this->PointOf.begin(), this->PointOf.end());
  this->PointOf.erase(std::unique(this->PointOf.begin(), this->PointOf.end()), this->PointOf.end());
  for (std::int32_t& id : this->Ids)
  {
    id = static_cast<std::int32_t>(this->FindPoint(id));
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
  for (std::size_t i = 0; i < this->Triangles.size(); ++i)
  {
    mesh.Triangles[this->Triangles[i]].Flips += flips[i];
    for (int slot = 0; slot < 3; ++slot)
    {
      mesh.SetPoint({ this->Triangles[i], slot }, this->PointOf[ids[3 * i + slot]]);
    }
  }
}

}
