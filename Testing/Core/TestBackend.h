// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_TESTBACKEND_H
#define DELAUNAYFLIP_TESTBACKEND_H

#include <cstdlib>
#include <string>

namespace delaunayflip
{

/// Whether the environment variable DELAUNAYFLIP_TEST_BACKEND is "cuda". Tests that do not choose a
/// backend then run on the GPU, whatever the size of their meshes. SkipWithoutGpu.cpp skips them if
/// there is none.
inline bool IsTestBackendCuda()
{
  const char* name = std::getenv("DELAUNAYFLIP_TEST_BACKEND");
  return name && std::string(name) == "cuda";
}

/// How FlipReport::Backend begins on the backend of tests that do not choose one.
inline std::string GetTestBackendName() { return IsTestBackendCuda() ? "CUDA: " : "Threads: "; }

}

#endif
