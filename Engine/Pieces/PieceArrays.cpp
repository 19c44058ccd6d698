// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PieceArrays.h"

namespace delaunayflip
{

std::vector<TriangleLabel> ListLabels(const TriangleMesh& mesh)
{
  std::vector<TriangleLabel> labels;
  labels.reserve(mesh.Triangles.Count);
  for (std::int64_t t = 0; t < mesh.Triangles.Count; ++t)
  {
    labels.push_back(
      { mesh.Regions ? mesh.Regions[t] : 0, mesh.FrozenTriangles && mesh.FrozenTriangles[t] != 0 });
  }
  return labels;
}

void PieceArrays::AddConstraint(std::int64_t from, std::int64_t to)
{
  this->Constraints.insert(this->Constraints.end(), { from, to });
}

void PieceArrays::TakeTriangles(const PieceMesh& mesh)
{
  this->Ids.reserve(3 * mesh.Triangles.size());
  for (const PieceTriangle& triangle : mesh.Triangles)
  {
    this->Ids.insert(this->Ids.end(), triangle.Points, triangle.Points + 3);
  }
}

void PieceArrays::TakeLabels(const PieceMesh& mesh, const std::vector<TriangleLabel>& labels)
{
  for (std::size_t t = 0; t < labels.size(); ++t)
  {
    if (!mesh.Triangles[t].HasLeft)
    {
      this->Regions.push_back(labels[t].Region);
      this->Frozen.push_back(labels[t].IsFrozen ? 1 : 0);
    }
  }
}

void PieceArrays::TakePoints(const PieceMesh& mesh)
{
  this->Points.Reserve(mesh.GetNumberOfPoints());
  for (std::int64_t i = 0; i < mesh.GetNumberOfPoints(); ++i)
  {
    double x[3];
    mesh.GetPosition(i, x);
    this->Points.Add(x);
  }
}

void PieceArrays::AddTo(TriangleMesh& mesh) const
{
  mesh.Triangles = TriangleArray(this->Ids.data(), static_cast<std::int64_t>(this->Ids.size()) / 3);
  mesh.ConstraintEdges = this->Constraints.data();
  mesh.NumberOfConstraintEdges = static_cast<std::int64_t>(this->Constraints.size()) / 2;
  mesh.ConstraintsToInsert = nullptr;
  if (this->Points.GetSize() > 0)
  {
    mesh.Points = this->Points.View();
  }
  if (!this->Regions.empty())
  {
    mesh.Regions = this->Regions.data();
    mesh.FrozenTriangles = this->Frozen.data();
  }
}

}
