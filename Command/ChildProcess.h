// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_CHILDPROCESS_H
#define DELAUNAYFLIP_CHILDPROCESS_H

#include <csignal>
#include <functional>

/// @file
/// Work in a forked process, so that a crash in it can be reported and cleaned up after.

namespace delaunayflip
{

/// What the work is busy with, for the message about its death.
enum class Phase
{
  Reading,
  Flipping,
  Writing,
  Over
};

/// What runs in the child: it is given the function to report its phases through, and returns the
/// exit code.
using ChildWork = std::function<int(const std::function<void(Phase)>&)>;

/// How the child ended.
struct ChildOutcome
{
  int ExitCode = 0; ///< What the work returned, if it was not killed.
  int DiedOf = 0; ///< The signal that killed the child, or 0.
  int InterruptedBy = 0; ///< The signal to this process that made it stop the child, or 0.
  Phase LastPhase = Phase::Reading;
};

/// Watches one child. From its construction to its destruction SIGINT, SIGTERM and SIGHUP do not
/// end this process but wait for Run: they kill the child, and so the caller can always clean up.
/// To be made before any thread.
class ChildProcess
{
public:
  ChildProcess();
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Runs `work` in the child until it ends.
  /// @throws CommandError when there can be no child.
  ChildOutcome Run(const ChildWork& work);

private:
  [[noreturn]] void Work(const ChildWork& work);
  ChildOutcome Wait(int child);

  struct SharedPhase;
  SharedPhase* Shared; ///< In memory that both processes see.
  sigset_t Watched;
  sigset_t Before;
  int Parent;
};

}

#endif
