// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef ControllerGroup_h
#define ControllerGroup_h

#include "PieceGroup.h"

#include <memory>

class vtkMultiProcessController;

namespace delaunayflip
{

/// The processes of a controller as ranks. If one of them lacks memory for long messages, all ranks
/// throw, with its number: they allocate, then agree, then communicate.
/// @param controller must live as long as the group.
std::unique_ptr<PieceGroup> MakeControllerGroup(vtkMultiProcessController* controller);

}

#endif
