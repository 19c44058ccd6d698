// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ExactReference.h"
#include "FlipTestSupport.h"
#include "MeshAudit.h"

#include <gtest/gtest.h>

/// @file
/// Checks that the tiles of a large benchmark mesh fit together.

namespace delaunayflip
{
namespace
{

struct Tiling
{
  std::int64_t Points;
  std::int32_t TilesPerSide;
};

void PrintTo(const Tiling& tiling, std::ostream* stream)
{
  *stream << tiling.Points << " points in " << tiling.TilesPerSide << "^2 tiles";
}

class TiledBadMeshTest : public testing::TestWithParam<Tiling>
{
protected:
  OwnedMesh<float> Make(int threads) const
  {
    return MakeTiledBadMesh(GetParam().Points, GetParam().TilesPerSide, 7, threads);
  }
};

TEST_P(TiledBadMeshTest, IsOneDiscOfLeftTurningTriangles)
{
  const OwnedMesh<float> mesh = this->Make(0);
  EXPECT_EQ(GetParam().Points, mesh.NumberOfPoints());
  const std::int64_t boundary = 4 * GetParam().TilesPerSide;
  EXPECT_EQ(2 * GetParam().Points - boundary - 2, mesh.NumberOfTriangles());
  const EdgeCounts edges = CountEdges(mesh.View().Triangles);
  EXPECT_EQ(3 * GetParam().Points - boundary - 3, edges.Edges);
  EXPECT_EQ(boundary, edges.Boundary);
  EXPECT_EQ(0, edges.NonManifold);
  EXPECT_EQ(0, edges.WronglyWound);
  EXPECT_EQ(1, EulerCharacteristic(mesh.View().Triangles));
  EXPECT_EQ(mesh.NumberOfTriangles(), CountTurns(mesh.View()).Left);
}

TEST_P(TiledBadMeshTest, IsTheSameForAnyNumberOfThreads)
{
  const OwnedMesh<float> expected = this->Make(1);
  for (int threads : { 2, 5 })
  {
    const OwnedMesh<float> mesh = this->Make(threads);
    EXPECT_TRUE(expected.Points == mesh.Points);
    EXPECT_TRUE(expected.Triangles == mesh.Triangles);
  }
}

TEST_P(TiledBadMeshTest, BecomesDelaunay)
{
  const OwnedMesh<float> mesh = this->Make(0);
  const FlipResult result = Flip(mesh.View());
  EXPECT_TRUE(result.Report.Converged());
  EXPECT_LT(0, result.Report.TotalFlips);
  EXPECT_EQ(0, CountNonDelaunayEdges(WithTriangles(mesh.View(), result.Triangles), FlipOptions()));
}

INSTANTIATE_TEST_SUITE_P(Tilings, TiledBadMeshTest,
  testing::Values(Tiling{ 20, 1 }, Tiling{ 100, 3 }, Tiling{ 5000, 4 }, Tiling{ 20011, 7 }));

}
}
