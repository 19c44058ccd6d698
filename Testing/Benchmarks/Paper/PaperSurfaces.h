// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PAPERSURFACES_H
#define DELAUNAYFLIP_PAPERSURFACES_H

#include "GeneratedMeshes.h"

#include <cstdint>
#include <string>

/// @file
/// Meshes of the experiments, good and ruined. `seed` seeds the random generator.

namespace delaunayflip
{

/// A closed torus with bumps, which replaces the paper's "Infinite": `rows` circles of `columns`
/// points. Points are moved along their circles by up to the share `shift` of their distance. If
/// `shift` > 0, every quad is cut along a random diagonal.
OwnedMesh<double> MakeBumpyTorus(
  std::int32_t columns, std::int32_t rows, double shift, std::uint32_t seed);

/// A cube of 6 * size * size quads, with sharp edges.
OwnedMesh<double> MakeBox(std::int32_t size);

/// A plane disc of concentric circles of `columns` points at the same angles. So the four points of
/// each quad lie on a circle, except for the rounding of their coordinates.
OwnedMesh<double> MakeCircles(std::int32_t columns, std::int32_t rows);

/// Moves every point at random, by up to `distance` in each coordinate.
void AddNoise(OwnedMesh<double>& mesh, double distance, std::uint32_t seed);

/// Makes random flips, about `share` per triangle. Each is legal: the new edge did not exist, and
/// the normals of the two old and the two new triangles differ from that of the quad by less than
/// 20 degrees.
void RuinByFlips(OwnedMesh<double>& mesh, double share, std::uint32_t seed);

/// Splits about `share` of all edges of two triangles close to one end, at 2 % of their length. Two
/// of the four new triangles are then needles. The shape of the surface does not change.
void RuinBySplits(OwnedMesh<double>& mesh, double share, std::uint32_t seed);

/// Writes a mesh in the format of MeshFile.h. @throws std::runtime_error.
void WriteMeshFile(const OwnedMesh<float>& mesh, const std::string& path);

OwnedMesh<float> RoundToFloats(const OwnedMesh<double>& mesh);
OwnedMesh<double> WidenToDoubles(const OwnedMesh<float>& mesh);

}

#endif
