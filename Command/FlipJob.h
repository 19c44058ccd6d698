// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_FLIPJOB_H
#define DELAUNAYFLIP_FLIPJOB_H

#include "ChildProcess.h"

#include <functional>

namespace delaunayflip
{

struct Arguments;
struct OutputFiles;

/// Reads the input, flips, and fills the temporary files of `files`. Prints the summary, notes and
/// warnings. Runs in the child process; calls `enter` at the beginning of each phase.
/// @returns Done or IterationLimit.
/// @throws CommandError; std::bad_alloc when memory runs out.
int RunFlipJob(
  const Arguments& arguments, OutputFiles& files, const std::function<void(Phase)>& enter);

}

#endif
