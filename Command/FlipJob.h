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

/// Reads the input, flips, and fills the temporaries of `files`. Prints the summary, notes and
/// warnings. Runs in the child process; tells through `enter` which phase begins.
/// @returns Done or IterationLimit.
/// @throws CommandError and whatever a lack of memory throws.
int RunFlipJob(
  const Arguments& arguments, OutputFiles& files, const std::function<void(Phase)>& enter);

}

#endif
