// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// Runs the tests of the mapper in a window of EGL: by CUDA, or anywhere by the CPU with --any.
/// Ends with 77 where it cannot run.
#include "EglWindow.h"
#include "TestFiller.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <iostream>

int main(int argc, char* argv[])
{
  testing::InitGoogleTest(&argc, argv);
  const bool anywhere = argc > 1 && std::strcmp(argv[1], "--any") == 0;
  if (!anywhere)
  {
    setenv("DELAUNAYFLIP_TEST_BACKEND", "cuda", 1);
  }
  const std::string obstacle = OpenEgl(anywhere);
  if (!obstacle.empty())
  {
    std::cout << "skipped: " << obstacle << std::endl;
    return 77;
  }
  return RUN_ALL_TESTS();
}
