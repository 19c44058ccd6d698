// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Arguments.h"
#include "ChildProcess.h"
#include "CommandError.h"
#include "Console.h"
#include "DiskSpace.h"
#include "FlipJob.h"
#include "OutputFiles.h"

#include <cstring>
#include <iostream>
#include <new>

/// @file
/// delaunay-flip: this process creates, renames and removes the files; a child does the work.

using namespace delaunayflip;

namespace
{

/// Runs `work` and turns what it throws into a message and an exit code.
int Guarded(const std::function<int()>& work)
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
  catch (const std::bad_alloc&)
  {
    PrintError("not enough memory");
  }
  catch (const std::exception& error)
  {
    PrintError(error.what());
  }
  return static_cast<int>(ExitCode::BadFile);
}

/// Says what the child was doing when a signal killed it, and what may have caused that.
std::string ExplainDeath(
  const Arguments& arguments, const OutputFiles& files, const ChildOutcome& outcome)
{
  const std::string death = std::string(" (") + strsignal(outcome.DiedOf) + ")";
  switch (outcome.LastPhase)
  {
    case Phase::Reading:
      return arguments.Input + ": cannot be read: " +
        (outcome.DiedOf == SIGXCPU ? "reading takes far more time than a file of its size needs"
                                   : "the reader crashed" + death) +
        "; the file is probably truncated or corrupt";
    case Phase::Flipping:
      return arguments.Input + ": flipping it crashed" + death +
        "; was there enough memory? Nothing was written";
    default:
      return arguments.Output + ": cannot be written: writing or checking it crashed" + death +
        ExplainFailedWrite(files.Mesh.GetTemporary());
  }
}

int Finish(const Arguments& arguments, OutputFiles& files, const ChildOutcome& outcome)
{
  if (outcome.InterruptedBy != 0)
  {
    PrintError("interrupted; nothing was written");
    return 128 + outcome.InterruptedBy;
  }
  if (outcome.DiedOf != 0)
  {
    throw CommandError(ExitCode::BadFile, ExplainDeath(arguments, files, outcome));
  }
  if (outcome.LastPhase == Phase::Over)
  {
    files.Commit();
    if (!arguments.Quiet)
    {
      std::cout << "wrote           " << arguments.Output << std::endl;
    }
  }
  return outcome.ExitCode;
}

}

int main(int argc, char** argv)
{
  return Guarded(
    [argc, argv]
    {
      Arguments arguments;
      if (const std::optional<int> code = ParseArguments(argc, argv, arguments))
      {
        return *code;
      }
      ChildProcess child;
      OutputFiles files(arguments);
      const ChildOutcome outcome = child.Run(
        [&arguments, &files](const std::function<void(Phase)>& enter) {
          return Guarded(
            [&arguments, &files, &enter] { return RunFlipJob(arguments, files, enter); });
        });
      return Finish(arguments, files, outcome);
    });
}
