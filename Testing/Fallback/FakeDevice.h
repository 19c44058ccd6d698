// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_FAKEDEVICE_H
#define DELAUNAYFLIP_FAKEDEVICE_H

#include "DelaunayFlip.h"

#include <gtest/gtest.h>

#include <cstdint>

/// @file
/// A GPU that is none: takes the place of the CUDA backend, works on threads, and fails when a test
/// wants it. Its memory is the host's.

namespace delaunayflip
{

/// Calls of the backend until the one that fails with "as the test wants it"; 0: none does.
extern int CallsToFailure;

/// Whether all calls fail so.
extern bool IsDeviceLost;

/// Bytes that have been copied between the host's memory and the device's.
extern std::int64_t CopiedBytes;

/// Places on spheres for which the device was asked.
extern std::int64_t AnswersOnDevice;

/// Lets each call of the backend fail, in one run each, until a run needs fewer calls.
/// @param fewest more runs than this are expected.
/// @param run makes a session on a backend of which a call fails. @param check judges it.
template <typename Run, typename Check>
void ForEachFailingCall(int fewest, const Run& run, const Check& check)
{
  for (int call = 1; !testing::Test::HasFatalFailure(); ++call)
  {
    SCOPED_TRACE(call);
    const FlipSession session = run(BackendKind::Auto, call);
    check(session);
    const bool hasFailed = CallsToFailure == 0;
    if (!hasFailed)
    {
      EXPECT_LT(fewest, call);
      return;
    }
  }
}

}

#endif
