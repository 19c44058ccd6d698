// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Arguments.h"
#include "ChildProcess.h"
#include "CommandError.h"
#include "Console.h"
#include "FlipJob.h"
#include "OutputFiles.h"

#include <cstring>
#include <iostream>

/// @file
/// delaunay-flip: this process creates, renames and removes the files; a child does the work.

using namespace delaunayflip;

namespace
{

/// Runs `work` and turns what it throws into a message and an exit code. `describe` returns the
/// beginning of the message for an exception that names no file.
template <typename Function, typename Description>
int Guarded(const Function& work, const Description& describe)
{
  try
  {
    return work();
  }
  catch (const CommandError& error)
  {
    PrintError(error.what());
    return static_cast<int>(error.Code);
  }
  catch (const std::exception& error)
  {
    const char* const problem = IsLackOfMemory(error) ? "not enough memory" : error.what();
    PrintError(describe() + problem);
  }
  return static_cast<int>(ExitCode::BadFile);
}

/// The file that was in use and what was being done to it, as the beginning of a message.
std::string DescribeWork(const Arguments& arguments, Phase phase)
{
  if (phase == Phase::Reading)
  {
    return arguments.Input + ": cannot be read: ";
  }
  if (phase == Phase::Flipping)
  {
    const char* const flip = arguments.FromPoints ? "triangulated: " : "flipped: ";
    return arguments.Input + ": cannot be " + flip;
  }
  return arguments.Output + ": cannot be written: ";
}

/// Says what the child was doing when a signal killed it, and what may have caused that.
std::string ExplainDeath(
  const Arguments& arguments, const OutputFiles& files, const ChildOutcome& outcome)
{
  const std::string crash =
    DescribeWork(arguments, outcome.LastPhase) + "it crashed (" + strsignal(outcome.KilledBy) + ")";
  switch (outcome.LastPhase)
  {
    case Phase::Reading:
      return crash + "; the file is probably truncated or corrupt";
    case Phase::Flipping:
      return crash + "; was there enough memory? Nothing was written";
    default:
      return crash + ExplainFailedWrite(files.Mesh.GetTemporary());
  }
}

int Finish(const Arguments& arguments, OutputFiles& files, const ChildOutcome& outcome)
{
  if (outcome.InterruptedBy != 0)
  {
    PrintError("interrupted; nothing was written");
    return 128 + outcome.InterruptedBy;
  }
  if (outcome.KilledBy != 0)
  {
    throw CommandError(ExitCode::BadFile, ExplainDeath(arguments, files, outcome));
  }
  if (outcome.LastPhase == Phase::Over)
  {
    files.Commit();
    if (!arguments.Quiet)
    {
      std::cout << "wrote           " << WithoutControls(arguments.Output) << std::endl;
    }
  }
  return outcome.ExitCode;
}

}

int main(int argc, char** argv)
{
  const auto run = [argc, argv]
  {
    Arguments arguments;
    if (const std::optional<int> code = ParseArguments(argc, argv, arguments))
    {
      return *code;
    }
    ChildProcess child;
    OutputFiles files{ PendingFile(arguments.Output), PendingFile(arguments.Statistics, true),
      PendingFile(arguments.Report, true), PendingFile(arguments.ProjectionFile) };
    const auto work = [&]
    {
      return Guarded([&] { return RunFlipJob(arguments, files, child); },
        [&] { return DescribeWork(arguments, child.GetPhase()); });
    };
    return Finish(arguments, files, child.Run(work));
  };
  return Guarded(run, [] { return std::string(); });
}
