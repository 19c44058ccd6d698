// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "GpuTestSupport.h"
#include "RandomInputs.h"

/// @file
/// Thousands of small meshes with every kind of defect: the GPU's bits are the CPU's.

namespace delaunayflip
{
namespace
{

class GpuRandomMess : public GpuTest
{
};

TEST_F(GpuRandomMess, IsFlippedAsOnTheCpu)
{
  constexpr std::uint32_t Meshes = 2000;
  for (std::uint32_t seed = 1; seed <= Meshes && !HasFailure(); ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const RandomMess mess = MakeRandomMess(seed);
    ExpectGpuAgrees(mess.View(), mess.Options);
  }
}

}
}
