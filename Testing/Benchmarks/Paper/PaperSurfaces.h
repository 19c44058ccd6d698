// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PAPERSURFACES_H
#define DELAUNAYFLIP_PAPERSURFACES_H

#include "GeneratedMeshes.h"

#include <cstdint>
#include <string>

/// @file
/// Meshes of the experiments, good and ruined. `seed` chooses one of many.

namespace delaunayflip
{

/// A closed torus with bumps, in the place of the paper's "Infinite": `rows` circles of `columns`
/// points. `shift` moves points along their circles by up to that share of the distance between
/// two; every quad is cut along a random diagonal where `shift` > 0.
OwnedMesh<double> MakeBumpyTorus(
  std::int32_t columns, std::int32_t rows, double shift, std::uint32_t seed);

/// A cube of 6 * size * size quads, with sharp edges.
OwnedMesh<double> MakeBox(std::int32_t size);

/// A plane disc of concentric circles of `columns` points at the same angles: all four points of a
/// quad lie on a circle, but for the rounding of their coordinates.
OwnedMesh<double> MakeCircles(std::int32_t columns, std::int32_t rows);

/// Moves every point at random, by up to `distance` in each coordinate.
void AddNoise(OwnedMesh<double>& mesh, double distance, std::uint32_t seed);

/// Makes about `share` * triangles random flips. Each is legal: the new edge did not exist, and the
/// normals of the two new triangles differ from that of the quad by less than 20 degrees, like
/// those of the old.
void RuinByFlips(OwnedMesh<double>& mesh, double share, std::uint32_t seed);

/// Splits about `share` of all edges of two triangles close to one end, at 2 % of their length: two
/// of the four new triangles are needles. The surface stays where it is.
void RuinBySplits(OwnedMesh<double>& mesh, double share, std::uint32_t seed);

/// Writes a mesh in the format of MeshFile.h. @throws std::runtime_error.
void WriteMeshFile(const OwnedMesh<float>& mesh, const std::string& path);

OwnedMesh<float> RoundToFloats(const OwnedMesh<double>& mesh);
OwnedMesh<double> WidenToDoubles(const OwnedMesh<float>& mesh);

}

#endif
