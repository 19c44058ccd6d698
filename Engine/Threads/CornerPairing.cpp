// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CornerPairing.h"

namespace delaunayflip
{

bool ThreadBackend::PairCorners(
  EdgeMesh& mesh, std::int64_t vertices, PairSums& sums, Numbering& numbering) const
{
  CornerPairing pairing(mesh, vertices, *this);
  if (!pairing.IsEven())
  {
    return false;
  }
  sums = pairing.Run();
  numbering = this->Count(mesh.NumberOfTriangles, OtherCornerStep{ mesh.Triangles.Data() });
  return true;
}

}
