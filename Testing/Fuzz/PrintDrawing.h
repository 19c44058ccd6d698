// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PRINTDRAWING_H
#define DELAUNAYFLIP_PRINTDRAWING_H

#include "PointTestSupport.h"

#include <cstddef>
#include <iostream>

namespace delaunayflip
{

/// Writes points and segments to standard output, so that all digits can be read back.
inline void PrintDrawing(const Drawing& drawing)
{
  std::cout.precision(17);
  for (const Place& point : drawing.Points)
  {
    std::cout << "point " << point[0] << ' ' << point[1] << '\n';
  }
  for (std::size_t i = 0; i < drawing.Segments.size(); ++i)
  {
    const auto& segment = drawing.Segments[i];
    std::cout << "segment " << segment[0] << ' ' << segment[1] << " of ring " << drawing.Rings[i]
              << '\n';
  }
}

}

#endif
