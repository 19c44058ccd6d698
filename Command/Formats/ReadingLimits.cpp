// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ReadingLimits.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <ctime>
#include <fstream>

namespace delaunayflip
{

namespace
{

// Text of one-digit numbers grows 16 times when every number becomes a few doubles. Compressed data
// can grow a thousand times, but only if they are nearly constant.
constexpr double MemoryPerByte = 200;
constexpr double LeastMemory = 1 << 30;
// The slowest readers take 0.2 microseconds per byte.
constexpr double SecondsPerByte = 5e-6;
constexpr double LeastSeconds = 30;

/// The data segments and private mappings of this process in bytes, as the system counts them.
double UsedMemory()
{
  std::ifstream file("/proc/self/statm");
  double pages[6] = {};
  for (double& count : pages)
  {
    file >> count;
  }
  return pages[5] * static_cast<double>(sysconf(_SC_PAGESIZE));
}

double UsedSeconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Lowers a limit, returns what it was.
rlimit Lower(int resource, double value)
{
  rlimit before = {};
  getrlimit(resource, &before);
  rlimit lowered = before;
  lowered.rlim_cur = std::min(before.rlim_cur, static_cast<rlim_t>(value));
  setrlimit(resource, &lowered);
  return before;
}

}

ReadingLimits::ReadingLimits(std::size_t bytes)
  : Memory(
      Lower(RLIMIT_DATA, UsedMemory() + LeastMemory + MemoryPerByte * static_cast<double>(bytes))),
    Time(Lower(RLIMIT_CPU,
      std::ceil(UsedSeconds() + LeastSeconds + SecondsPerByte * static_cast<double>(bytes))))
{
}

ReadingLimits::~ReadingLimits()
{
  setrlimit(RLIMIT_DATA, &this->Memory);
  setrlimit(RLIMIT_CPU, &this->Time);
}

}
