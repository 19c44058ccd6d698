// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_BINARYSEARCH_H
#define DELAUNAYFLIP_BINARYSEARCH_H

#include "HostDevice.h"

namespace delaunayflip
{

/// The end of the first numbers of a range, for which `isBefore` is true; it is false for the
/// others.
template <typename Number, typename IsBefore>
DELAUNAYFLIP_HOST_DEVICE Number FindEnd(Number first, Number last, const IsBefore& isBefore)
{
  while (first < last)
  {
    const Number middle = first + (last - first) / 2;
    const bool before = isBefore(middle);
    // Selections instead of a branch, which would be mispredicted half of the time.
    first = before ? middle + 1 : first;
    last = before ? last : middle;
  }
  return first;
}

}

#endif
