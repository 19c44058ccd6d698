// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_FORMATLOSSES_H
#define DELAUNAYFLIP_FORMATLOSSES_H

#include "MeshFormat.h"

#include <string>

class vtkPolyData;

namespace delaunayflip
{

/// Lists in words which parts of `mesh` a file of this format cannot store; empty if it can store
/// all of them.
std::string DescribeLosses(vtkPolyData* mesh, MeshFormat format);

}

#endif
