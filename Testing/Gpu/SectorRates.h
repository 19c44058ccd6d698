// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_SECTORRATES_H
#define DELAUNAYFLIP_SECTORRATES_H

namespace delaunayflip
{

/// Prints how many sectors of 32 bytes per second the current GPU serves at random places of its
/// memory, which limits the speed of flips. Measures loads, stores of four bytes, and atomic "or"s
/// without a result, within a range that fits into the second-level cache and within one as large
/// as the edge mesh of 10 M triangles. Prints "no GPU: skipped" if there is none.
/// @throws BackendUnavailable if a call of the CUDA runtime fails.
void PrintSectorRates();

}

#endif
