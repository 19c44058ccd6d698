// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "RandomMess.h"

#include <limits>
#include <random>
#include <utility>

namespace delaunayflip
{
namespace
{

using Random = std::mt19937;

/// Random triangles on a small lattice: every kind of edge and degenerate triangle.
OwnedMesh<double> MakeSoup(Random& random)
{
  constexpr double Scales[] = { 1.0, 1e-3, 1e6 };
  const double scale = Scales[random() % 3];
  const std::uint32_t points = 3 + random() % 60;
  OwnedMesh<double> mesh;
  for (std::uint32_t i = 0; i < points; ++i)
  {
    mesh.Points.push_back(scale * (random() % 16));
    mesh.Points.push_back(scale * (random() % 16));
    mesh.Points.push_back(random() % 3 == 0 ? scale * (random() % 16) : 0.0);
  }
  for (std::uint32_t i = 3 * (1 + random() % 150); i > 0; --i)
  {
    mesh.Triangles.push_back(static_cast<std::int32_t>(random() % points));
  }
  return mesh;
}

void SpoilPoints(OwnedMesh<double>& mesh, Random& random)
{
  for (std::uint32_t i = random() % 3; i > 0; --i)
  {
    const double moved = (random() % 8) / 8.0;
    const bool isNaN = random() % 4 == 0;
    mesh.Points[random() % mesh.Points.size()] =
      isNaN ? std::numeric_limits<double>::quiet_NaN() : moved;
  }
  const double roughness = (random() % 2) * 0.01;
  for (std::size_t i = 2; i < mesh.Points.size(); i += 3)
  {
    mesh.Points[i] += roughness * (random() % 100);
  }
}

/// Turns some triangles over and repeats some.
void SpoilTriangles(OwnedMesh<double>& mesh, Random& random)
{
  for (std::uint32_t i = random() % 4; i > 0; --i)
  {
    const std::size_t t = random() % (mesh.Triangles.size() / 3);
    std::swap(mesh.Triangles[3 * t + random() % 3], mesh.Triangles[3 * t + random() % 3]);
  }
  for (std::uint32_t i = random() % 3; i > 0; --i)
  {
    const std::size_t t = random() % (mesh.Triangles.size() / 3);
    for (std::size_t slot = 0; slot < 3; ++slot)
    {
      mesh.Triangles.push_back(mesh.Triangles[3 * t + slot]);
    }
  }
}

OwnedMesh<double> MakeMesh(Random& random)
{
  if (random() % 2 == 0)
  {
    return MakeSoup(random);
  }
  OwnedMesh<double> mesh = MakeRandomBadMeshDouble(4 + random() % 80, random());
  SpoilPoints(mesh, random);
  SpoilTriangles(mesh, random);
  return mesh;
}

/// Options that are valid for any mesh: not Planar, which needs a plane, nor Canonical, which is
/// not for surfaces.
FlipOptions MakeOptions(Random& random)
{
  constexpr GeometryKind Geometries[] = { GeometryKind::Auto, GeometryKind::PlanarXY,
    GeometryKind::Surface };
  FlipOptions options;
  options.Geometry = Geometries[random() % 3];
  options.Criterion = random() % 4 == 0 ? CriterionKind::OppositeAngles : CriterionKind::InCircle;
  options.FeatureAngle = random() % 2 == 0 ? 180.0 : 30.0;
  options.NumberOfThreads = 1 + static_cast<int>(random() % 2);
  if (options.Geometry == GeometryKind::PlanarXY && options.Criterion == CriterionKind::InCircle)
  {
    options.TieRule = random() % 2 == 0 ? TieRuleKind::Canonical : TieRuleKind::Keep;
  }
  return options;
}

}

TriangleMesh RandomMess::View() const
{
  TriangleMesh view = this->Mesh.View();
  view.ConstraintEdges = this->Constraints.data();
  view.NumberOfConstraintEdges = static_cast<std::int64_t>(this->Constraints.size()) / 2;
  return view;
}

RandomMess MakeRandomMess(std::uint32_t seed)
{
  Random random(seed);
  RandomMess mess;
  mess.Mesh = MakeMesh(random);
  for (std::uint32_t i = 2 * (random() % 5); i > 0; --i)
  {
    mess.Constraints.push_back(static_cast<std::int64_t>(random() % mess.Mesh.NumberOfPoints()));
  }
  mess.Options = MakeOptions(random);
  return mess;
}

}
