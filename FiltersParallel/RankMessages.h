// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef RankMessages_h
#define RankMessages_h

#include "PieceFlip.h"

#include "vtkType.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

class vtkDataSetAttributes;
class vtkMultiProcessController;

/// @file
/// What ranks tell each other. All ranks must call each function together.

namespace delaunayflip
{

/// The processes of a controller as ranks. If one of them lacks memory for long messages, all ranks
/// throw, with its number: they allocate, then agree, then communicate.
/// @param controller must live as long as the group.
std::unique_ptr<PieceGroup> MakeControllerGroup(vtkMultiProcessController* controller);

/// Sends a message to all ranks. @returns those of all ranks, one behind the other.
MessageReader GatherAll(const Message& message, PieceGroup& group);

bool IsOnAnyRank(bool flag, PieceGroup& group);

/// Brings the data of points or cells from the ranks that have them.
/// @param origins what to bring. @param given the data of this rank.
/// @param tupleOf the tuple of `given` for an id of an origin.
/// @param result receives one tuple for each origin, in the arrays that `given` or one of the ranks
/// has. Values that the rank of an origin does not have are 0 or empty.
void BringTuples(const std::vector<PieceOrigin>& origins, vtkDataSetAttributes* given,
  const std::function<vtkIdType(std::int64_t)>& tupleOf, PieceGroup& group,
  vtkDataSetAttributes* result);

}

#endif
