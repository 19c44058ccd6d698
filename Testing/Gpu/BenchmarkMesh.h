// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_BENCHMARKMESH_H
#define DELAUNAYFLIP_BENCHMARKMESH_H

#include "FlipOptions.h"
#include "TriangleMesh.h"

#if defined(DELAUNAYFLIP_HAS_VTK)
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#endif

#include <cstdint>
#include <string>
#include <vector>

namespace delaunayflip
{

/// The input of the engine: coordinates in single precision (in double for some real meshes) and
/// triangles with 64-bit ids, as in VTK.
struct BenchmarkMesh
{
  std::string Name;
  std::vector<float> Floats; ///< Either Floats or Doubles is empty.
  std::vector<double> Doubles;
  std::vector<std::int64_t> Ids;
  std::vector<std::int64_t> ConstraintEdges;
  GeometryKind Geometry = GeometryKind::Auto;
  bool EndsDelaunay = true; ///< Whether no bad edge may be left.

  std::int64_t CountPoints() const
  {
    return static_cast<std::int64_t>(this->Floats.size() + this->Doubles.size()) / 3;
  }
  std::int64_t CountTriangles() const { return static_cast<std::int64_t>(this->Ids.size()) / 3; }
  TriangleMesh View() const;

  /// Whether x and y say all: z is the same everywhere, or does not matter.
  bool IsPlane() const;
};

BenchmarkMesh MakeRandomMesh(std::int64_t points);

/// About `points` points of a square lattice: every edge is a tie or clearly good.
BenchmarkMesh MakeLatticeMesh(std::int64_t points);

/// The paper's Fig. 6: an even number of triangles; on average a quarter of them flips per
/// iteration.
BenchmarkMesh MakeChainMesh(std::int32_t triangles);

/// The mesh after every hundredth point has moved in x and y, by up to a tenth of the mean distance
/// between neighbours.
BenchmarkMesh MoveSomePoints(const BenchmarkMesh& mesh);

/// The real meshes of a folder that are large enough to time, height fields both by x and y and in
/// space.
std::vector<BenchmarkMesh> ReadRealMeshes(const std::string& folder);

#if defined(DELAUNAYFLIP_HAS_VTK)
/// The mesh for VTK, with its constraint edges as lines.
vtkSmartPointer<vtkPolyData> ToPolyData(const BenchmarkMesh& mesh);
#endif

}

#endif
