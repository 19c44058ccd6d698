// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ExactReference.h"
#include "FlipTestSupport.h"
#include "MeshAudit.h"

#include <gtest/gtest.h>

namespace delaunayflip
{
namespace
{

std::vector<std::int64_t> GetFlips(const FlipReport& report)
{
  std::vector<std::int64_t> flips;
  for (const IterationRecord& row : report.Iterations)
  {
    if (row.Flipped > 0)
    {
      flips.push_back(row.Flipped);
    }
  }
  return flips;
}

/// The paper's Fig. 6: 8 vertices, 13 edges, 6 triangles.
TEST(WorstCase, OfThePaperTakesItsFlips)
{
  const OwnedMesh<double> mesh = MakeWorstCaseMesh(4);
  const FlipResult result = Flip(mesh.View());
  EXPECT_EQ(8, result.Report.Points);
  EXPECT_EQ(13, result.Report.Edges.Edges);
  EXPECT_EQ(6, result.Report.Triangles);
  EXPECT_EQ((std::vector<std::int64_t>{ 1, 2, 3, 2, 1 }), GetFlips(result.Report));
  EXPECT_TRUE(result.Report.Converged());
  EXPECT_EQ(0, CountRationalViolations(WithTriangles(mesh.View(), result.Triangles)));
}

/// m triangles take m - 1 iterations: with m = 2 k - 2 of them, (k - 1)^2 flips in 2 k - 3.
TEST(WorstCase, GrowsAsThePaperSays)
{
  for (std::int32_t k = 2; k <= 40; ++k)
  {
    const OwnedMesh<double> mesh = MakeWorstCaseMesh(k);
    const FlipResult result = Flip(mesh.View());
    const std::vector<std::int64_t> flips = GetFlips(result.Report);
    ASSERT_EQ(2 * k - 3, static_cast<std::int64_t>(flips.size())) << "k = " << k;
    for (std::int32_t i = 0; i < 2 * k - 3; ++i)
    {
      EXPECT_EQ(std::min(i + 1, 2 * k - 3 - i), flips[i]) << "k = " << k << ", flip set " << i;
    }
    EXPECT_EQ((k - 1) * (k - 1), result.Report.TotalFlips);
    ExpectConsistentStatistics(result.Report);
    const TriangleMesh after = WithTriangles(mesh.View(), result.Triangles);
    EXPECT_EQ(0, CountNonDelaunayEdges(after, FlipOptions()));
    EXPECT_EQ(0, CountRationalViolations(after));
  }
}

/// The opposite-angle sum, the paper's own criterion, makes the same decisions here.
TEST(WorstCase, TakesTheSameFlipsByAngles)
{
  FlipOptions options;
  options.Criterion = CriterionKind::OppositeAngles;
  const OwnedMesh<double> mesh = MakeWorstCaseMesh(4);
  EXPECT_EQ(
    (std::vector<std::int64_t>{ 1, 2, 3, 2, 1 }), GetFlips(Flip(mesh.View(), options).Report));
}

}
}
