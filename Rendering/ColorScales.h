// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef ColorScales_h
#define ColorScales_h

class vtkLookupTable;

namespace delaunayflip
{

/// Smallest angles of triangles, 0 to 60 degrees in steps of five: red for slivers, blue for
/// equilateral triangles.
void FillAngleColors(vtkLookupTable* table);

/// Numbers of flips in twelve steps from nearly white to dark violet: 0 to `largest`, rounded up to
/// a multiple of four, whose quarters are whole; 12 at least, since fewer would make colours jump.
void FillCountColors(vtkLookupTable* table, double largest);

}

#endif
