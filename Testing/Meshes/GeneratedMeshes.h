// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_GENERATEDMESHES_H
#define DELAUNAYFLIP_GENERATEDMESHES_H

#include "TriangleMesh.h"

#include <cstdint>
#include <vector>

/// @file
/// Meshes that tests and benchmarks generate, the same on every machine.

namespace delaunayflip
{

/// An owned mesh: x, y, z of the points and three ids per triangle.
template <typename Real>
struct OwnedMesh
{
  std::vector<Real> Points;
  std::vector<std::int32_t> Triangles;

  std::int64_t NumberOfPoints() const { return static_cast<std::int64_t>(this->Points.size()) / 3; }
  std::int64_t NumberOfTriangles() const
  {
    return static_cast<std::int64_t>(this->Triangles.size()) / 3;
  }
  TriangleMesh View() const
  {
    TriangleMesh mesh;
    mesh.Points = PointArray(this->Points.data(), this->NumberOfPoints());
    mesh.Triangles = TriangleArray(this->Triangles.data(), this->NumberOfTriangles());
    return mesh;
  }
};

/// The paper's Fig. 7: a unit square of two triangles. Every further random point splits the
/// triangle that contains it into three; if it lies on an edge, it splits both triangles in two.
/// `points` >= 4.
OwnedMesh<float> MakeRandomBadMesh(std::int64_t points, std::uint32_t seed);

/// A random bad mesh in double precision.
OwnedMesh<double> MakeRandomBadMeshDouble(std::int64_t points, std::uint32_t seed);

/// A large random bad mesh, made by several threads (0: as many as the machine has). It is a square
/// of tilesPerSide x tilesPerSide squares that share their corners and borders, each split as above
/// by random points inside it. It does not depend on the number of threads. `points` is at least
/// (tilesPerSide + 1)^2 and at most a few hundred thousand per tile.
OwnedMesh<float> MakeTiledBadMesh(
  std::int64_t points, std::int32_t tilesPerSide, std::uint32_t seed, int threads = 0);

/// The paper's Fig. 6, with 2 * size points and 2 * size - 2 triangles. It takes (size - 1)^2 flips
/// in 2 * size - 3 iterations. The paper's own case has size 4: 6 triangles, and iterations that
/// make 1, 2, 3, 2 and 1 flips.
OwnedMesh<double> MakeWorstCaseMesh(std::int32_t size);

/// A lattice of columns x rows unit squares, all divided along the same diagonal: every edge is a
/// tie or clearly good.
OwnedMesh<double> MakeGridMesh(std::int32_t columns, std::int32_t rows);

/// A square grid of about `points` points, the squares divided along the same diagonal. Then every
/// point is moved at random along both axes, by less than a quarter of a square's side, so that no
/// triangle turns over.
OwnedMesh<float> MakeJitteredGrid(std::int64_t points, std::uint32_t seed);

/// A latitude-longitude sphere with bad triangles: vertices are moved along their circles at
/// random, and quads are divided along a random diagonal. It has `rows` circles of `columns` points
/// between two poles; `columns` >= 3, `rows` >= 1.
OwnedMesh<double> MakeBadSphere(std::int32_t columns, std::int32_t rows, std::uint32_t seed);

/// A latitude-longitude sphere of radius 1, as VTK's sphere source makes it: up to rounding, every
/// quad is a trapezoid with its corners on one circle.
OwnedMesh<double> MakeLatLongSphere(std::int32_t columns, std::int32_t rows);

/// A Moebius strip of `columns` x `rows` quads, with vertices moved along the strip at random and
/// quads divided along a random diagonal. It has one side, one boundary, and `rows` wrongly wound
/// edges at the seam. `columns` >= 3, `rows` >= 1.
OwnedMesh<double> MakeMoebiusStrip(std::int32_t columns, std::int32_t rows, std::uint32_t seed);

/// `count` triangles around point 0, each an eighth of a turn from `start` eighths on. They do not
/// close, and overlap where they are more than eight.
OwnedMesh<double> MakeFan(int start, int count);

/// The mesh with every tenth triangle repeated, so that many edges have three or more triangles.
OwnedMesh<double> RepeatTriangles(OwnedMesh<double> mesh);

}

#endif
