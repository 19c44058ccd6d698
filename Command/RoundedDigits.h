// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_ROUNDEDDIGITS_H
#define DELAUNAYFLIP_ROUNDEDDIGITS_H

#include <string>

class vtkPolyData;

namespace delaunayflip
{

/// A line of the summary that names a tolerance, for a surface whose coordinates were rounded to so
/// few decimal digits that bad edges come from that; else empty. Such coordinates come from text,
/// whatever the format of the file is now.
std::string AdviseTolerance(vtkPolyData* mesh);

}

#endif
