// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_FAILINGALLOCATIONS_H
#define DELAUNAYFLIP_FAILINGALLOCATIONS_H

#include <cstddef>
#include <cstdint>

/// Makes allocations of this process fail, one at a time.
///
/// Linking this replaces operator new, posix_memalign and mmap in the whole program. Counted are
/// calls from the engine. Out of reach are what the C++ library allocates for it within its own
/// functions, and what oneTBB allocates, which ends the process where it gets nothing.
class FailingAllocations
{
public:
  /// From now on the `number`-th call fails, counted from 1, on whichever thread it is made. All
  /// later ones succeed.
  /// @param smallest bytes of the blocks that are counted.
  explicit FailingAllocations(std::int64_t number, std::size_t smallest = 0);
  ~FailingAllocations();
  FailingAllocations(const FailingAllocations&) = delete;
  FailingAllocations& operator=(const FailingAllocations&) = delete;

  /// Whether one has failed.
  static bool HasFailed();

  /// Stops the count, for what a test does itself. Returns whether one has failed.
  static bool Stop();
};

/// Meanwhile allocations of this thread neither count nor fail.
class SparedAllocations
{
public:
  SparedAllocations();
  ~SparedAllocations();
  SparedAllocations(const SparedAllocations&) = delete;
  SparedAllocations& operator=(const SparedAllocations&) = delete;

private:
  bool WasSpared;
};

#endif
