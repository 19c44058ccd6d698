// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "BenchmarkMesh.h"

#include "BadPlane.h"
#include "MeshFile.h"

#if defined(DELAUNAYFLIP_HAS_VTK)
#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#endif

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>
#include <utility>

namespace delaunayflip
{
namespace
{

constexpr std::uint32_t Seed = 2013;
constexpr std::int64_t SmallestRealMesh = 90000; ///< Triangles.

template <typename Real>
BenchmarkMesh Convert(const std::string& name, const OwnedMesh<Real>& mesh)
{
  BenchmarkMesh result;
  result.Name = name;
  result.Floats.assign(mesh.Points.begin(), mesh.Points.end()); // doubles are small integers
  result.Ids.assign(mesh.Triangles.begin(), mesh.Triangles.end());
  return result;
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

bool BenchmarkMesh::IsPlane() const
{
  const PointArray points = this->View().Points;
  bool isPlane = true;
  for (std::int64_t i = 0; isPlane && i < points.Count; ++i)
  {
    isPlane = this->Geometry == GeometryKind::PlanarXY || points.Get(i, 2) == points.Get(0, 2);
  }
  return isPlane && this->Geometry != GeometryKind::Surface;
}

BenchmarkMesh MakeRandomMesh(std::int64_t points)
{
  return Convert(
    points <= LargestUntiledMesh ? "random bad" : "random bad, tiled", MakePlaneMesh(points));
}

BenchmarkMesh MakeLatticeMesh(std::int64_t points)
{
  const auto side = static_cast<std::int32_t>(std::sqrt(static_cast<double>(points))) - 1;
  return Convert("grid, all ties", MakeGridMesh(side, side));
}

BenchmarkMesh MakeChainMesh(std::int32_t triangles)
{
  return Convert("chain of Fig. 6", MakeWorstCaseMesh(triangles / 2 + 1));
}

BenchmarkMesh MoveSomePoints(const BenchmarkMesh& mesh)
{
  constexpr std::size_t Step = 100;
  BenchmarkMesh moved = mesh;
  moved.Name = "Delaunay, 1 % of points moved";
  moved.EndsDelaunay = false;
  double extent[2]; // of the box
  for (std::size_t axis = 0; axis < 2; ++axis)
  {
    float lowest = mesh.Floats[axis], highest = lowest;
    for (std::size_t i = axis; i < mesh.Floats.size(); i += 3)
    {
      lowest = std::min(lowest, mesh.Floats[i]);
      highest = std::max(highest, mesh.Floats[i]);
    }
    extent[axis] = highest - lowest;
  }
  const double spacing = std::sqrt(extent[0] * extent[1] / static_cast<double>(mesh.CountPoints()));
  std::minstd_rand random(Seed);
  for (std::size_t i = 0; i < mesh.Floats.size(); i += 3 * Step)
  {
    for (std::size_t axis = 0; axis < 2; ++axis)
    {
      const double share = static_cast<double>(random()) / std::minstd_rand::max() - 0.5;
      moved.Floats[i + axis] += static_cast<float>(0.2 * share * spacing);
    }
  }
  return moved;
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

#if defined(DELAUNAYFLIP_HAS_VTK)
vtkSmartPointer<vtkPolyData> ToPolyData(const BenchmarkMesh& mesh)
{
  const bool isFloat = mesh.Doubles.empty();
  const auto coordinates = vtkSmartPointer<vtkDataArray>::Take(
    vtkDataArray::CreateDataArray(isFloat ? VTK_FLOAT : VTK_DOUBLE));
  coordinates->SetNumberOfComponents(3);
  coordinates->SetNumberOfTuples(mesh.CountPoints());
  std::memcpy(coordinates->GetVoidPointer(0),
    isFloat ? static_cast<const void*>(mesh.Floats.data()) : mesh.Doubles.data(),
    mesh.Floats.size() * sizeof(float) + mesh.Doubles.size() * sizeof(double));
  vtkNew<vtkPoints> points;
  points->SetData(coordinates);
  const auto makeCells = [](const std::vector<std::int64_t>& ids, int size)
  {
    auto cells = vtkSmartPointer<vtkCellArray>::New();
    cells->AllocateEstimate(static_cast<vtkIdType>(ids.size()) / size, size);
    for (std::size_t i = 0; i < ids.size(); i += size)
    {
      const vtkIdType cell[3] = { ids[i], ids[i + 1], size == 3 ? ids[i + 2] : 0 };
      cells->InsertNextCell(size, cell);
    }
    return cells;
  };
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetPolys(makeCells(mesh.Ids, 3));
  data->SetLines(makeCells(mesh.ConstraintEdges, 2));
  return data;
}
#endif

}
