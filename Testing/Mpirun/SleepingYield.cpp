// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause

/// For LD_PRELOAD. A rank of Open MPI that waits yields its core again and again. Since Linux 6.6
/// the scheduler hardly heeds that, so with more ranks than cores each message costs a time slice.
/// Here such a rank sleeps a little.

#include <ctime>

extern "C" int sched_yield() noexcept
{
  const timespec pause{ 0, 20000 };
  nanosleep(&pause, nullptr);
  return 0;
}
