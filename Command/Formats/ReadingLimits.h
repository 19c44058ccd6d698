// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_READINGLIMITS_H
#define DELAUNAYFLIP_READINGLIMITS_H

#include <sys/resource.h>

#include <cstddef>

namespace delaunayflip
{

/// While it lives, this process can take no more memory and processor time than reading a file of
/// `bytes` can need, many times over: a corrupt file shall not take all there is. What asks for
/// more memory fails; more time ends the process by SIGXCPU.
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
