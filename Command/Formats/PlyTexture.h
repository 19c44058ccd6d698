// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PLYTEXTURE_H
#define DELAUNAYFLIP_PLYTEXTURE_H

#include "CornerVectors.h"
#include "FileMesh.h"
#include "InputFile.h"

#include <cstdint>
#include <vector>

namespace delaunayflip
{

/// Collects the lists texcoord of the faces of a .ply: two coordinates for each corner, or none.
class PlyTexture
{
public:
  void Add(double coordinate) { this->Corners.Values.push_back(coordinate); }
  void EndFace() { this->Ends.push_back(static_cast<std::int64_t>(this->Corners.Values.size())); }

  /// Attaches the coordinates, if there are any, to the points of the mesh.
  /// @throws CommandError (BadFile) if a face does not have two for each corner.
  void Attach(FileMesh& mesh, const InputFile& file);

private:
  CornerVectors Corners;
  std::vector<std::int64_t> Ends; ///< Where the values of each face end.
};

}

#endif
