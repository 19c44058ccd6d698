// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SequentialLawson.h"

#include "Predicates.h"

#include <limits>

namespace delaunayflip
{

SequentialLawson::SequentialLawson(const OwnedMesh<float>& mesh)
  : Mesh(mesh.Triangles)
{
  for (std::int64_t i = 0; i < mesh.NumberOfPoints(); ++i)
  {
    this->Points.push_back(mesh.Points[3 * i]);
    this->Points.push_back(mesh.Points[3 * i + 1]);
  }
}

std::int64_t SequentialLawson::Run()
{
  const auto point = [this](std::int32_t corner)
  { return &this->Points[2 * std::size_t(this->Mesh.Vertices[corner])]; };
  const auto isBad = [&](std::int32_t corner)
  {
    return InCircle(point(corner), point(CornerMesh::Next(corner)),
             point(CornerMesh::Previous(corner)), point(this->Mesh.Twins[corner])) > 0;
  };
  return RunLawson(this->Mesh, isBad, std::numeric_limits<std::int64_t>::max());
}

}
