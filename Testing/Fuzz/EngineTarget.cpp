// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FuzzTarget.h"

#include "EngineJudge.h"

#include <gtest/gtest.h>

#include <iostream>

using namespace delaunayflip;

/// @file
/// The engine as a target for fuzzers.

void SetUpTarget(int* argc, char** argv)
{
  testing::InitGoogleTest(argc, argv);
  testing::GTEST_FLAG(throw_on_failure) = true;
}

void RunTarget(const std::uint8_t* bytes, std::size_t size)
{
  JudgeEngineCase(MakeEngineCase(bytes, size));
}

void PrintTarget(const std::uint8_t* bytes, std::size_t size)
{
  Print(MakeEngineCase(bytes, size), std::cout);
}
