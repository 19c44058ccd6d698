// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_GENERATEDMESHES_H
#define DELAUNAYFLIP_GENERATEDMESHES_H

#include "TriangleMesh.h"

#include <cstdint>
#include <vector>

/// @file
/// Meshes that tests and benchmarks make for themselves, the same on every machine.

namespace delaunayflip
{

/// An owned mesh: x, y, z of the points and three ids a triangle.
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

/// The paper's Fig. 7: a unit square of two triangles; every further random point splits the
/// triangle that holds it into three (into four, with the neighbour, when it lies on an edge).
/// `points` >= 4.
OwnedMesh<float> MakeRandomBadMesh(std::int64_t points, std::uint32_t seed);

/// The same in double precision.
OwnedMesh<double> MakeRandomBadMeshDouble(std::int64_t points, std::uint32_t seed);

/// A random bad mesh for large sizes, made by many threads (0: as many as the machine has): a
/// square of tilesPerSide x tilesPerSide squares that share their corners and borders, each split
/// as above by random points inside it. The same for any number of threads. `points` >=
/// (tilesPerSide + 1)^2, and some hundred thousand a tile at most.
OwnedMesh<float> MakeTiledBadMesh(
  std::int64_t points, std::int32_t tilesPerSide, std::uint32_t seed, int threads = 0);

/// The paper's Fig. 6 with 2 * size points and 2 * size - 2 triangles: size 4 is the paper's own
/// case, 6 triangles that take flips {1, 2, 3, 2, 1}; (size - 1)^2 flips in 2 * size - 3
/// iterations.
OwnedMesh<double> MakeWorstCaseMesh(std::int32_t size);

/// A lattice of columns x rows unit squares, each cut along the same diagonal: every edge is a tie
/// or clearly good.
OwnedMesh<double> MakeGridMesh(std::int32_t columns, std::int32_t rows);

/// A closed sphere-like surface of good topology and bad triangles: a latitude-longitude sphere
/// whose vertices are moved along their circles at random and whose quads are cut at random.
/// `rows` circles of `columns` points between two poles; `columns` >= 3, `rows` >= 1.
OwnedMesh<double> MakeBadSphere(std::int32_t columns, std::int32_t rows, std::uint32_t seed);

/// The latitude-longitude sphere of radius 1 itself, as VTK's sphere source makes it: every quad is
/// a trapezoid with its corners on one circle, but for the rounding of their coordinates.
OwnedMesh<double> MakeLatLongSphere(std::int32_t columns, std::int32_t rows);

/// A Moebius strip of `columns` x `rows` quads, vertices moved along the strip at random and quads
/// cut at random: one side, one boundary, `rows` wrongly wound edges at the seam. `columns` >= 3,
/// `rows` >= 1.
OwnedMesh<double> MakeMoebiusStrip(std::int32_t columns, std::int32_t rows, std::uint32_t seed);

/// The mesh with every tenth triangle twice, so that edges of three and more triangles abound.
OwnedMesh<double> RepeatTriangles(OwnedMesh<double> mesh);

}

#endif
