// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_CHILDPROCESS_H
#define DELAUNAYFLIP_CHILDPROCESS_H

#include <atomic>
#include <csignal>
#include <functional>

/// @file
/// Runs work in a forked process, so that a crash there can be reported and cleaned up.

namespace delaunayflip
{

/// What the child is doing, for the message if it crashes.
enum class Phase
{
  Reading,
  Flipping,
  Writing,
  Over
};

/// How the child ended.
struct ChildOutcome
{
  int ExitCode = 0; ///< What the work returned, if it was not killed.
  int KilledBy = 0; ///< The signal that killed the child, or 0.
  int InterruptedBy = 0; ///< The signal that made this process kill the child, or 0.
  Phase LastPhase = Phase::Reading;
};

/// Watches one child. While this object lives, SIGINT, SIGTERM, SIGHUP and SIGQUIT do not end this
/// process. They stay pending until Run, which then kills the child; so the caller can always clean
/// up. Must be constructed before any thread is started.
class ChildProcess
{
public:
  ChildProcess();
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Runs `work`, which returns the exit code, in the child until it ends.
  /// @throws CommandError when the child cannot be started.
  ChildOutcome Run(const std::function<int()>& work);

  /// Begins a phase, in the child; both processes know it.
  void Enter(Phase phase);

  Phase GetPhase() const;

private:
  [[noreturn]] void Work(const std::function<int()>& work, int parent);
  ChildOutcome Wait(int child);

  std::atomic<Phase>* Shared; ///< In memory shared by both processes.
  sigset_t Watched;
  sigset_t Before;
};

}

#endif
