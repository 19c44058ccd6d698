// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_FAKEDEVICE_H
#define DELAUNAYFLIP_FAKEDEVICE_H

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

}

#endif
