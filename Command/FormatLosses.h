// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_FORMATLOSSES_H
#define DELAUNAYFLIP_FORMATLOSSES_H

#include "MeshFormat.h"

#include <string>

class vtkPolyData;

namespace delaunayflip
{

/// What of `mesh` a file of the format does not hold, as a list in words; empty if nothing.
std::string DescribeLosses(vtkPolyData* mesh, MeshFormat format);

}

#endif
