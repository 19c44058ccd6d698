// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_FLIPJOB_H
#define DELAUNAYFLIP_FLIPJOB_H

namespace delaunayflip
{

struct Arguments;
class ChildProcess;
struct OutputFiles;

/// Reads the input, flips, and fills the temporary files of `files`. Prints the summary, notes and
/// warnings. Runs in the child process, and enters its phases.
/// @returns Done or IterationLimit.
/// @throws CommandError; std::bad_alloc when memory runs out.
int RunFlipJob(const Arguments& arguments, OutputFiles& files, ChildProcess& child);

}

#endif
