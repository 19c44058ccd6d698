// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "BenchmarkMesh.h"

#include "GeneratedMeshes.h"
#include "MeshFile.h"

#include <cmath>
#include <utility>

namespace delaunayflip
{
namespace
{

constexpr std::uint32_t Seed = 2013;
constexpr std::int64_t LargestTile = 250000;
constexpr std::int64_t SmallestRealMesh = 90000; ///< Triangles.

BenchmarkMesh FromFloats(const std::string& name, OwnedMesh<float> mesh)
{
  BenchmarkMesh result;
  result.Name = name;
  result.Floats = std::move(mesh.Points);
  result.Ids.assign(mesh.Triangles.begin(), mesh.Triangles.end());
  return result;
}

BenchmarkMesh FromDoubles(const std::string& name, const OwnedMesh<double>& mesh)
{
  OwnedMesh<float> floats;
  floats.Points.assign(mesh.Points.begin(), mesh.Points.end()); // small integers
  floats.Triangles = mesh.Triangles;
  return FromFloats(name, std::move(floats));
}

}

TriangleMesh BenchmarkMesh::View() const
{
  TriangleMesh view;
  view.Points = this->Doubles.empty() ? PointArray(this->Floats.data(), this->CountPoints())
                                      : PointArray(this->Doubles.data(), this->CountPoints());
  view.Triangles = TriangleArray(this->Ids.data(), this->CountTriangles());
  view.ConstraintEdges = this->ConstraintEdges.data();
  view.NumberOfConstraintEdges = static_cast<std::int64_t>(this->ConstraintEdges.size()) / 2;
  return view;
}

BenchmarkMesh MakeRandomMesh(std::int64_t points)
{
  if (points <= LargestUntiledMesh)
  {
    return FromFloats("random bad", MakeRandomBadMesh(points, Seed));
  }
  const double tiles = static_cast<double>(points) / static_cast<double>(LargestTile);
  const auto tilesPerSide = static_cast<std::int32_t>(std::ceil(std::sqrt(tiles)));
  return FromFloats("random bad, tiled", MakeTiledBadMesh(points, tilesPerSide, Seed));
}

BenchmarkMesh MakeLatticeMesh(std::int64_t points)
{
  const auto side = static_cast<std::int32_t>(std::sqrt(static_cast<double>(points))) - 1;
  return FromDoubles("grid, all ties", MakeGridMesh(side, side));
}

BenchmarkMesh MakeChainMesh(std::int32_t triangles)
{
  return FromDoubles("chain of Fig. 6", MakeWorstCaseMesh(triangles / 2 + 1));
}

std::vector<BenchmarkMesh> ReadRealMeshes(const std::string& folder)
{
  std::vector<BenchmarkMesh> meshes;
  for (const std::string& path : ListMeshFiles(folder))
  {
    const FileMesh file = ReadMeshFile(path);
    if (file.View().Triangles.Count < SmallestRealMesh)
    {
      continue;
    }
    BenchmarkMesh mesh;
    mesh.Name = file.Name;
    mesh.Floats = file.Floats;
    mesh.Doubles = file.Doubles;
    mesh.Ids.assign(file.Triangles.begin(), file.Triangles.end());
    mesh.ConstraintEdges = file.ConstraintEdges;
    mesh.EndsDelaunay = false;
    mesh.Geometry = file.IsHeightField ? GeometryKind::Surface : GeometryKind::Auto;
    meshes.push_back(mesh);
    if (file.IsHeightField)
    {
      mesh.Name += " (x, y)";
      mesh.Geometry = GeometryKind::PlanarXY;
      mesh.EndsDelaunay = true;
      meshes.push_back(std::move(mesh));
    }
  }
  return meshes;
}

}
