// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef TupleTransfer_h
#define TupleTransfer_h

#include "PieceFlip.h"
#include "PieceGroup.h"

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <cstdint>
#include <functional>
#include <vector>

class vtkAbstractArray;
class vtkDataSetAttributes;

namespace delaunayflip
{

/// An array of the same kind, of zeros or empty texts; null if there is no such kind.
vtkSmartPointer<vtkAbstractArray> MakeZeros(vtkAbstractArray* like, vtkIdType size);

/// Brings the data of points or cells from the ranks that have them. All ranks must call this
/// together.
/// @param origins what to bring. @param given the data of this rank.
/// @param tupleOf the tuple of `given` for an id of an origin.
/// @param result receives one tuple for each origin in every array that `given` has. Where `given`
/// has no arrays at all, because the rank's piece is empty, it gets those of the others. Values
/// that the other rank does not have are 0 or empty.
void BringTuples(const std::vector<PieceOrigin>& origins, vtkDataSetAttributes* given,
  const std::function<vtkIdType(std::int64_t)>& tupleOf, PieceGroup& group,
  vtkDataSetAttributes* result);

}

#endif
