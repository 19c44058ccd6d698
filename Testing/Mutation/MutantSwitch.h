// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_MUTANTSWITCH_H
#define DELAUNAYFLIP_MUTANTSWITCH_H

#include <cstdlib>

/// @file
/// An environment variable chooses which of the faults planted by mutate.py is active. Every file
/// of the mutated engine includes this header first.

namespace delaunayflip
{

inline int ReadActiveMutant()
{
  const char* number = std::getenv("DELAUNAYFLIP_MUTANT");
  return number ? std::atoi(number) : 0; // 0: none
}

inline const int ActiveMutant = ReadActiveMutant();

}

/// Whether fault `number` is the active one.
#define MUTANT(number) (delaunayflip::ActiveMutant == (number))

#endif
