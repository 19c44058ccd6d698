// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "RandomMess.h"
#include "FlipTestSupport.h"
#include "MeshAudit.h"

#include <gtest/gtest.h>

#include <vector>

/// @file
/// Thousands of small meshes with every kind of defect, under random options: whatever the input,
/// the counts of edges by kind stay, no edge is created twice, the statistics add up, and the loop
/// ends by itself.

namespace
{
using namespace delaunayflip;

void ExpectSameCounts(const EdgeCounts& expected, const EdgeCounts& actual)
{
  EXPECT_EQ(expected.Edges, actual.Edges);
  EXPECT_EQ(expected.Boundary, actual.Boundary);
  EXPECT_EQ(expected.NonManifold, actual.NonManifold);
  EXPECT_EQ(expected.WronglyWound, actual.WronglyWound);
}

void ExpectSoundStatistics(const FlipReport& report)
{
  EXPECT_EQ(StopReasonKind::Converged, report.StopReason);
  for (const IterationRecord& row : report.Iterations)
  {
    EXPECT_GT(row.Flipped, 0);
    EXPECT_EQ(row.NonDelaunay, row.Flipped + row.Excluded + row.Blocked);
  }
}

void FlipMess(std::uint32_t seed)
{
  const RandomMess mess = MakeRandomMess(seed);
  const TriangleMesh view = mess.View();
  std::vector<std::int32_t> ids(mess.Mesh.Triangles.size());
  const FlipReport report = FlipToDelaunay(
    view, OnTestBackend(mess.Options), MutableTriangleArray(ids.data(), view.Triangles.Count));
  const TriangleArray flipped(ids.data(), view.Triangles.Count);
  ExpectSameCounts(CountEdges(view.Triangles), report.Edges);
  ExpectSameCounts(CountEdges(view.Triangles), CountEdges(flipped));
  EXPECT_EQ(0, CountDuplicateEdgesGained(view.Triangles, flipped));
  EXPECT_EQ(EulerCharacteristic(view.Triangles), EulerCharacteristic(flipped));
  EXPECT_EQ(EulerCharacteristic(flipped), report.EulerCharacteristic);
  ExpectSoundStatistics(report);
}

TEST(RandomMess, StaysAsSoundAsItWas)
{
#if defined(DELAUNAYFLIP_REDUCED_TESTS)
  constexpr std::uint32_t Meshes = 1000;
#else
  constexpr std::uint32_t Meshes = 5000;
#endif
  for (std::uint32_t seed = 1; seed <= Meshes && !testing::Test::HasFailure(); ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    FlipMess(seed);
  }
}
}
