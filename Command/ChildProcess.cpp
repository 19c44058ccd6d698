// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ChildProcess.h"

#include "CommandError.h"

#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif

#include <cerrno>
#include <cstring>
#include <iostream>
#include <new>

namespace delaunayflip
{

namespace
{

/// The signals by which a user or the system ends a program.
constexpr int Endings[] = { SIGINT, SIGTERM, SIGHUP, SIGQUIT };

}

ChildProcess::ChildProcess()
{
  void* memory =
    mmap(nullptr, sizeof(*this->Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED)
  {
    throw CommandError(ExitCode::BadFile, std::string("no memory: ") + std::strerror(errno));
  }
  this->Shared = new (memory) std::atomic<Phase>(Phase::Reading);
  // A closed pipe or a file size limit must give an error code instead of killing the process.
  signal(SIGPIPE, SIG_IGN);
  signal(SIGXFSZ, SIG_IGN);
  // If SIGCHLD were ignored, the system would reap the child itself and its status would be lost.
  signal(SIGCHLD, SIG_DFL);
  sigemptyset(&this->Watched);
  sigaddset(&this->Watched, SIGCHLD);
  for (const int ending : Endings)
  {
    struct sigaction action = {};
    if (sigaction(ending, nullptr, &action) != 0 || action.sa_handler != SIG_IGN) // as by nohup
    {
      sigaddset(&this->Watched, ending);
    }
  }
  sigprocmask(SIG_BLOCK, &this->Watched, &this->Before);
}

ChildProcess::~ChildProcess()
{
  sigprocmask(SIG_SETMASK, &this->Before, nullptr);
  munmap(this->Shared, sizeof(*this->Shared));
}

ChildOutcome ChildProcess::Run(const std::function<int()>& work)
{
  std::cout.flush();
  const int parent = getpid();
  const int child = fork();
  if (child < 0)
  {
    throw CommandError(ExitCode::BadFile, std::string("cannot fork: ") + std::strerror(errno));
  }
  if (child == 0)
  {
    this->Work(work, parent);
  }
  return this->Wait(child);
}

void ChildProcess::Enter(Phase phase) { *this->Shared = phase; }

Phase ChildProcess::GetPhase() const { return *this->Shared; }

void ChildProcess::Work(const std::function<int()>& work, int parent)
{
  // Ctrl-C in a terminal reaches both processes; only the parent acts on it.
  for (const int ending : Endings)
  {
    signal(ending, SIG_IGN);
  }
  sigprocmask(SIG_SETMASK, &this->Before, nullptr);
  // A reader that crashes on a corrupt file must not leave a core file in the user's folder.
  const rlimit none = {};
  setrlimit(RLIMIT_CORE, &none);
#ifdef __linux__
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent)
  {
    _exit(static_cast<int>(ExitCode::Interrupted));
  }
#endif
  const int code = work();
  std::cout.flush();
  _exit(code);
}

ChildOutcome ChildProcess::Wait(int child)
{
  int status = 0;
  int interruptedBy = 0;
  while (waitpid(child, &status, WNOHANG) == 0)
  {
    int received = 0;
    if (sigwait(&this->Watched, &received) == 0 && received != SIGCHLD)
    {
      // Nothing has been written under a final name yet, so there is nothing to wait for.
      interruptedBy = received;
      kill(child, SIGKILL);
      waitpid(child, &status, 0);
      break;
    }
  }
  ChildOutcome outcome{ 0, 0, interruptedBy, *this->Shared };
  if (WIFEXITED(status))
  {
    outcome.ExitCode = WEXITSTATUS(status);
  }
  if (WIFSIGNALED(status))
  {
    outcome.KilledBy = WTERMSIG(status);
  }
  return outcome;
}

}
