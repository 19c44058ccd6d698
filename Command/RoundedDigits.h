// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_ROUNDEDDIGITS_H
#define DELAUNAYFLIP_ROUNDEDDIGITS_H

#include <string>

class vtkPolyData;

namespace delaunayflip
{

/// To what the coordinates of a mesh were rounded.
struct RoundedCoordinates
{
  int Digits = 0;
  double Tolerance = 0.0; ///< In radians, that leaves alone edges that only this makes bad.
};

/// Finds whether the coordinates of a surface were rounded to so few decimal digits that bad edges
/// may come from that; else the tolerance is 0. Such coordinates come from text, whatever the
/// format of the file is now.
RoundedCoordinates FindRounding(vtkPolyData* mesh);

/// A line of the summary that advises the tolerance.
std::string DescribeRounding(const RoundedCoordinates& rounded);

}

#endif
