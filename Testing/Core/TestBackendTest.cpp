// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "TestBackend.h"
#include "FlipTestSupport.h"

#include <gtest/gtest.h>

namespace delaunayflip
{
namespace
{

TEST(TestBackend, IsTheRequestedOne)
{
  const OwnedMesh<double> mesh = MakeRandomBadMeshDouble(100, 1);
  const std::string expected = GetTestBackendName();
  EXPECT_EQ(0u, Flip(mesh.View()).Report.Backend.rfind(expected, 0));
  EXPECT_EQ(0u, MakeSession(mesh.View()).GetReport().Backend.rfind(expected, 0));
}

}
}
