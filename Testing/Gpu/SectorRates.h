// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_SECTORRATES_H
#define DELAUNAYFLIP_SECTORRATES_H

namespace delaunayflip
{

/// Prints how many sectors of 32 bytes a second the current GPU serves at random places of its
/// memory, which is the measure of what flips could take: loads, stores of four bytes and atomic
/// "or"s that nobody waits for, within a range that the second-level cache holds and within one as
/// large as the edge mesh of 10 M triangles. Says "no GPU: skipped" without one.
/// @throws BackendUnavailable where a call of the CUDA runtime fails.
void PrintSectorRates();

}

#endif
