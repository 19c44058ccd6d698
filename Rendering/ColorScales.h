// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef ColorScales_h
#define ColorScales_h

class vtkLookupTable;

namespace delaunayflip
{

/// Colours for the smallest angles of triangles, 0 to 60 degrees in steps of five: from red for
/// slivers to blue for equilateral triangles.
void FillAngleColors(vtkLookupTable* table);

/// Colours for numbers of flips, in twelve steps from nearly white to dark violet. The range is 0
/// to `largest`, rounded up to a multiple of four for whole labels at its quarters, and at least
/// 12.
void FillCountColors(vtkLookupTable* table, double largest);

}

#endif
