// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_READINGLIMITS_H
#define DELAUNAYFLIP_READINGLIMITS_H

#include <sys/resource.h>

#include <cstddef>

namespace delaunayflip
{

/// Keeps a corrupt file from using all memory and time. While this object lives, the memory and
/// processor time of the process are limited to many times what a valid file of `bytes` needs.
/// Allocations beyond the limit fail; beyond the limit of time, SIGXCPU ends the process.
class ReadingLimits
{
public:
  explicit ReadingLimits(std::size_t bytes);
  ~ReadingLimits();
  ReadingLimits(const ReadingLimits&) = delete;
  ReadingLimits& operator=(const ReadingLimits&) = delete;

private:
  rlimit Memory = {};
  rlimit Time = {};
};

}

#endif
