// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FuzzTarget.h"

/// @file
/// The entry points of libFuzzer, which counts an exception that leaves them as a crash.

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv)
{
  SetUpTarget(argc, *argv);
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size)
{
  RunTarget(bytes, size);
  return 0;
}
