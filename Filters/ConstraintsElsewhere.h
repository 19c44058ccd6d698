// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef ConstraintsElsewhere_h
#define ConstraintsElsewhere_h

#include "PieceFlip.h"
#include "TriangleMesh.h"

#include <cstdint>
#include <vector>

class vtkPolyData;

namespace delaunayflip
{

/// Constraint edges whose two ends no rank has together.
struct ConstraintsElsewhere
{
  std::vector<PieceOrigin> Ends; ///< Two for each: points of ranks. Only on rank 0.
  std::int64_t Count = 0; ///< Of all ranks.
  std::int64_t Unmatched = 0; ///< More of them, with an end that no rank has.
};

/// All ranks must call this together.
/// @param constraints those of all ranks (GatherConstraints). @param mesh this rank's.
ConstraintsElsewhere FindConstraintsElsewhere(
  vtkPolyData* constraints, const TriangleMesh& mesh, PieceGroup& group);

}

#endif
