// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PieceArrays.h"

namespace delaunayflip
{

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
}

}
