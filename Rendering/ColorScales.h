// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef ColorScales_h
#define ColorScales_h

#include "DeviceColors.h"

#include <array>

class vtkLookupTable;

namespace delaunayflip
{

/// What a mesh is painted with that shows nothing by its colours.
constexpr std::array<double, 3> PlainColor = { 0.80, 0.86, 0.91 };
constexpr std::array<unsigned char, 4> PlainBytes = { 204, 219, 232, 255 }; ///< The same, opaque.

/// Colours for the smallest angles of triangles, 0 to 60 degrees in steps of five: from red for
/// slivers to blue for equilateral triangles.
void FillAngleColors(vtkLookupTable* table);

/// Colours for numbers of flips, in twelve steps from nearly white to dark violet. The range is 0
/// to `largest`, rounded up to a multiple of four for whole labels at its quarters, and at least
/// 12.
void FillCountColors(vtkLookupTable* table, double largest);

/// The colours of a table for a GPU.
ColorBands GetBands(vtkLookupTable* table);

/// A single colour for all values.
ColorBands MakePlainBands();

}

#endif
