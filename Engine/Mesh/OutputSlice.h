// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_OUTPUTSLICE_H
#define DELAUNAYFLIP_OUTPUTSLICE_H

#include "HostDevice.h"
#include "TriangleMesh.h"

#include <cstdint>

/// @file
/// Where a backend writes results: the caller's whole array, or one slice of it at a time, to save
/// device memory.

namespace delaunayflip
{

/// Values [First, Last) of an output of 32-bit numbers, in a separate array.
struct OutputSlice
{
  std::uint32_t* Values;
  std::int64_t First, Last;

  /// Sets value i if it is in the slice.
  DELAUNAYFLIP_HOST_DEVICE void Set(std::int64_t i, std::uint32_t value) const
  {
    if (i >= this->First && i < this->Last)
    {
      this->Values[i - this->First] = value;
    }
  }
};

/// A slice of vertex ids, three per triangle.
struct IdSlice
{
  OutputSlice Ids;

  DELAUNAYFLIP_HOST_DEVICE void Set(std::int64_t triangle, int slot, std::int64_t vertex) const
  {
    this->Ids.Set(3 * triangle + slot, static_cast<std::uint32_t>(vertex));
  }
};

/// Whether a target includes some id of a triangle.
DELAUNAYFLIP_HOST_DEVICE inline bool HasTriangle(const IdSlice& slice, std::int64_t triangle)
{
  return 3 * triangle + 2 >= slice.Ids.First && 3 * triangle < slice.Ids.Last;
}
DELAUNAYFLIP_HOST_DEVICE inline bool HasTriangle(const MutableTriangleArray&, std::int64_t)
{
  return true;
}

}

#endif
